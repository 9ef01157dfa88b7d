// SPDX-License-Identifier: LGPL-2.1-or-later

// What a calibration warns of.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "planted.h"
#include "tests/file_text.h"
#include "tests/temporary_folder.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  Parameters one_coefficient(const TemporaryFolder &folder,
                             const std::string     &noise = "")
  {
    Settings settings = {{"Calibration/Tests", folder.path().string()},
                         {"Calibration/Starts", "1"},
                         {"Calibration/Parameters",
                          "Friction/Static coefficient from 0.05 to 0.2"}};
    if (!noise.empty())
      settings.emplace_back("Calibration/Noise", noise);
    return calibration_case(settings);
  }

  MeasuredTest steady_sliding()
  {
    MeasuredTest sliding;
    for (unsigned int i = 0; i < 100; ++i)
      {
        sliding.time.push_back(i);
        sliding.displacement.push_back(0.1 * i);
        sliding.pressure.push_back(5.);
        sliding.friction.push_back(0.1 + 0.001 * (i % 2));
      }
    return sliding;
  }
} // namespace



// Where both coefficients end at their upper bound they are equal, which is
// not what stops either.
TEST(CalibrationWarnings, ABoundIsNoConditionOfTheLaw)
{
  const TemporaryFolder folder;
  plant(folder.path(),
        calibration_case({{"Friction/Static coefficient", "0.4"},
                          {"Friction/softening/Kinetic coefficient", "0.3"}}),
        {1., 10.},
        50,
        1e-3,
        4);
  const Calibration found = calibrate(calibration_case(
    {{"Calibration/Tests", folder.path().string()},
     {"Calibration/Starts", "1"},
     {"Calibration/Parameters",
      "Friction/Static coefficient from 0.05 to 0.2; "
      "Friction/softening/Kinetic coefficient from 0.05 to 0.2"}}));
  for (const FittedParameter &fitted : found.parameters)
    {
      EXPECT_TRUE(fitted.is_at_bound);
      EXPECT_EQ(fitted.constraint, "");
    }
}



// What many tests have in common is told three times.
TEST(CalibrationWarnings, AlikeOnesAreToldThreeTimes)
{
  const TemporaryFolder folder;
  for (unsigned int number = 0; number < 5; ++number)
    {
      MeasuredTest constant;
      for (unsigned int i = 0; i < 100; ++i)
        {
          constant.time.push_back(i);
          constant.displacement.push_back(i);
          constant.pressure.push_back(5.8);
          constant.friction.push_back(0.13 + 0.01 * number);
        }
      write_measured_test(folder.path() / (std::to_string(number) + ".csv"),
                          constant);
    }
  const std::vector<std::string> warnings =
    Campaign(one_coefficient(folder)).warnings();
  ASSERT_EQ(warnings.size(), 3u);
  EXPECT_TRUE(contains(warnings[1], "hardly any noise is visible"));
  EXPECT_FALSE(contains(warnings[1], "more)"));
  EXPECT_TRUE(contains(warnings[2], "(and so in 2 more)")) << warnings[2];
}



TEST(CalibrationWarnings, AWrongNoiseThatIsStatedIsTold)
{
  const TemporaryFolder folder;
  plant(folder.path(), one_coefficient(folder), {1., 20., 200.}, 100, 1e-3, 5);
  const auto warnings_with = [&](const std::string &noise) {
    std::string text;
    for (const std::string &warning :
         calibrate(one_coefficient(folder, noise)).warnings)
      text += warning + "\n";
    return text;
  };
  const std::string large = warnings_with("1e-2"),
                    right = warnings_with("1e-3"),
                    small = warnings_with("1e-4");
  EXPECT_TRUE(contains(large, "the noise that is stated")) << large;
  EXPECT_TRUE(contains(large, "the stated noise is too large")) << large;
  EXPECT_FALSE(contains(right, "the noise that is stated")) << right;
  EXPECT_TRUE(contains(small, "which is too small")) << small;
}



