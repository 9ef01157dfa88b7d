// SPDX-License-Identifier: LGPL-2.1-or-later

// The diagnoses that are shipped say what their README tells.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/bad_input/slipstep_process.h"

namespace
{
  using nlohmann::json;

  const std::string cases = std::string(SLIPSTEP_SOURCE_DIR) + "/prm/";

  class DiagnosedCases : public testing::Test
  {
  protected:
    /// The content of diagnosis.json of a case.
    json diagnosis(const std::string &case_file,
                   const std::string &element_tests = "none") const
    {
      const auto result =
        process.run({"diagnose",
                     cases + case_file,
                     "--quiet",
                     "--output",
                     "out",
                     "--set",
                     "Diagnosis/Element tests=" + element_tests});
      EXPECT_EQ(result.exit_code, 0) << result.err;
      if (result.exit_code != 0)
        return json();
      return json::parse(process.read("out/diagnosis.json"));
    }

    void expect_that_improved_case_runs() const
    {
      for (const std::string command : {"check", "point"})
        {
          std::vector<std::string> arguments = {command, "out/improved.prm"};
          if (command == "point")
            arguments.insert(arguments.end(), {"--output", "point"});
          const auto result = process.run(arguments);
          EXPECT_EQ(result.exit_code, 0) << command << ": " << result.err;
        }
    }

    const SlipstepProcess process;
  };



  std::vector<std::string> effects(const json &diagnosis)
  {
    return diagnosis["verdict"]["effects"];
  }



  bool names(const json &diagnosis, const std::string &effect)
  {
    const auto all = effects(diagnosis);
    return std::find(all.begin(), all.end(), effect) != all.end();
  }



  /// A parameter that was added with an effect.
  double found(const json        &diagnosis,
               const std::string &effect,
               const std::string &path)
  {
    for (const json &candidate : diagnosis["candidates"])
      if (candidate["effect"] == effect)
        for (const json &parameter : candidate["parameters"])
          if (parameter["path"] == path)
            return parameter["value"];
    ADD_FAILURE() << "no " << path << " with " << effect;
    return std::nan("");
  }



  /// Before and after [% of friction].
  void expect_gap(const json  &diagnosis,
                  const double before,
                  const double after,
                  const double tolerance)
  {
    const json gaps = diagnosis["shrink"]["fitted"];
    EXPECT_NEAR(gaps[0].get<double>(), before, tolerance * before);
    EXPECT_NEAR(gaps[1].get<double>(), after, tolerance * after);
  }
} // namespace



TEST_F(DiagnosedCases, HiddenRateEffect)
{
  const json result =
    diagnosis("hidden_rate_effect/hidden_rate_effect.prm", "worst");
  ASSERT_FALSE(result.is_null());
  EXPECT_EQ(result["verdict"]["status"], "named");
  EXPECT_EQ(effects(result), std::vector<std::string>{"overstress"});
  expect_gap(result, 7.29, 1.15, 0.1);

  // Within the intervals of README.md.
  const std::string path      = "Friction/overstress/";
  const double      viscosity = found(result, "overstress", path + "Viscosity");
  EXPECT_GT(viscosity, 8700.);
  EXPECT_LT(viscosity, 15200.);
  EXPECT_NEAR(found(result, "overstress", path + "Exponent"), 16.52, 0.5);

  // The gap found on the contact point is that of the block.
  ASSERT_EQ(result["fe_check"].size(), 1u);
  const json &check = result["fe_check"][0];
  EXPECT_NEAR(check["block_percent"][0].get<double>(), 11.6, 1.);
  EXPECT_LT(check["block_percent"][1].get<double>(), 1.5);
  EXPECT_LT(check["difference_percent"].get<double>(), 0.1);
  expect_that_improved_case_runs();
}



TEST_F(DiagnosedCases, HiddenHealing)
{
  const json result = diagnosis("hidden_healing/hidden_healing.prm");
  ASSERT_FALSE(result.is_null());
  EXPECT_EQ(result["verdict"]["status"], "named");
  EXPECT_EQ(effects(result), std::vector<std::string>{"healing"});
  expect_gap(result, 1.48, 1.12, 0.1);
  const std::string path = "Friction/healing/";
  EXPECT_NEAR(found(result, "healing", path + "Steepness"), 1200., 180.);
  EXPECT_NEAR(std::log(found(result, "healing", path + "Rate")),
              std::log(1e-10),
              std::log(4.));
  expect_that_improved_case_runs();
}



// As written, with both drivers.
TEST_F(DiagnosedCases, ShippedImprovedCases)
{
  for (const std::string folder : {"hidden_rate_effect", "hidden_healing"})
    for (const std::string command : {"point", "run"})
      {
        const auto result = process.run({command,
                                         cases + folder + "/improved.prm",
                                         "--quiet",
                                         "--output",
                                         command + "_" + folder});
        EXPECT_EQ(result.exit_code, 0) << folder << ": " << result.err;
      }
}



// Which of them, one step of the speed cannot tell.
TEST_F(DiagnosedCases, StepInSepioliteIsARateEffect)
{
  const json result = diagnosis("sepiolite_velocity_step/diagnose.prm");
  ASSERT_FALSE(result.is_null());
  EXPECT_EQ(result["gap"]["status"], "gap");
  EXPECT_EQ(result["data"]["replicate_pairs"], 0);
  EXPECT_NEAR(result["gap"]["rms_percent"].get<double>(), 4.77, 0.2);
  EXPECT_TRUE(names(result, "viscous") || names(result, "overstress"))
    << result["verdict"].dump();
  EXPECT_LT(result["shrink"]["fitted"][1].get<double>(), 1.8);
  const std::string headline = result["verdict"]["headline"];
  EXPECT_NE(headline.find("no replicates"), std::string::npos) << headline;
  expect_that_improved_case_runs();
}



// The cause is the place along the stroke, which no effect knows.
TEST_F(DiagnosedCases, StrokesHaveNoName)
{
  const json result = diagnosis("reciprocating_tribometer/diagnose.prm");
  ASSERT_FALSE(result.is_null());
  EXPECT_EQ(result["verdict"]["status"], "unnamed");
  EXPECT_TRUE(effects(result).empty());
  EXPECT_NEAR(result["gap"]["rms_percent"].get<double>(), 8.77, 0.4);
  EXPECT_GT(result["data"]["replicate_pairs"].get<int>(), 0);
  expect_that_improved_case_runs();
}



TEST_F(DiagnosedCases, PinsDependOnPathAndLoad)
{
  const json result = diagnosis("pps_ptfe_pin_on_disc/diagnose.prm");
  ASSERT_FALSE(result.is_null());
  EXPECT_EQ(result["gap"]["status"], "gap");
  EXPECT_EQ(result["data"]["replicate_pairs"], 2);
  EXPECT_NEAR(result["gap"]["rms_percent"].get<double>(), 7.97, 0.4);
  for (const std::string effect : {"pressure", "softening"})
    EXPECT_TRUE(names(result, effect)) << effect;
  EXPECT_LT(result["shrink"]["fitted"][1].get<double>(), 3.2);
  expect_that_improved_case_runs();
}
