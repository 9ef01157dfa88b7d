// SPDX-License-Identifier: LGPL-2.1-or-later

// What tests cannot tell is named, with what would, and does not spoil the
// deviations of the rest.

#include <slipstep/calibration/advice.h>

#include <gtest/gtest.h>

#include <cmath>

#include "tests/file_text.h"
#include "planted.h"
#include "tests/temporary_folder.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  // The constants of the source paper, its coefficients as read at 1 mm/min.
  const Settings law = {{"Friction/Static coefficient", "0.0899"},
                        {"Friction/softening/Kinetic coefficient", "0.0766"}};

  Calibration fitted_to(const TemporaryFolder &folder,
                        const Settings        &truth,
                        const double           noise,
                        const std::string     &parameters)
  {
    plant(folder.path(),
          calibration_case(truth),
          {1., 10., 50., 200.},
          100,
          noise,
          3);
    Settings settings = truth;
    settings.emplace_back("Calibration/Tests", folder.path().string());
    settings.emplace_back("Calibration/Parameters", parameters);
    return calibrate(calibration_case(settings));
  }
} // namespace



// Coefficients and overstress from the speeds of the source paper: a law with
// other r(V) and coefficients divided by it fits as well.
TEST(WeakDirections, WhatCannotBeFoundTogetherIsNamed)
{
  const TemporaryFolder folder;
  const Calibration     found =
    fitted_to(folder,
              law,
              5e-3,
              "Friction/Static coefficient from 0.001 to 0.5; "
              "Friction/softening/Kinetic coefficient from 0.001 to 0.5; "
              "Friction/overstress/Viscosity from 1 to 1e12; "
              "Friction/overstress/Exponent from 2 to 100");
  ASSERT_FALSE(found.weak.empty());
  const std::string words = found.weak.front().words;
  for (const char *part : {"Friction/softening/Kinetic coefficient",
                           "Friction/overstress/Viscosity",
                           "cannot all be found from these tests",
                           "Fix one of them; sliding at "})
    EXPECT_TRUE(contains(words, part));
  EXPECT_LT(found.correlation[1][2], -0.95);
  // What moves together is found: the levels.
  EXPECT_GT(found.correlation[0][1], 0.99);
}



// Under one pressure its reference is another coefficient, and so it is under
// any: no test tells. What is known beside that stays known.
TEST(WeakDirections, WhatNoTestCanTellSpoilsNothingElse)
{
  const TemporaryFolder folder;
  const std::string     with_pressure =
    "subloading, overstress, softening, pressure";
  Settings truth = law;
  truth.emplace_back("Friction/Effects", with_pressure);
  truth.emplace_back("Friction/pressure/Exponent", "0.1");
  truth.emplace_back("Friction/pressure/Reference pressure", "5 MPa");
  const std::string known = "Friction/softening/Rate from 0.005 to 1 start 0.1";
  const Calibration alone = fitted_to(folder, truth, 5e-4, known);
  truth.emplace_back("Calibration/Derived",
                     "Friction/softening/Kinetic coefficient = 0.852 * "
                     "{Friction/Static coefficient}");
  const Calibration found =
    fitted_to(folder,
              truth,
              5e-4,
              known +
                "; Friction/Static coefficient from 0.08 to 0.2 start 0.1; "
                "Friction/pressure/Reference pressure from 1 to 20 start 7");
  const FittedParameter &rate = found.parameters[0];
  EXPECT_LT(rate.deviation, 3. * alone.parameters[0].deviation);
  EXPECT_LT(std::abs(found.correlation[0][2]), 0.9);
  ASSERT_EQ(found.weak.size(), 1u);
  const std::string &words = found.weak[0].words;
  for (const char *part :
       {"Friction/Static coefficient and Friction/pressure/Reference pressure "
        "cannot both be found",
        "no other speed, pressure, path, rest or direction would help"})
    EXPECT_TRUE(contains(words, part)) << words;
  // They do fit as well.
  const double coefficient = found.weak[0].change[1];
  const double reference   = found.weak[0].change[2];
  EXPECT_GT(std::abs(reference), 0.5);
  EXPECT_NEAR(std::log1p(coefficient / found.parameters[1].value),
              -0.1 * reference,
              0.03);
}



// What is proposed beside tests along x is so beside those along any line.
TEST(ProposedTests, AreTheSameAlongEveryLine)
{
  const auto proposed = [](const double angle) {
    MeasuredTest test;
    for (int i = 0; i <= 100; ++i)
      {
        test.time.push_back(0.1 * i);
        test.displacement.push_back(0.02 * i * std::cos(angle));
        test.displacement_y.push_back(0.02 * i * std::sin(angle));
        test.pressure.push_back(1.);
        test.friction.push_back(i == 0 ? 0. : 0.08 * std::cos(angle));
        test.friction_y.push_back(i == 0 ? 0. : 0.08 * std::sin(angle));
      }
    const Campaign campaign(calibration_case(law),
                            std::vector<FitParameter>(),
                            {{test,
                              {{std::cos(angle), std::sin(angle), 0.001}},
                              true,
                              Replay(test)}});
    std::string    words;
    for (const ProposedTest &test : propose_tests(campaign))
      words += test.words + "\n";
    return words;
  };
  const std::string along_x = proposed(0.);
  EXPECT_NE(along_x.find("sliding at"), std::string::npos);
  for (const double degrees : {45., 90., 180., 270.})
    EXPECT_EQ(proposed(degrees * std::acos(-1.) / 180.), along_x) << degrees;
}
