// SPDX-License-Identifier: LGPL-2.1-or-later

// What slipstep plant refuses, and what it leaves when all is well.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "slipstep_process.h"

namespace
{
  namespace fs = std::filesystem;

  class Plant : public testing::Test
  {
  protected:
    SlipstepProcess::Result
    plant(const std::vector<std::string> &arguments) const
    {
      std::vector<std::string> all = {"plant"};
      all.insert(all.end(), arguments.begin(), arguments.end());
      return process.run(all);
    }

    void expect_refusal(const std::vector<std::string> &arguments,
                        const std::string              &words) const
    {
      const auto result = plant(arguments);
      EXPECT_EQ(result.exit_code, 2) << result.err;
      EXPECT_EQ(result.n_error_lines(), 1u) << result.err;
      EXPECT_TRUE(contains(result.err, words))
        << "  \"" << words << "\" is not in: " << result.err;
    }

    const SlipstepProcess process;
  };
} // namespace



TEST_F(Plant, WrongOptions)
{
  expect_refusal({}, "the name of a folder is missing");
  expect_refusal({"a", "b"}, "one argument too many");
  expect_refusal({"a", "--class", "outsde"}, "did you mean outside");
  expect_refusal({"a", "--effect", "heeling"}, "did you mean healing");
  expect_refusal({"a", "--effect", "healing,pressure"},
                 "hides 1 effect, not 2");
  expect_refusal({"a", "--class", "joint", "--effect", "viscous,heating"},
                 "not 2: one of overstress+ageing, ");
  expect_refusal({"a", "--class", "none", "--effect", "healing"},
                 "hides 0 effects");
  expect_refusal({"a", "--seed", "-1"}, "--seed -1: must be a whole number");
  expect_refusal({"a", "--seed", ""}, "--seed: a value is needed");
  expect_refusal({"a", "--tests", "4294967298"}, "2 to 20 tests");
  expect_refusal({"a", "--noise", "loud"}, "heavy_tails");
  expect_refusal({"a", "--noise-factor", "nan"}, "must be a number, 0 or more");
  expect_refusal({"a", "--noise-factor", "1000"}, "at most 30");
  expect_refusal({"a", "--resume"}, "has no option --resume");
  expect_refusal({"--open", "missing"}, "cannot be opened");
  expect_refusal({"a", "--open", "missing"}, "takes no folder");
  EXPECT_TRUE(process.wrote_nothing());
}



TEST_F(Plant, CampaignThatIsReadAndOpened)
{
  const auto result =
    plant({"a", "--class", "outside", "--effect", "damage", "--tests", "6"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(process.run({"check", "a/case.prm", "a/measured"}).exit_code, 0);
  const auto answer = plant({"--open", "a/answer.sealed"});
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_TRUE(contains(answer.out, "\"damage\""));
  expect_refusal({"a"}, "exists already");
  process.write("b.sealed", "not sealed\n");
  expect_refusal({"--open", "b.sealed"}, "is not a sealed answer");
}



TEST_F(Plant, ListsWhatCanBeHidden)
{
  const auto result = plant({"--list"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const std::string part : {"class none\n  nothing\n",
                                 "class one, two\n",
                                 "class narrow\n  pressure: G = ",
                                 "  damage: "})
    EXPECT_TRUE(contains(result.out, part)) << part;
  EXPECT_TRUE(process.wrote_nothing());
}



TEST_F(Plant, AmplitudesAndEditionsAreChecked)
{
  expect_refusal({"a", "--amplitude", "2 %"}, "must be a number");
  expect_refusal({"a", "--amplitude", "3"}, "at most 0.5");
  for (const char *amplitude : {"0", "-0.1"})
    expect_refusal({"a", "--amplitude", amplitude},
                   "must be a number, more than 0");
  expect_refusal({"a", "--noise-factor", "-1"}, "must be a number, 0 or more");
  expect_refusal(
    {"a", "--effect", "stribeck", "--seed", "3", "--amplitude", "0.3"},
    "amplitude 0.3: what this campaign hides reaches at most 0.069");
  expect_refusal({"a",
                  "--effect",
                  "overstress",
                  "--seed",
                  "3",
                  "--amplitude",
                  "1e-9",
                  "--noise-factor",
                  "0"},
                 "amplitude 1e-09: take a larger one");
  expect_refusal({"a", "--amplitude", "0.1", "--class", "none"},
                 "adds no effect");
  expect_refusal({"a", "--edition", "99"}, "there are editions 1 to");
}
