// SPDX-License-Identifier: LGPL-2.1-or-later

// The same point as that of a programme, and smooth in the parameters.

#include <slipstep/experiment/replay.h>

#include <boost/math/special_functions/expint.hpp>
#include <gtest/gtest.h>

#include <cmath>

#include "point_run.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  // 1 mm forth and 0.5 mm back, then under more pressure, and to the side.
  MeasuredTest zigzag()
  {
    MeasuredTest test;
    test.time           = {0., 10., 15., 16., 20.};
    test.displacement   = {0., 1., 0.5, 0.5, 0.9};
    test.displacement_y = {0., 0., 0., 0., 0.3};
    test.pressure       = {5.8, 5.8, 5.8, 8., 8.};
    test.friction.assign(5, 0.);
    return test;
  }

  std::vector<double> friction_at(const Parameters          &parameters,
                                  const double               tolerance,
                                  const std::vector<double> &times,
                                  const double               lead_in = 0.,
                                  const double        row_distance   = 1e30,
                                  const MeasuredTest &test           = zigzag())
  {
    const FrictionLaw law(parameters);
    const Machine     machine(parameters);
    Replay            replay(test, lead_in, row_distance);
    replay.plan(law, machine, tolerance);
    Replay::Curve curve;
    replay.simulate(law, machine, curve);
    return replay.at(curve.friction, times);
  }
} // namespace



TEST(Replay, AgreesWithTheProgrammeOfTheSameMotion)
{
  const Parameters parameters = point_parameters(
    {{"Loading/Programme",
      "press 5.8 MPa in 1 s; slide 0.1 mm/s for 1 mm; slide -0.1 mm/s for 0.5 "
      "mm; press 8 MPa in 1 s; slide 0.125 mm/s for 0.5 mm at 36.86989764584402 "
      "deg"},
     {"Time stepping/Tolerance", "1e-8"}});
  const FrictionLaw law(parameters);
  const auto        history = point_history(parameters);

  Replay replay(zigzag());
  replay.plan(law, Machine(), 1e-8);
  Replay::Curve curve;
  replay.simulate(law, Machine(), curve);
  std::vector<double> times, friction, friction_y;
  for (const HistoryRow &row : history)
    if (row.time > 1.)
      {
        times.push_back(row.time - 1.);
        friction.push_back(row.friction);
        friction_y.push_back(row.friction_y);
      }
  const auto x = replay.at(curve.friction, times);
  const auto y = replay.at(curve.friction_y, times);
  for (std::size_t i = 0; i < times.size(); ++i)
    {
      // The fast relaxation at rest is the hardest.
      ASSERT_NEAR(x[i], friction[i], 2e-4) << times[i];
      ASSERT_NEAR(y[i], friction_y[i], 2e-4) << times[i];
    }
}



// Contacts that nothing renews are as old as the test.
TEST(Replay, ContactsAreYoungWhereATestBegins)
{
  const auto friction =
    friction_at(point_parameters(
                  {{"Friction/Effects", "ageing"},
                   {"Friction/Static coefficient", "0.1"},
                   {"Friction/ageing/Growth", "0.02"},
                   {"Friction/ageing/Time", "1 ms"},
                   {"Friction/ageing/Renewal length", "1e9 mm"}}),
                1e-6,
                {0.5, 5.},
                0.,
                0.01);
  EXPECT_NEAR(friction[0], 0.1 * (1. + 0.02 * std::log1p(0.5 / 1e-3)), 1e-6);
  EXPECT_NEAR(friction[1], 0.1 * (1. + 0.02 * std::log1p(5. / 1e-3)), 1e-6);
}



// Slip over the length is long between the rows, and the contact lags behind a
// pressure that falls evenly: ln(p_m/p) = exp(u) E_1(u), u = p/(L
// |dp/dlambda|).
TEST(Replay, AContactLagsBehindThePressure)
{
  MeasuredTest test;
  test.time         = {0., 0.1, 2.};
  test.displacement = {0., 0.1, 2.};
  test.pressure     = {15., 15., 0.1};
  test.friction.assign(3, 0.);
  const double u = 0.1 / (0.002 * 14.9 / 1.9);
  const double exact =
    0.2 * std::exp(-0.5 * std::exp(u) * boost::math::expint(-u));
  for (const double tolerance : {5e-3, 5e-4, 5e-5})
    EXPECT_NEAR(friction_at(point_parameters(
                              {{"Friction/Effects", "pressure_memory"},
                               {"Friction/Static coefficient", "0.2"},
                               {"Friction/Tangential stiffness", "1e4"},
                               {"Friction/pressure_memory/Change", "0.5"},
                               {"Friction/pressure_memory/Slip length",
                                "0.002 mm"}}),
                            tolerance,
                            {2.},
                            0.,
                            1e30,
                            test)[0],
                exact,
                tolerance * exact);
}