// Of few rows the noise may seem to be anything: they do not outweigh others.
TEST(CalibrationWarnings, FewRowsDoNotOutweighOthers)
{
  const auto noise_of = [](const unsigned int n_rows) {
    const TemporaryFolder folder;
    std::mt19937_64       random(n_rows);
    for (unsigned int number = 0; number < 12; ++number)
      {
        std::normal_distribution<double> noise(0.13, 1e-3);
        MeasuredTest                     test;
        for (unsigned int i = 0; i < n_rows; ++i)
          {
            test.time.push_back(i);
            test.displacement.push_back(i);
            test.pressure.push_back(5.8);
            test.friction.push_back(noise(random));
          }
        write_measured_test(folder.path() / (std::to_string(number) + ".csv"),
                            test);
      }
    return Campaign(one_coefficient(folder)).tests;
  };
  for (const unsigned int n_rows : {10, 15, 25})
    for (const CampaignTest &test : noise_of(n_rows))
      {
        EXPECT_GT(test.axes[0].noise, 0.4e-3) << n_rows;
        EXPECT_LT(test.axes[0].noise, 2e-3) << n_rows;
      }
  const auto few = noise_of(4);
  EXPECT_TRUE(contains(few[0].rows.warnings.back(),
                       "it has too few rows to estimate its noise"));
}



// Of friction that stays within a step neither step nor noise are seen: it was
// rounded like that of the others, and tells no more.
TEST(CalibrationWarnings, RoundedFrictionDoesNotOutweighOthers)
{
  const TemporaryFolder            folder;
  std::mt19937_64                  random(1);
  std::normal_distribution<double> noise(0., 1e-3);
  for (unsigned int number = 0; number < 3; ++number)
    {
      MeasuredTest test;
      for (unsigned int i = 0; i < 200; ++i)
        {
          const double friction =
            0.13 + (number == 2 ? 0.1 * noise(random) :
                                  noise(random) + 0.02 * std::exp(-0.02 * i));
          test.time.push_back(i);
          test.displacement.push_back(i);
          test.pressure.push_back(5.8);
          test.friction.push_back(0.005 * std::round(friction / 0.005));
        }
      write_measured_test(folder.path() / (std::to_string(number) + ".csv"),
                          test);
    }
  for (const CampaignTest &test : Campaign(one_coefficient(folder)).tests)
    {
      EXPECT_GE(test.axes[0].noise, 0.999 * 0.005 / std::sqrt(12.));
      EXPECT_NEAR(test.rounding.step, 0.005, 1e-9);
    }
}



// An effect that counts positions from where a test begins is told of tests
// that begin elsewhere; others do not mind.
TEST(CalibrationWarnings, TestsThatBeginElsewhereAreTold)
{
  const auto is_told =
    [&](const double x, const double y, const std::string &effects) {
      const TemporaryFolder folder;
      for (const double share : {0., 1.})
        {
          MeasuredTest test;
          for (unsigned int i = 0; i < 50; ++i)
            {
              test.time.push_back(i);
              test.displacement.push_back(share * x + 0.1 * i);
              test.displacement_y.push_back(share * y + 0.1 * i);
              test.pressure.push_back(5.8);
              const double friction = 0.09 + 1e-3 * std::sin((7. + share) * i);
              test.friction.push_back(friction);
              test.friction_y.push_back(friction);
            }
          write_measured_test(folder.path() / (std::to_string(share) + ".csv"),
                              test);
        }
      Parameters parameters = one_coefficient(folder);
      parameters.set("Friction/Effects", effects, "test");
      std::string text;
      for (const std::string &warning : Campaign(parameters).warnings())
        text += warning + "\n";
      return contains(text, "begin at different positions, from 0 to 12.3 mm");
    };
  EXPECT_FALSE(is_told(12.3, 0., "subloading"));
  EXPECT_TRUE(is_told(12.3, 0., "subloading, texture"));
  EXPECT_TRUE(is_told(0., 12.3, "subloading, texture"));
  EXPECT_FALSE(is_told(0., 0., "subloading, texture"));
}



