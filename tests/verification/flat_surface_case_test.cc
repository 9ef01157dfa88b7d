// SPDX-License-Identifier: LGPL-2.1-or-later

// The shipped case against the closed forms and against the measured law (eq. 4
// of the source paper), and the block against the contact point.

#include "../solid/block_test_tools.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  const std::string case_file = "flat_surface_test/flat_surface_test.prm";

  /// The shipped case at one speed, on a mesh that takes a second.
  Parameters flat_surface(const double V, const Settings &settings = {})
  {
    return make_parameters(Settings{{"Loading/Speed",
                                     std::to_string(V) + " mm/min"},
                                    {"Block/Subdivisions", "3, 3, 3"}} +
                             settings,
                           case_file);
  }

  // mu after sliding a path from mu_s, softening alone (eq. 2).
  double softened(const double mu_s, const double mu_k, const double path)
  {
    return mu_k - std::log(1. - (1. - std::exp(-(mu_s - mu_k))) *
                                  std::exp(-0.045 * path));
  }

  // Largest difference of two friction curves during the slide, relative to
  // the peak.
  double largest_difference(const std::vector<HistoryRow> &a,
                            const std::vector<HistoryRow> &b)
  {
    double difference = 0., peak = 0.;
    for (const HistoryRow &row : a)
      if (row.time > 11.)
        {
          difference =
            std::max(difference,
                     std::abs(row.friction - friction_at(b, row.time)));
          peak = std::max(peak, row.friction);
        }
    return difference / peak;
  }
} // namespace



TEST(FlatSurface, four_speeds)
{
  double             first_drop = 0.;
  unsigned long long n_newton = 0, n_steps = 0;
  for (const double V : {1., 10., 50., 200.})
    {
      const Parameters parameters = flat_surface(V);
      const auto       result     = run_block_case<3>(parameters);
      ASSERT_EQ(result.failure, "");
      ASSERT_EQ(result.summary.slides.size(), 1u);
      const SlideSummary &slide = result.summary.slides[0];

      // The steady level: r(V) mu(150 mm), within 0.1 %.
      const FrictionLaw law(parameters);
      const double      scale = law.static_coefficient() / 0.115;
      const double      exact = law.steady_ratio(V / 60.) *
                           softened(0.115 * scale, 0.098 * scale, 150.);
      EXPECT_NEAR(slide.kinetic / exact, 1., 1e-3) << V;

      // What was measured, within 3 %.
      const double measured = 4.20e-3 * std::log(V) + 0.100;
      EXPECT_NEAR(slide.kinetic / measured, 1., 0.03) << V;

      // The drop from the peak is the same at every speed.
      const double drop = 1. - slide.kinetic / slide.peak;
      if (first_drop == 0.)
        first_drop = drop;
      EXPECT_NEAR(drop / first_drop, 1., 5e-3) << V;

      EXPECT_LT(result.force_imbalance, 1e-7);
      EXPECT_LT(result.summary.balance_error, 1e-3);
      n_newton += result.summary.newton_iterations;
      n_steps += result.summary.steps;
    }
  // In each of the two stages.
  EXPECT_LE(n_newton, 6 * n_steps);
}



// Ten times less error per step changes the curves by less than 0.1 %.
TEST(FlatSurface, step_size_control)
{
  for (const double V : {1., 200.})
    {
      const auto normal = point_history(flat_surface(V));
      const auto fine =
        point_history(flat_surface(V, {{"Time stepping/Tolerance", "5e-6"}}));
      EXPECT_GT(fine.size(), 2 * normal.size());
      EXPECT_LT(largest_difference(normal, fine), 1e-3) << V;
    }
  const auto normal =
    run_block_case<2>(flat_surface(10.,
                                   {{"Block/Dimension", "2"},
                                    {"Block/Size", "10 mm, 10 mm"},
                                    {"Block/Subdivisions", "4, 4"}}));
  const auto fine =
    run_block_case<2>(flat_surface(10.,
                                   {{"Block/Dimension", "2"},
                                    {"Block/Size", "10 mm, 10 mm"},
                                    {"Block/Subdivisions", "4, 4"},
                                    {"Time stepping/Tolerance", "5e-6"}}));
  EXPECT_LT(largest_difference(normal.history, fine.history), 1e-3);
}



// A block of one element is a contact point behind the elastic compliance of
// the element, H/G: in series with the tangential contact stiffness. This holds
// as long as the pressure stays uniform, that is, for a low block: friction
// acts H below the drive, and its moment tilts the block.
TEST(OneElement, equals_the_contact_point)
{
  const double   H = 0.1, G = 206e3 / 2.;
  const Settings element = {{"Block/Size", "10 mm, 10 mm, 0.1 mm"},
                            {"Block/Subdivisions", "1, 1, 1"},
                            {"Block/Poisson ratio", "0"}};
  for (const double V : {1., 200.})
    {
      const auto block = run_block_case<3>(flat_surface(V, element));
      ASSERT_EQ(block.failure, "");
      const double series = 1. / (1. / 1e4 + H / G);
      const auto   point  = point_history(flat_surface(
        V, {{"Friction/Tangential stiffness", std::to_string(series)}}));
      EXPECT_LT(largest_difference(block.history, point), 5e-3) << V;
    }
}



// With the height of the paper's block the pressure is far from uniform; then
// the early transition differs, and the levels do not.
TEST(OneElement, tilt_changes_the_transition_only)
{
  const double   H = 10., G = 206e3 / 2.;
  const Settings element = {{"Block/Subdivisions", "1, 1, 1"},
                            {"Block/Poisson ratio", "0"}};
  const auto     block   = run_block_case<3>(flat_surface(1., element));
  const double   series  = 1. / (1. / 1e4 + H / G);
  const auto     point   = point_history(
    flat_surface(1.,
                 {{"Friction/Tangential stiffness", std::to_string(series)}}));
  EXPECT_GT(largest_difference(block.history, point), 5e-3);
  EXPECT_NEAR(block.history.back().friction / point.back().friction, 1., 1e-4);
}
