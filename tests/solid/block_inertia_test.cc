// SPDX-License-Identifier: LGPL-2.1-or-later

// A block with a density: waves, their energy, and how they come and go.

#include "block_test_tools.h"

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  // A slab in shear, 10 mm high, held by its bottom, with c_s = 1e6 mm/s. Its
  // sides let it move along x only, so that it is one of infinite length; what
  // presses it on the plane is that they go down a little. A traction grows
  // over half a period and stays.
  const double height = 10., wave_speed = 1e6;
  const double period = 4. * height / wave_speed;

  Settings slab(const unsigned int dim, const unsigned int degree)
  {
    const std::string cells  = degree == 1 ? "32" : "16";
    Settings          result = dim == 2 ?
                                 Settings{{"Block/Dimension", "2"},
                                 {"Block/Size", "0.2 mm, 10 mm"},
                                 {"Block/Subdivisions", "1, " + cells}} :
                                 Settings{{"Block/Size", "0.2 mm, 0.2 mm, 10 mm"},
                                 {"Block/Subdivisions", "1, 1, " + cells}};
    const std::string down =
      std::string("displacement ") + (dim == 2 ? "y" : "z") + " -1e-5 mm";
    for (const std::string side : {"left", "right", "front", "back"})
      if (dim == 3 || side == "left" || side == "right")
        result.emplace_back("Block/Faces/" + side, down);
    return result + Settings{{"Block/Degree", std::to_string(degree)},
                             {"Block/Faces/top",
                              down + (dim == 2 ? "; traction 0.2 0 MPa" :
                                                 "; traction 0.2 0 0 MPa")},
                             {"Block/Young modulus", "2 GPa"},
                             {"Block/Poisson ratio", "0"},
                             {"Block/Density", "1000 kg/m^3"},
                             {"Friction/Effects", ""},
                             {"Friction/Static coefficient", "50"},
                             {"Friction/Normal stiffness", "1e5"},
                             {"Friction/Tangential stiffness", "1e7"},
                             {"Loading/Programme", "hold 20 us; hold 200 us"}};
  }

  Settings steps(const unsigned int n)
  {
    return {{"Time stepping/Equal steps per statement", std::to_string(n)}};
  }

  template <int dim>
  std::vector<HistoryRow> run(const Settings &settings)
  {
    const auto result = run_block_case<dim>(make_parameters(settings));
    EXPECT_EQ(result.failure, "");
    EXPECT_LT(result.force_imbalance, 1e-6);
    return result.history;
  }

  // Share of the work.
  double missing_energy(const HistoryRow &row)
  {
    return std::abs(row.external_work - row.stored_energy -
                    row.dissipated_energy) /
           row.external_work;
  }

  struct Oscillation
  {
    double period = 0.;
    double decay  = 0.; // of the logarithm of the swing, last period
  };

  // Of the reaction of the plane about its mean, after a time.
  Oscillation oscillation(const std::vector<HistoryRow> &history,
                          const double                   mean,
                          const double                   from)
  {
    std::vector<double> passes, swings;
    double              swing = 0.;
    for (unsigned int i = 1; i < history.size(); ++i)
      {
        const double a = history[i - 1].tangential_load - mean;
        const double b = history[i].tangential_load - mean;
        if (history[i - 1].time < from)
          continue;
        if (a < 0. && b >= 0.)
          {
            passes.push_back(history[i - 1].time -
                             a / (b - a) *
                               (history[i].time - history[i - 1].time));
            swings.push_back(swing);
            swing = 0.;
          }
        swing = std::max(swing, b);
      }
    EXPECT_GE(passes.size(), 4u);
    return {(passes.back() - passes.front()) / (passes.size() - 1.),
            std::log(swings.at(swings.size() - 2) / swings.back())};
  }
} // namespace