TEST(Replay, ErrorFallsWithTheTolerance)
{
  const Parameters          parameters = point_parameters({});
  const std::vector<double> times      = {1., 9., 12., 18., 20.};
  const auto                exact      = friction_at(parameters, 1e-9, times);
  for (const double tolerance : {1e-3, 1e-4, 1e-5})
    {
      const auto coarse = friction_at(parameters, tolerance, times);
      for (std::size_t i = 0; i < times.size(); ++i)
        EXPECT_NEAR(coarse[i], exact[i], 0.01 * std::sqrt(tolerance))
          << times[i];
    }
}



// Without an overstress the law is exact for steps of any length, so that only
// straight lines between their ends are wrong.
TEST(Replay, FollowsTheCurveBetweenTheEndsOfSteps)
{
  std::vector<double> times;
  for (double t = 0.01; t < 20.; t += 0.01)
    times.push_back(t);
  for (const std::string effects :
       {"subloading", "subloading, softening", "subloading, overstress"})
    {
      const Parameters parameters =
        point_parameters({{"Friction/Effects", effects},
                          {"Friction/subloading/Rate", "50"},
                          {"Friction/Static coefficient", "0.13"}});
      const auto error = [&](const double row_distance) {
        const std::vector<double> exact =
          friction_at(parameters, 1e-7, times, 0., 1e-3);
        const std::vector<double> found =
          friction_at(parameters, 5e-4, times, 0., row_distance);
        double largest = 0.;
        for (std::size_t i = 0; i < times.size(); ++i)
          largest = std::max(largest, std::abs(found[i] - exact[i]) / 0.13);
        return largest;
      };
      EXPECT_LT(error(0.01), 6e-3) << effects;
      EXPECT_GT(error(1e30), 1e-2) << effects;
    }
}



// The load stays at rest, so that friction falls as one over the pressure:
// right after sliding, and when all has been quiet for long.
TEST(Replay, FollowsTheFrictionWhileThePressureGrows)
{
  const FrictionLaw law(
    point_parameters({{"Friction/Effects", "subloading"},
                      {"Friction/Static coefficient", "0.13"}}));
  for (const double rest : {0., 1000.})
    {
      MeasuredTest test;
      test.time         = {0., 10.};
      test.displacement = {0., 1.};
      test.pressure     = {3., 3.};
      if (rest > 0.)
        {
          test.time.push_back(10. + rest);
          test.displacement.push_back(1.);
          test.pressure.push_back(3.);
        }
      const double begin = test.time.back();
      test.time.push_back(begin + 2.);
      test.displacement.push_back(1.);
      test.pressure.push_back(6.);
      test.friction.assign(test.time.size(), 0.);
      Replay replay(test, 0., 0.1);
      replay.plan(law, Machine(), 5e-4);
      Replay::Curve curve;
      replay.simulate(law, Machine(), curve);
      std::vector<double> times;
      for (double t = begin + 0.1; t < begin + 2.; t += 0.1)
        times.push_back(t);
      const std::vector<double> found = replay.at(curve.friction, times);
      for (std::size_t i = 0; i < times.size(); ++i)
        EXPECT_NEAR(found[i], 0.13 * 3. / (3. + 1.5 * (times[i] - begin)), 6e-4)
          << rest;
    }
}



// A slider that is lifted turns in the air.
TEST(Replay, MovesOffThePlane)
{
  MeasuredTest test;
  test.time         = {0., 1., 2., 3.};
  test.displacement = {0., 1., 0.5, 0.5};
  test.pressure     = {0., 0., 0., 0.};
  test.friction.assign(4, 0.);
  const FrictionLaw law(point_parameters({{"Friction/Effects", "subloading"}}));
  Replay            replay(test);
  replay.plan(law, Machine(), 5e-4, 1000);
  Replay::Curve curve;
  replay.simulate(law, Machine(), curve);
  for (const double friction : curve.friction)
    EXPECT_EQ(friction, 0.);
}



// Where friction jumps with speed no step is short enough, and none is nothing.
TEST(Replay, TakesNoStepOfNothing)
{
  const Parameters parameters =
    point_parameters({{"Friction/Effects", "subloading, stribeck"},
                      {"Friction/stribeck/Rise", "0.5"},
                      {"Friction/stribeck/Speed", "0.01 mm/s"},
                      {"Friction/stribeck/Exponent", "10"}});
  Replay replay(zigzag());
  replay.plan(FrictionLaw(parameters), Machine(parameters), 5e-4, 10000);
  const std::vector<double> &times = replay.times();
  for (std::size_t i = 1; i < times.size(); ++i)
    EXPECT_GT(times[i], times[i - 1]) << i;
}



// What halving leaves is a third of what it took away: steps of second order.
TEST(Replay, HalvingTheStepsQuartersTheError)
{
  const Parameters          parameters = point_parameters({});
  const FrictionLaw         law(parameters);
  const std::vector<double> times = {0.05, 9.};
  Replay                    replay(zigzag());
  replay.plan(law, Machine(), 1e-5);
  const auto friction = [&](const Replay &some) {
    Replay::Curve curve;
    some.simulate(law, Machine(), curve);
    return some.at(curve.friction, times);
  };
  const auto whole = friction(replay), half = friction(replay.halved()),
             quarter = friction(replay.halved().halved());
  EXPECT_EQ(replay.halved().n_steps(), 2 * replay.n_steps());
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_GT((whole[i] - half[i]) / (half[i] - quarter[i]), 3.5) << times[i];
}



