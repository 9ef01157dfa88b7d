// SPDX-License-Identifier: LGPL-2.1-or-later

// The reference of the programmes in time is right itself: closed forms, and
// that its own error is far below those it measures.

#include "../experiment/point_run.h"
#include "reference_contact.h"

#include <deal.II/base/numbers.h>

#include <boost/math/special_functions/expint.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  ReferenceContact reference_of(const Settings &settings,
                                const double    tolerance = 1e-9)
  {
    const Parameters parameters = point_parameters(settings);
    return {parameters, parse_programme(parameters), tolerance};
  }
} // namespace



TEST(ReferenceContact, first_slip_without_rate_effect)
{
  // s = f/alpha + slip, with the slip from the closed forms of r_s = r.
  const double f_n = 5., mu = 0.1, alpha = 1e4, u = 200., speed = 1e-3;
  for (const std::string form : {"cot", "log"})
    {
      const auto reference =
        reference_of({{"Friction/Effects", "subloading"},
                      {"Friction/Static coefficient", "0.1"},
                      {"Friction/subloading/Form", form},
                      {"Loading/Programme",
                       "press 5 MPa in 1 s; slide 1 um/s for 30 um"}},
                     1e-10);
      for (const double r : {0.001, 0.01, 0.1, 0.5, 0.9, 0.99})
        {
          const double slip =
            form == "log" ? boost::math::expint(1, -std::log(r)) / u :
                            -2. / (dealii::numbers::PI * u) *
                              std::log(std::cos(dealii::numbers::PI * r / 2.));
          const double s      = r * mu * f_n / alpha + slip;
          const auto   answer = reference.at(1. + s / speed);
          EXPECT_NEAR(answer.friction[0] / mu, r, 1e-9) << form << r;
          EXPECT_NEAR(answer.normal_ratio, r, 1e-9) << form << r;
        }
    }
}



TEST(ReferenceContact, steady_sliding_at_four_speeds)
{
  const double speeds[] = {1., 10., 50., 200.};
  const double ratios[] = {1.2793, 1.4019, 1.4850, 1.5540};
  for (unsigned int i = 0; i < 4; ++i)
    {
      const auto reference = reference_of(
        {{"Friction/Effects", "subloading, overstress"},
         {"Friction/Static coefficient", "0.078"},
         {"Loading/Speed", std::to_string(speeds[i]) + " mm/min"},
         {"Loading/Programme", "press 5.8 MPa in 1 s; slide for 1 mm"}});
      const double end = 1. + 60. / speeds[i];
      EXPECT_NEAR(reference.at(end).friction[0], 0.078 * ratios[i], 5e-6);
      EXPECT_NEAR(reference.at(end).friction[0],
                  0.078 * reference.law().steady_ratio(speeds[i] / 60.),
                  1e-9);
    }
}



TEST(ReferenceContact, coefficient_over_slip_and_over_time)
{
  const double mu_s = 0.12, mu_k = 0.08, kappa = 0.5, a = 3., xi = 1e-4,
               b = 50., speed = 0.1, p = 5., alpha = 1e4;
  const auto sliding = reference_of(
    {{"Friction/Effects", "softening"},
     {"Friction/Static coefficient", "0.12"},
     {"Friction/softening/Kinetic coefficient", "0.08"},
     {"Friction/softening/Rate", "0.5"},
     {"Friction/softening/Steepness", "3"},
     {"Loading/Programme", "press 5 MPa in 1 s; slide 0.1 mm/s for 2 mm"}});
  for (const double t : {2., 5., 11., 21.})
    {
      const auto   answer = sliding.at(t);
      const double slip   = speed * (t - 1.) - answer.friction[0] * p / alpha;
      const double mu =
        mu_k - std::log(1. - (1. - std::exp(-a * (mu_s - mu_k))) *
                               std::exp(-a * kappa * slip)) /
                 a;
      EXPECT_NEAR(answer.friction[0], mu, 1e-9);
    }
  const auto resting =
    reference_of({{"Friction/Effects", "healing"},
                  {"Friction/Static coefficient", "0.12"},
                  {"Friction/Initial coefficient", "0.08"},
                  {"Friction/healing/Rate", "1e-4"},
                  {"Friction/healing/Steepness", "50"},
                  {"Loading/Programme", "press 5 MPa in 1 s; hold 1000 s"}});
  for (const double t : {1., 10., 1001.})
    EXPECT_NEAR(resting.at(t).coefficient,
                mu_s + std::log1p(-(1. - std::exp(-b * (mu_s - mu_k))) *
                                  std::exp(-b * xi * t)) /
                         b,
                1e-10);
}