TEST(BlockInertia, lets_a_slab_swing_at_its_first_frequency_in_shear)
{
  for (const unsigned int dim : {2, 3})
    for (const unsigned int degree : {1, 2, 3})
      {
        if (dim == 3 && degree == 3)
          continue; // takes a minute
        const Settings settings = slab(dim, degree) + steps(400);
        const auto     history = dim == 2 ? run<2>(settings) : run<3>(settings);
        const Oscillation found =
          oscillation(history, dim == 2 ? 0.04 : 0.008, 20e-6);
        EXPECT_NEAR(found.period, period, 0.002 * period) << dim << degree;
        // Of the first crests some part is higher modes, which fade.
        EXPECT_NEAR(found.decay, 0., 0.02);
        EXPECT_LT(missing_energy(history.back()), 1e-3);
        EXPECT_GT(history.back().kinetic_energy, 0.);
      }
}



// The reaction at an instant, against that with many more steps; damped, since
// every kink of a load begins oscillations that are too quick for the steps.
TEST(BlockInertia, makes_an_error_of_second_order_in_time)
{
  const auto at_end = [](const unsigned int n) {
    return run<2>(slab(2, 1) + steps(n) +
                  Settings{{"Loading/Programme", "hold 20 us; hold 33 us"},
                           {"Block/Damping time", "1 us"},
                           {"Block/Newton tolerance", "1e-11"}})
      .back()
      .tangential_load;
  };
  const double        exact = at_end(1600);
  std::vector<double> errors;
  for (const unsigned int n : {50, 100, 200})
    errors.push_back(std::abs(at_end(n) - exact));
  for (unsigned int i = 1; i < errors.size(); ++i)
    EXPECT_GT(std::log2(errors[i - 1] / errors[i]), 1.8) << errors[i];
}



// zeta = pi f t; an oscillation loses 2 pi zeta per period.
TEST(BlockInertia, is_damped_by_viscosity)
{
  const double time = 0.2e-6;
  const auto   history =
    run<2>(slab(2, 2) + steps(400) +
           Settings{{"Block/Damping time", "0.2 us"},
                    {"Loading/Programme", "hold 20 us; hold 400 us"}});
  const Oscillation found    = oscillation(history, 0.04, 20e-6);
  const double      pi       = dealii::numbers::PI;
  const double      expected = 2. * pi * pi * time / period;
  EXPECT_NEAR(found.decay, expected, 0.02 * expected);
  EXPECT_GT(history.back().dissipated_energy,
            0.1 * history.back().external_work);
  EXPECT_LT(missing_energy(history.back()), 1e-3);
}



// Steps follow their error: short ones while it swings, long ones when it has
// come to rest.
TEST(BlockInertia, is_resolved_by_adaptive_steps)
{
  const auto history = run<2>(
    slab(2, 2) + Settings{{"Block/Damping time", "5 us"},
                          {"Loading/Programme", "hold 20 us; hold 10 ms"}});
  double shortest = 1.;
  for (const HistoryRow &row : history)
    if (row.time > 20e-6)
      shortest = std::min(shortest, row.step_size);
  EXPECT_LT(shortest, period / 20.);
  EXPECT_GT(history.back().step_size, 10. * period);
  EXPECT_NEAR(history.back().tangential_load, 0.04, 1e-7);
  EXPECT_LT(missing_energy(history.back()), 1e-3);
}



