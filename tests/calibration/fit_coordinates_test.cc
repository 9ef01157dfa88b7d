// SPDX-License-Identifier: LGPL-2.1-or-later

// Fits beside a condition of the law: what must not exceed another parameter.

#include <slipstep/calibration/fit.h>
#include <slipstep/calibration/fit_coordinates.h>
#include <slipstep/utilities/exceptions.h>

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "planted.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  const std::string static_path  = "Friction/Static coefficient",
                    kinetic_path = "Friction/softening/Kinetic coefficient";
} // namespace



// Of any coordinates the law takes the values, the nearest coordinates of which
// are the same, and their derivatives are right; whichever are free.
TEST_F(Planted, CoordinatesAreWhatTheLawTakes)
{
  plant(folder.path(), calibration_case(paper), {1., 200.}, 20, 5e-4, 1);
  std::mt19937                           random(3);
  std::uniform_real_distribution<double> between(0., 1.);
  for (const std::string scale : {"log", "linear"})
    {
      const Campaign campaign(
        fitting({{"Calibration/Parameters",
                  static_path +
                    " from 0.05 to 0.3 linear; Friction/softening/Rate "
                    "from 0.005 to 1; " +
                    kinetic_path + " from 0.03 to 0.4 " + scale}}));
      for (unsigned int n = 0; n < 100; ++n)
        for (const std::vector<unsigned int> &free :
             {std::vector<unsigned int>{0, 1, 2}, {0, 1}, {1, 2}})
          {
            Eigen::VectorXd x(3);
            for (double &one : x)
              one = between(random);
            // Some where both are the same.
            if (n % 10 == 0)
              x(2) = 1.;
            const FitCoordinates      all(campaign, {0.5, 0.5, 0.2}, {0, 1, 2});
            const std::vector<double> start = all.scaled(x);
            const FitCoordinates      coordinates(campaign, start, free);
            const Eigen::VectorXd     own = coordinates.of(start);
            // What is not free stays, and nothing has to be moved.
            for (unsigned int i = 0; i < 3; ++i)
              EXPECT_NEAR(coordinates.scaled(own)[i], start[i], 1e-12);
            Eigen::VectorXd moved = own;
            for (const unsigned int i : free)
              moved(i) = between(random);
            Simulator                 simulator(campaign);
            const std::vector<double> scaled = coordinates.scaled(moved);
            EXPECT_NO_THROW(FrictionLaw(simulator.with(scaled)));
            EXPECT_LT((coordinates.of(scaled) - moved).norm(), 1e-9);
            const Eigen::MatrixXd jacobian = coordinates.jacobian(moved);
            for (const unsigned int j : free)
              {
                constexpr double step = 1e-5;
                Eigen::VectorXd  less = moved, more = moved;
                less(j) -= step;
                more(j) += step;
                for (unsigned int i = 0; i < 3; ++i)
                  EXPECT_NEAR(jacobian(i, j),
                              (coordinates.scaled(more)[i] -
                               coordinates.scaled(less)[i]) /
                                (2. * step),
                              2e-4);
              }
          }
    }
}



// On the bounds, too, wherever those of the two begin.
TEST_F(Planted, CoordinatesOnBoundsAreWhatTheLawTakes)
{
  plant(folder.path(), calibration_case(paper), {1., 200.}, 20, 5e-4, 1);
  for (const std::string least : {"0.03", "0.05", "0.07"})
    {
      const Campaign campaign(
        fitting({{"Calibration/Parameters",
                  static_path + " from 0.05 to 0.3 log; " + kinetic_path +
                    " from " + least + " to 0.3 log"}}));
      const FitCoordinates coordinates(campaign, {0.5, 0.2}, {0, 1});
      Simulator            simulator(campaign);
      for (const double x : {0., 1.})
        for (const double share : {0., 0.5, 1.})
          EXPECT_NO_THROW(FrictionLaw(
            simulator.with(coordinates.scaled(Eigen::Vector2d(x, share)))))
            << least << ' ' << x << ' ' << share;
    }
}



// What the table of an effect says of the greatest value is what the law takes.
TEST(FitCoordinates, WhatIsAtMostAnotherKeyIsRefusedAbove)
{
  unsigned int n = 0;
  for (const auto &[name, info] : effect_registry())
    for (const EffectParameter &parameter : info.parameters)
      if (!parameter.at_most.empty())
        {
          ++n;
          const auto law_with =
            [&, name = name, &info = info](const double share) {
              Parameters   parameters = calibration_case({});
              const double most       = parameters.number(parameter.at_most);
              set_all({{"Friction/Effects", "subloading, overstress, " + name},
                       {info.section() + parameter.key,
                        quantity_text(parameters,
                                      info.section() + parameter.key,
                                      share * most)}},
                      parameters);
              FrictionLaw{parameters};
            };
          EXPECT_NO_THROW(law_with(0.9)) << name;
          EXPECT_NO_THROW(law_with(1.)) << name;
          EXPECT_THROW(law_with(1.01), InputError) << name;
        }
  EXPECT_GE(n, 1u);
}



// Friction that never falls is fitted best without a fall; a fit that may have
// one ends where one that has none does, from wherever it starts.
TEST_F(Planted, OnAConditionOfTheLawTheOthersAreAtTheirOptimum)
{
  const Settings truth = {{"Friction/Effects",
                           "subloading, overstress, run_in"},
                          {static_path, "0.12"},
                          {"Friction/run_in/Change", "0.05"},
                          {"Friction/run_in/Length", "2"}};
  plant(
    folder.path(), calibration_case(truth), {1., 20., 200.}, 150, 5e-4, 1, 10.);
  const auto fitted_with = [&](const std::string &rest,
                               const std::string &ties) {
    return calibrate(calibration_case(
      {{"Friction/Effects", "subloading, softening, overstress"},
       {"Calibration/Tests", folder.path().string()},
       {"Calibration/Starts", "1"},
       {"Calibration/Derived", ties},
       {"Calibration/Parameters",
        "Friction/overstress/Exponent from 4 to 80 start 15; "
        "Friction/subloading/Rate from 7 to 6000 start 300; " +
          static_path + " from 0.02 to 0.5" + rest}}));
  };
  const Calibration tied =
    fitted_with("", kinetic_path + " = {" + static_path + "}");
  for (const std::string start : {" start 0.2; ", " start 0.13; "})
    {
      const Calibration free =
        fitted_with(start + kinetic_path + " from 0.02 to 0.5 start 0.1", "");
      EXPECT_NEAR(free.misfit, tied.misfit, 1e-3 * tied.misfit) << start;
      EXPECT_NEAR(free.parameters[3].value, free.parameters[2].value, 1e-9);
      for (unsigned int i = 0; i < 3; ++i)
        EXPECT_NEAR(free.parameters[i].value,
                    tied.parameters[i].value,
                    0.01 * tied.parameters[i].value)
          << start << i;
    }
}
