// SPDX-License-Identifier: LGPL-2.1-or-later

// Folders of tests, and tests that say to be replicates.

#include <slipstep/measured_data/test_set.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/file_text.h"
#include "tests/message_of.h"
#include "tests/rows_header.h"
#include "tests/temporary_folder.h"

using namespace SlipStep;

namespace
{
  void write(const std::string &name,
             const std::string &condition,
             const double       pressure,
             const double       speed)
  {
    std::ofstream out(test_folder() / name);
    out << "# condition: " << condition << '\n' << header;
    for (int i = 0; i < 20; ++i)
      out << i << ',' << i * speed << ',' << pressure << ",0.1\n";
  }

  std::string message_of_set()
  {
    return message_of([] { read_test_set(test_folder()); });
  }
} // namespace



TEST(TestSet, AFolderIsASetInTheOrderOfNames)
{
  write("b.csv", "slow", 1., 0.1);
  write("a.csv", "slow", 1.1, 0.11);
  write("c.csv", "fast", 1., 10.);
  std::ofstream(test_folder() / "README.md") << "no test";
  const auto tests = read_test_set(test_folder());
  ASSERT_EQ(tests.size(), 3u);
  EXPECT_EQ(tests[0].name, "a");
  EXPECT_EQ(tests[2].condition, "fast");
  EXPECT_NEAR(mean_speed(tests[2]), 10., 0.1);
  EXPECT_EQ(typical_pressure(tests[0]), 1.1);
}



TEST(TestSet, AnEmptyFolderIsNamed)
{
  EXPECT_TRUE(contains(message_of_set(), "without tests"));
  EXPECT_THROW(read_test_set(test_folder() / "nowhere"), InputError);
}



TEST(TestSet, ReplicatesMustHaveBeenMadeAlike)
{
  write("a.csv", "dry", 1., 0.1);
  write("b.csv", "dry", 1.5, 0.1);
  std::string text = message_of_set();
  EXPECT_TRUE(contains(text, "b.csv: the condition 'dry' is that of"));
  EXPECT_TRUE(contains(text, "pressure is 1.5 MPa, not 1 MPa"));
  write("b.csv", "dry", 1., 0.2);
  text = message_of_set();
  EXPECT_TRUE(contains(text, "but its mean speed is"));
  write("b.csv", "dry, faster", 1., 0.2);
  EXPECT_EQ(message_of_set(), "");
}



// Replicates along any line: a slide that turns by an angle is as fast, also
// where what idles trembles at rest.
TEST(TestSet, SpeedIsThatOfThePath)
{
  for (const double degrees : {0., 20., 45., 90., 200.})
    {
      const double angle = degrees * std::acos(-1.) / 180.;
      MeasuredTest test;
      for (int i = 0; i <= 1000; ++i)
        {
          const double u       = 0.002 * std::clamp(i - 200, 0, 600);
          const double tremble = i % 2 == 0 ? 0.001 : 0.;
          test.time.push_back(0.1 * i);
          test.displacement.push_back(u * std::cos(angle) + tremble);
          test.displacement_y.push_back(u * std::sin(angle) - tremble);
        }
      EXPECT_NEAR(mean_speed(test), 0.02, 5e-4) << degrees;
    }
}



// A slide of 60 mm, 5 strokes of 10 mm, a diagonal of 5 mm.
TEST(TestSet, ThePathIsToldInFull)
{
  const auto length = [](const std::vector<std::array<double, 2>> &positions) {
    MeasuredTest test;
    for (std::size_t i = 0; i < positions.size(); ++i)
      {
        test.time.push_back(i);
        test.displacement.push_back(positions[i][0]);
        test.displacement_y.push_back(positions[i][1]);
        test.pressure.push_back(1.);
        test.friction.push_back(0.1);
      }
    const std::string text  = describe(test);
    const std::size_t begin = text.find("path ") + 5;
    return text.substr(begin, text.find(" mm", begin) - begin);
  };
  std::vector<std::array<double, 2>> coarse, fine, strokes, diagonal;
  for (int i = 0; i <= 10; ++i)
    coarse.push_back({{6. * i, 0.}});
  // The instrument trembles, at rest, too.
  for (int i = -1000; i <= 7000; ++i)
    fine.push_back({{std::clamp(0.01 * i, 0., 60.) + (i % 2 == 0 ? 0.004 : 0.),
                     i % 2 == 0 ? 0. : 0.004}});
  for (int i = 0; i <= 100; ++i)
    strokes.push_back({{std::abs(i % 40 - 20) * 0.5, 0.}});
  for (int i = 0; i <= 100; ++i)
    diagonal.push_back({{0.03 * i, 0.04 * i}});
  EXPECT_EQ(length(coarse), "60");
  EXPECT_EQ(length(fine), "60");
  EXPECT_EQ(length(strokes), "50");
  EXPECT_EQ(length(diagonal), "5");
}