// A column whose top begins to move at V sends a wave of the stress rho c V
// down before its foot touches anything: of the work half is motion. Steps are
// so short that forces of inertia are differences of much larger numbers.
// Until the wave from the top is there, the foot of a bar feels 1e-200 of it,
// the squares of which are nothing. Then it is reflected with twice the
// pressure.
TEST(BlockInertia, lets_a_wave_arrive_at_the_foot_of_a_long_bar)
{
  const double wave_speed = std::sqrt(206e9 / 7850.) * 1e3; // [mm/s]
  const auto   result     = run_block_case<2>(make_parameters(
    {{"Block/Dimension", "2"},
           {"Block/Size", "2 mm, 100 mm"},
           {"Block/Subdivisions", "1, 100"},
           {"Block/Degree", "2"},
           {"Block/Young modulus", "206 GPa"},
           {"Block/Poisson ratio", "0"},
           {"Block/Density", "7850 kg/m^3"},
           {"Block/Faces/top", "pressure programme"},
           {"Friction/Effects", ""},
           {"Friction/Normal stiffness", "1e9"},
           {"Loading/Programme", "press 1 MPa in 1 us; hold 25 us"}}));
  EXPECT_EQ(result.failure, "");
  const std::vector<HistoryRow> &history = result.history;
  double                         impulse = 0., duration = 0.;
  for (std::size_t i = 1; i < history.size(); ++i)
    {
      const HistoryRow &row     = history[i];
      const double      arrival = 100. / wave_speed;
      if (row.time < arrival - 2e-6)
        {
          EXPECT_LT(row.pressure, 1e-2) << row.time;
        }
      if (row.time > arrival + 2e-6)
        {
          const double step = row.time - history[i - 1].time;
          impulse += row.pressure * step;
          duration += step;
        }
    }
  EXPECT_GT(duration, 4e-6);
  EXPECT_NEAR(impulse / duration, 2., 0.02);
}



TEST(BlockInertia, moves_a_block_that_has_not_touched_yet)
{
  const double speed = 300., time = 3e-6, density = 1e-9, wave = 1e6;
  const auto   result = run_block_case<2>(
    make_parameters(Settings{{"Block/Dimension", "2"},
                             {"Block/Size", "0.2 mm, 10 mm"},
                             {"Block/Subdivisions", "1, 64"},
                             {"Block/Degree", "1"},
                             {"Block/Faces/top", "displacement y -0.0009 mm"},
                             {"Block/Young modulus", "1 GPa"},
                             {"Block/Poisson ratio", "0"},
                             {"Block/Density", "1000 kg/m^3"},
                             {"Contact/Gap", "0.0005 + 0.01*x"},
                             {"Friction/Effects", ""},
                             {"Loading/Programme", "hold 3 us"}} +
                    steps(1000)));
  // The last step may not leave it there.
  EXPECT_NE(result.failure.find("has not touched the plane"), std::string::npos)
    << result.failure;
  ASSERT_EQ(result.history.size(), 1000u);
  const HistoryRow &end  = result.history.back();
  const double      work = density * wave * speed * speed * time * 0.2;
  EXPECT_NEAR(end.external_work, work, 0.01 * work);
  EXPECT_NEAR(end.kinetic_energy, work / 2., 0.01 * work);
  // The mass of half a cell begins to move within one step: an impact.
  const double half_a_cell = 10. / 64. / 2.;
  EXPECT_NEAR(missing_energy(end), half_a_cell / (2. * wave * time), 1e-3);
}



TEST(BlockInertia, is_the_same_with_every_solver)
{
  const Settings block =
    steps(30) + Settings{{"Block/Dimension", "2"},
                         {"Block/Size", "20 mm, 10 mm"},
                         {"Block/Subdivisions", "8, 4"},
                         {"Block/Refinement", "adaptive 1"},
                         {"Block/Adaptivity/Tolerance", "0.1"},
                         {"Block/Young modulus", "2 GPa"},
                         {"Block/Density", "1000 kg/m^3"},
                         {"Block/Damping time", "1 us"},
                         {"Block/Newton tolerance", "1e-10"},
                         {"Friction/Effects", "subloading, softening"},
                         {"Friction/softening/Rate", "100"},
                         {"Loading/Machine stiffness", "50 MPa/mm"},
                         {"Loading/Programme",
                          "press 5 MPa in 1 ms; slide 1 m/s for 0.2 mm"}};
  for (const std::string degree : {"1", "2", "3"})
    {
      const auto with = [&](const std::string &solver) {
        return run<2>(
          block + Settings{{"Block/Degree", degree}, {"Block/Solver", solver}});
      };
      const auto expected = with("direct");
      for (const std::string solver : {"multigrid", "amg"})
        {
          const auto found = with(solver);
          ASSERT_EQ(found.size(), expected.size());
          for (unsigned int i = 0; i < found.size(); ++i)
            {
              ASSERT_NEAR(found[i].tangential_load,
                          expected[i].tangential_load,
                          1e-6 * expected[i].normal_load)
                << solver << ' ' << i;
              ASSERT_NEAR(found[i].kinetic_energy,
                          expected[i].kinetic_energy,
                          1e-6 * expected[i].external_work);
            }
        }
    }
}