// Effect run_order needs the number of every test, between its ends.
TEST(CalibrationWarnings, TestsWithoutAnOrderAreTold)
{
  const TemporaryFolder folder;
  std::mt19937          random(4);
  const auto            words = [&](const std::vector<std::string> &orders) {
    for (std::size_t i = 0; i < orders.size(); ++i)
      {
        MeasuredTest test =
          planted_test(calibration_case({}), 1. / 60., 1., 60, 1e-3, random);
        if (!orders[i].empty())
          test.notes["order"] = orders[i];
        write_measured_test(folder.path() / (std::to_string(i) + ".csv"), test);
      }
    Parameters parameters = one_coefficient(folder);
    parameters.set("Friction/Effects", "run_order", "test");
    parameters.set("Friction/run_order/Last test", "9", "test");
    std::string all;
    for (const std::string &warning : Campaign(parameters).warnings())
      all += warning + "; ";
    return all;
  };
  EXPECT_FALSE(contains(words({"1", "9", "4"}), "order"));
  EXPECT_TRUE(contains(words({"1", "", "4"}),
                       "1 of the tests do not say in which order they were "
                       "made ('# order: 7'), and are given "
                       "Friction/run_order/Test = 20"));
  EXPECT_TRUE(contains(words({"0", "10", "4"}),
                       "2 of the tests were made before Friction/run_order/"
                       "First test = 1 or after"));
}



// A soft machine whose spring is longer than the lead-in; a stiff one slides.
TEST(CalibrationWarnings, TheLeadInIsTooShort)
{
  const TemporaryFolder folder;
  const MeasuredTest    sliding = steady_sliding();
  for (const char *name : {"a", "b"})
    write_measured_test(folder.path() / (std::string(name) + ".csv"), sliding);
  const auto words = [&](const std::string &stiffness) {
    Parameters parameters = one_coefficient(folder);
    parameters.set("Calibration/Lead-in", "0.2 mm", "test");
    parameters.set("Loading/Machine stiffness", stiffness, "test");
    std::string result;
    for (const std::string &warning : Campaign(parameters).warnings())
      if (contains(warning, "Lead-in"))
        result += warning;
    return result;
  };
  EXPECT_TRUE(contains(words("1 MPa/mm"), "deflect by 0.5 mm"))
    << words("1 MPa/mm");
  EXPECT_TRUE(contains(words("1 MPa/mm"), "a.csv"));
  EXPECT_TRUE(contains(words("1 MPa/mm"), "(and so in 1 more)"));
  EXPECT_EQ(words("10 MPa/mm"), "");
}



// Friction of a spring of 1 MPa/mm that slips every 0.5 mm.
TEST(CalibrationWarnings, StickSlipWithoutItsSpring)
{
  const TemporaryFolder folder;
  MeasuredTest          sliding = steady_sliding();
  for (std::size_t i = 0; i < sliding.time.size(); ++i)
    sliding.friction[i] =
      0.1 + std::fmod(sliding.displacement[i], 0.5) / sliding.pressure[i];
  write_measured_test(folder.path() / "a.csv", sliding);
  const auto words = [&](const std::string &stiffness) {
    Parameters parameters = one_coefficient(folder);
    parameters.set("Loading/Machine stiffness", stiffness, "test");
    std::string result;
    for (const std::string &warning : Campaign(parameters).warnings())
      if (contains(warning, "stick-slip"))
        result += warning;
    return result;
  };
  EXPECT_TRUE(contains(words("rigid"), "on a spring of 1 MPa/mm"))
    << words("rigid");
  EXPECT_EQ(words("1 MPa/mm"), "");
}



TEST(CalibrationWarnings, TwoTestsHaveOneName)
{
  const TemporaryFolder folder;
  MeasuredTest          sliding = steady_sliding();
  for (const char *name : {"a", "b"})
    {
      sliding.name = name;
      write_measured_test(folder.path() / (std::string(name) + ".csv"),
                          sliding);
      for (double &friction : sliding.friction)
        friction *= 1.01;
    }
  const auto n_warnings = [&]() {
    unsigned int n = 0;
    for (const std::string &warning :
         Campaign(one_coefficient(folder)).warnings())
      n += contains(warning, "b.csv have the same name, 'a'");
    return n;
  };
  EXPECT_EQ(n_warnings(), 0u);
  sliding.name = "a";
  write_measured_test(folder.path() / "b.csv", sliding);
  EXPECT_EQ(n_warnings(), 1u);
}