// What a test notes was known when it had more rows.
TEST(TestSet, TheNoiseThatIsNotedIsTold)
{
  MeasuredTest test;
  for (int i = 0; i < 50; ++i)
    {
      test.time.push_back(i);
      test.displacement.push_back(i);
      test.pressure.push_back(1.);
      test.friction.push_back(0.1 + (i % 2) * 0.01);
    }
  EXPECT_EQ(describe(test).find(", noise 0.00123"), std::string::npos);
  test.notes["noise"] = "0.00123";
  EXPECT_TRUE(contains(describe(test), ", noise 0.00123"));
  EXPECT_TRUE(contains(describe(test), "friction 0.1 to 0.11, noise"));
  test.friction_y.assign(50, -0.2);
  EXPECT_TRUE(contains(describe(test),
                       "0.1 to 0.11 along x and -0.2 to -0.2 along y, noise"));
}



TEST(TestSet, ConditionsAreCounted)
{
  std::vector<MeasuredTest> tests(3);
  EXPECT_EQ(describe(tests), "3 tests: 3 without a condition");
  tests[0].condition = tests[2].condition = "dry";
  EXPECT_EQ(describe(tests),
            "3 tests: condition 'dry': 2, 1 without a condition");
  tests[1].condition = "wet";
  EXPECT_EQ(describe(tests), "3 tests: condition 'dry': 2, 'wet': 1");
}



TEST(TestSet, ACopyIsTold)
{
  const auto read_rows = [](const std::string &name, const double last) {
    std::ofstream(test_folder() / name)
      << header << "0,0,5,0.1\n1,1,5,0.2\n2,2,5," << last << '\n';
  };
  read_rows("a.csv", 0.3);
  read_rows("b.csv", 0.31);
  read_rows("c.csv", 0.3);
  auto tests = read_test_set(test_folder());
  warn_of_oddities(tests);
  ASSERT_EQ(tests.size(), 3u);
  EXPECT_TRUE(tests[0].warnings.empty());
  EXPECT_TRUE(tests[1].warnings.empty());
  ASSERT_EQ(tests[2].warnings.size(), 1u);
  EXPECT_TRUE(contains(tests[2].warnings[0],
                       "c.csv: its rows are identical with those of"));
}



TEST(TestSet, APressureInAnotherUnitIsTold)
{
  const auto read_rows = [](const std::string &name, const char *pressure) {
    std::ofstream(test_folder() / name)
      << header << "0,0," << pressure << ",0.1\n1,1," << pressure
      << ",0.2\n2,2," << pressure << ",0.3" << name[0] - 'a' << '\n';
  };
  read_rows("a.csv", "0.2");
  read_rows("b.csv", "2");
  read_rows("c.csv", "200");
  auto tests = read_test_set(test_folder());
  warn_of_oddities(tests);
  EXPECT_TRUE(tests[0].warnings.empty());
  EXPECT_TRUE(tests[1].warnings.empty());
  EXPECT_TRUE(tests[2].warnings.empty());
  read_rows("d.csv", "0.21");
  tests = read_test_set(test_folder());
  warn_of_oddities(tests);
  ASSERT_EQ(tests[2].warnings.size(), 0u);
  read_rows("c.csv", "900");
  tests = read_test_set(test_folder());
  warn_of_oddities(tests);
  ASSERT_EQ(tests[2].warnings.size(), 1u);
  EXPECT_TRUE(contains(tests[2].warnings[0], "c.csv: its pressure is 900 MPa"));
}