namespace
{
  // Stress and slip are uniform; the mass per area is that of 5 mm.
  const Settings stiff_block = {{"Block/Young modulus", "1e10 MPa"},
                                {"Block/Poisson ratio", "0"},
                                {"Block/Newton tolerance", "1e-9"},
                                {"Block/Degree", "1"},
                                {"Block/Dimension", "2"},
                                {"Block/Size", "20 mm, 5 mm"},
                                {"Block/Subdivisions", "2, 1"},
                                {"Block/Faces/top",
                                 "pressure programme; drive; flat"}};
} // namespace



// Moved by a spring, and pushed beyond what friction holds.
TEST(BlockInertia, of_a_stiff_block_is_a_mass_at_the_point)
{
  const Settings common = {
    {"Friction/Effects", "subloading, overstress"},
    {"Time stepping/Equal steps per statement", "50"},
    {"Loading/Machine stiffness", "5 MPa/mm"},
    {"Loading/Programme",
     "press 5 MPa in 1 s; slide 0.2 mm/s for 0.1 mm; hold 1 s; push 0.2 MPa in "
     "1 s; slide -0.1 mm/s for 0.1 mm; push 2 MPa in 1 s"}};
  const auto block =
    run<2>(stiff_block + common + Settings{{"Block/Density", "2e-4 t/mm^3"}});
  const auto point = point_history(make_parameters(
    common + Settings{{"Loading/Machine mass", "1e-3 MPa s^2/mm"}}));
  ASSERT_EQ(block.size(), point.size());
  for (unsigned int i = 0; i < point.size(); ++i)
    {
      const HistoryRow &a = block[i], &b = point[i];
      const double      scale = std::max(1., std::abs(b.displacement));
      ASSERT_NEAR(a.displacement, b.displacement, 1e-5 * scale) << b.time;
      ASSERT_NEAR(a.friction, b.friction, 1e-5) << b.time;
      ASSERT_NEAR(a.kinetic_energy / 20.,
                  b.kinetic_energy,
                  1e-5 * (1. + b.kinetic_energy))
        << b.time;
      ASSERT_NEAR(a.external_work / 20.,
                  b.external_work,
                  1e-5 * (1. + std::abs(b.external_work)))
        << b.time;
    }
  EXPECT_GT(point.back().kinetic_energy, 0.1);
}



// An elastic block that sticks, slips and rings.
TEST(BlockInertia, keeps_the_balance_of_energy_in_stick_slip)
{
  const auto result = run_block_case<2>(
    make_parameters({{"Block/Density", "1200 kg/m^3"},
                     {"Friction/Effects", "subloading, softening, healing"},
                     {"Block/Subdivisions", "20, 4"},
                     {"Loading/Programme",
                      "press 5 MPa in 1 s; hold 1 s; slide 0.1 mm/s for 0.31 "
                      "mm"}},
                    "stick_slip_block/stick_slip_block.prm"));
  EXPECT_EQ(result.failure, "");
  double largest = 0., highest = 0.;
  for (const HistoryRow &row : result.history)
    {
      largest = std::max(largest, row.kinetic_energy);
      highest = std::max(highest, row.friction);
    }
  EXPECT_GT(highest, 0.24);
  EXPECT_LT(result.history.back().friction, 0.22);
  EXPECT_GT(largest, 1e-3 * result.history.back().external_work);
  EXPECT_LT(missing_energy(result.history.back()), 1e-3);
}