// After the same plan, second differences in a parameter are those of the
// physics: they fall with the square of the difference.
TEST(Replay, IsSmoothInTheParameters)
{
  const auto friction = [](const double viscosity) {
    static Replay     replay(zigzag());
    static const bool planned = [] {
      const Parameters parameters = point_parameters({});
      replay.plan(FrictionLaw(parameters), Machine(), 1e-5);
      return true;
    }();
    EXPECT_TRUE(planned);
    const Parameters parameters = point_parameters(
      {{"Friction/overstress/Viscosity", std::to_string(viscosity)}});
    Replay::Curve curve;
    replay.simulate(FrictionLaw(parameters), Machine(), curve);
    return replay.at(curve.friction, {8.}).front();
  };
  const auto bend = [&](const double step) {
    return friction(11500. + step) - 2. * friction(11500.) +
           friction(11500. - step);
  };
  EXPECT_NEAR(bend(200.) / bend(100.), 4., 0.01);
}



// Friction at a row is against the motion there. An elastic slip of 1e-4 mm
// turns with it.
TEST(Replay, FollowsTheDirectionOfCircles)
{
  constexpr double   radius = 2.;
  constexpr unsigned n      = 90;

  MeasuredTest test;
  for (unsigned int i = 0; i <= n; ++i)
    {
      const double phase = 6.283185307179586 * i / n;
      test.time.push_back(0.1 * i);
      test.displacement.push_back(radius * std::cos(phase));
      test.displacement_y.push_back(radius * std::sin(phase));
      test.pressure.push_back(5.);
      test.friction.push_back(0.);
      test.friction_y.push_back(0.);
    }
  const auto parameters =
    point_parameters({{"Friction/Effects", "subloading"},
                      {"Friction/Static coefficient", "0.2"},
                      {"Friction/Tangential stiffness", "1e4"}});
  const FrictionLaw law(parameters);
  const Machine     machine(parameters);
  Replay            replay(test);
  replay.plan(law, machine, 1e-4);
  Replay::Curve curve;
  replay.simulate(law, machine, curve);
  const auto along_x = replay.at(curve.friction, test.time),
             along_y = replay.at(curve.friction_y, test.time);
  for (unsigned int i = 3; i < n; ++i)
    {
      const double phase = 6.283185307179586 * i / n;
      // Half of the turn of a row is 0.035, of 0.2 that is 0.007.
      EXPECT_NEAR(along_x[i], -0.2 * std::sin(phase), 4e-4) << i;
      EXPECT_NEAR(along_y[i], 0.2 * std::cos(phase), 4e-4) << i;
    }
}



TEST(Replay, ALeadInStartsWhileSliding)
{
  const Parameters  parameters = point_parameters({});
  const FrictionLaw law(parameters);
  Replay            replay(zigzag(), 500.);
  replay.plan(law, Machine(), 1e-5);
  Replay::Curve curve;
  replay.simulate(law, Machine(), curve);
  // The kinetic coefficient at 0.1 mm/s, from the first row on.
  EXPECT_EQ(replay.times().front(), 0.);
  EXPECT_NEAR(curve.friction.front(), 0.098 * law.steady_ratio(0.1), 1e-6);
  EXPECT_NEAR(curve.friction.front(), replay.at(curve.friction, {5.})[0], 1e-6);
}



// As which test of its campaign a record was made is its own affair, whatever
// the case says of runs.
TEST(Replay, HasTheOrderOfItsTest)
{
  const Parameters parameters =
    point_parameters({{"Friction/Effects", "run_order"},
                      {"Friction/Static coefficient", "0.2"},
                      {"Friction/run_order/Change", "0.5"},
                      {"Friction/run_order/First test", "0"},
                      {"Friction/run_order/Last test", "20"},
                      {"Friction/run_order/Test", "10"}});
  const FrictionLaw law(parameters);
  const auto        last_friction = [&](const std::string &order) {
    MeasuredTest test = zigzag();
    if (!order.empty())
      test.notes["order"] = order;
    Replay replay(test);
    replay.plan(law, Machine(), 1e-6);
    Replay::Curve curve;
    replay.simulate(law, Machine(), curve);
    return std::hypot(curve.friction.back(), curve.friction_y.back());
  };
  EXPECT_NEAR(last_friction("0"), 0.2, 1e-9);
  EXPECT_NEAR(last_friction("5"), 0.2 * (1. + 0.5 * 5. / 20.), 1e-9);
  EXPECT_NEAR(last_friction("20"), 0.3, 1e-9);
  EXPECT_NEAR(last_friction("200"), 0.3, 1e-9);
  EXPECT_NEAR(last_friction(""), 0.25, 1e-9);
}
