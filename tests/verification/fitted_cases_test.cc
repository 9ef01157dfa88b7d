// SPDX-License-Identifier: LGPL-2.1-or-later

// The fits to published records: fitted.prm reproduces what its README tells.

#include "../solid/block_test_tools.h"

#include <slipstep/calibration/simulator.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  /// The rms difference of all rows over their noise, at the fitted values.
  double misfit_of(const std::string &case_file)
  {
    const Campaign            campaign(make_parameters({}, case_file));
    Simulator                 simulator(campaign);
    const std::vector<double> fitted = campaign.scaled_start();
    simulator.plan(fitted);
    simulator.correct(fitted);
    return std::sqrt(simulator.misfit(fitted) / campaign.n_residuals());
  }



  double area(const std::vector<double> &x, const std::vector<double> &friction)
  {
    double sum = 0.;
    for (std::size_t i = 1; i < x.size(); ++i)
      sum += (friction[i] + friction[i - 1]) / 2. * (x[i] - x[i - 1]);
    return sum;
  }
} // namespace



TEST(FittedCases, pins)
{
  EXPECT_NEAR(misfit_of("pps_ptfe_pin_on_disc/fitted.prm"), 0.89, 0.01);
}



// Uneven pressure under a higher pin makes 1.5 % more, see README.md.
TEST(FittedCases, pins_on_a_block)
{
  const std::string file     = "pps_ptfe_pin_on_disc/fitted.prm";
  const Settings    settings = {
       {"Loading/Programme", "press 1.197 MPa in 1 s; slide 0.15 m/s for 20 m"},
       {"Output/Fields", "none"}};
  const double point =
    point_history(make_parameters(settings, file)).back().friction;
  const auto on_block = [&](const std::string &size) {
    return run_block_case<3>(
             make_parameters(settings + Settings{{"Block/Size", size}}, file))
      .history.back()
      .friction;
  };
  EXPECT_NEAR(on_block("7.07 mm, 7.07 mm, 0.2 mm") / point, 1., 3e-4);
  EXPECT_NEAR(on_block("7.07 mm, 7.07 mm, 2 mm") / point, 1.0155, 1e-3);
}



TEST(FittedCases, loops)
{
  const std::string file = "reciprocating_tribometer/fitted.prm";
  EXPECT_NEAR(misfit_of(file), 2.12, 0.01);

  const Campaign            campaign(make_parameters({}, file));
  Simulator                 simulator(campaign);
  const std::vector<double> fitted = campaign.scaled_start();
  simulator.plan(fitted);
  simulator.correct(fitted);
  const MeasuredTest &rows     = campaign.tests[0].rows;
  const double        measured = area(rows.displacement, rows.friction);
  EXPECT_NEAR(measured, 4.845, 0.001);
  EXPECT_NEAR(area(rows.displacement, simulator.simulate(fitted, 0).friction) /
                measured,
              1.024,
              0.007);
}



TEST(FittedCases, velocity_step)
{
  EXPECT_NEAR(misfit_of("sepiolite_velocity_step/fitted.prm"), 3.20, 0.01);
}