TEST(ReferenceContact, traction_turns_on_the_ellipse)
{
  const auto reference =
    reference_of({{"Friction/Effects", "anisotropy"},
                  {"Friction/Static coefficient", "0.1"},
                  {"Friction/anisotropy/Ratio", "0.6"},
                  {"Loading/Programme",
                   "press 5 MPa in 1 s; slide 1 mm/s for 1 mm at 40 deg"}});
  const double x    = std::cos(40. * dealii::numbers::PI / 180.),
               y    = 0.6 * std::sin(40. * dealii::numbers::PI / 180.);
  const auto answer = reference.at(2.);
  EXPECT_NEAR(answer.friction[0], 0.1 * x / std::hypot(x, y), 1e-8);
  EXPECT_NEAR(answer.friction[1], 0.06 * y / std::hypot(x, y), 1e-8);
}



TEST(ReferenceContact, spring_and_stick_in_series)
{
  const double k = 50., alpha = 1e4;
  const auto   reference = reference_of(
    {{"Friction/Effects", ""},
       {"Friction/Static coefficient", "0.1"},
       {"Loading/Machine stiffness", "50"},
       {"Loading/Programme", "press 5 MPa in 1 s; slide 1 mm/s for 0.1 mm"}});
  for (const double s : {0.002, 0.005, 0.01, 0.05, 0.1})
    {
      const double force = std::min(0.5, k * alpha / (k + alpha) * s);
      EXPECT_NEAR(reference.at(1. + s).friction[0] * 5., force, 1e-11);
      EXPECT_NEAR(reference.at(1. + s).dissipation,
                  0.5 * std::max(0., s - 0.5 * (1. / k + 1. / alpha)),
                  1e-11);
    }
}



TEST(ReferenceContact, its_own_error_is_small)
{
  const Settings settings = {
    {"Friction/Effects",
     "subloading, overstress, softening, healing, ageing, heating, stribeck, "
     "direction"},
    {"Friction/healing/Rate", "1e-3"},
    {"Friction/healing/Steepness", "50"},
    {"Friction/ageing/Growth", "0.01"},
    {"Friction/stribeck/Rise", "0.02"},
    {"Loading/Programme",
     "press 5 MPa in 1 s; slide 1 mm/s for 2 mm; hold 20 s; slide -0.1 mm/s for "
     "1 mm; slide 0.1 mm/s for 1 mm at 70 deg"}};
  const auto coarse = reference_of(settings),
             fine   = reference_of(settings, 1e-11);
  for (double t = 1.; t < 43.; t += 0.0137)
    {
      const auto a = coarse.at(t), b = fine.at(t);
      ASSERT_NEAR(a.friction[0], b.friction[0], 1e-9) << t;
      ASSERT_NEAR(a.friction[1], b.friction[1], 1e-9) << t;
      ASSERT_NEAR(a.dissipation, b.dissipation, 1e-8) << t;
    }
}



TEST(ReferenceContact, the_law_in_tiny_steps_agrees)
{
  // In all of its steps the law itself comes to the same, if they are short
  // enough from the first on.
  const Parameters parameters = point_parameters(
    {{"Friction/Effects",
      "subloading, overstress, softening, healing, heating, viscous, anisotropy"},
     {"Friction/healing/Rate", "1e-3"},
     {"Friction/healing/Steepness", "50"},
     {"Friction/heating/Cooling time", "2 s"},
     {"Friction/viscous/Drag", "0.05"},
     {"Friction/anisotropy/Ratio", "0.7"},
     {"Friction/anisotropy/Angle", "20 deg"},
     {"Time stepping/Least steps per statement", "1000"},
     {"Time stepping/First slip", "1e-3"},
     {"Loading/Programme",
      "press 5 MPa in 1 s; slide 1 mm/s for 1 mm; hold 5 s; slide -0.1 mm/s for "
      "0.5 mm at 30 deg; press 8 MPa in 1 s; slide 0.1 mm/s for 0.5 mm"}});
  const ReferenceContact reference(parameters, parse_programme(parameters));
  double                 friction = 0., energy = 0., peak = 0.;
  for (const HistoryRow &row : point_history(parameters, 1e-7))
    {
      const auto answer = reference.at(row.time);
      friction          = std::max(friction,
                          std::hypot(answer.friction[0] - row.friction,
                                     answer.friction[1] - row.friction_y));
      energy =
        std::max(energy, std::abs(answer.dissipation - row.dissipated_energy));
      peak = std::max(peak, std::hypot(row.friction, row.friction_y));
    }
  EXPECT_LT(friction / peak, 1e-4);
  EXPECT_LT(energy / reference.at(17.).dissipation, 1e-4);
}
