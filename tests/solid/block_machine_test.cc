// SPDX-License-Identifier: LGPL-2.1-or-later

// A block whose driven faces hang on a spring, with a mass or without.

#include "block_test_tools.h"

#include <slipstep/experiment/stability.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  // Stress and slip are uniform.
  const Settings rigid_block = {{"Block/Young modulus", "1e10 MPa"},
                                {"Block/Poisson ratio", "0"},
                                {"Block/Newton tolerance", "1e-9"},
                                {"Block/Degree", "1"},
                                {"Block/Faces/top",
                                 "pressure programme; drive; flat"}};
  const Settings in_2d       = {{"Block/Dimension", "2"},
                                {"Block/Size", "20 mm, 5 mm"},
                                {"Block/Subdivisions", "2, 1"}};
  const Settings in_3d       = {{"Block/Size", "10 mm, 10 mm, 5 mm"},
                                {"Block/Subdivisions", "1, 1, 1"}};

  void expect_balanced(const std::vector<HistoryRow> &history)
  {
    const HistoryRow &end = history.back();
    EXPECT_NEAR(end.external_work,
                end.stored_energy + end.dissipated_energy,
                1e-3 * end.external_work);
  }

  /// Of a stick-slip: between the last two times at which the friction passes
  /// its middle upwards [s], how deep it falls between, and the share of the
  /// work meanwhile that is not accounted for.
  struct Cycle
  {
    double period = 0., drop = 0., missing = 0.;
  };

  Cycle last_cycle(const std::vector<HistoryRow> &history, const double from)
  {
    double lowest = 1e9, highest = -1e9;
    for (const HistoryRow &row : history)
      if (row.time > from)
        {
          lowest  = std::min(lowest, row.friction);
          highest = std::max(highest, row.friction);
        }
    const double            middle = (lowest + highest) / 2.;
    std::vector<double>     passes;
    std::vector<HistoryRow> rows; // at these
    for (unsigned int i = 1; i < history.size(); ++i)
      {
        const HistoryRow &a = history[i - 1], &b = history[i];
        if (a.time > from && a.friction < middle && b.friction >= middle &&
            b.time - a.time > 0.)
          {
            passes.push_back(a.time + (middle - a.friction) /
                                        (b.friction - a.friction) *
                                        (b.time - a.time));
            rows.push_back(b);
          }
      }
    Cycle cycle;
    cycle.drop = highest - lowest;
    if (passes.size() > 1)
      {
        cycle.period = (passes.back() - passes.front()) / (passes.size() - 1);
        const auto missing = [](const HistoryRow &row) {
          return row.external_work - row.stored_energy - row.dissipated_energy;
        };
        cycle.missing =
          std::abs(missing(rows.back()) - missing(rows.front())) /
          (rows.back().external_work - rows.front().external_work);
      }
    return cycle;
  }
} // namespace



// With a mass on a soft spring as well, moved and pushed, also beyond what
// friction holds.
TEST(BlockMachine, of_a_stiff_block_is_that_of_the_point)
{
  const Settings masses[] = {{{"Loading/Machine stiffness", "50 MPa/mm"}},
                             {{"Loading/Machine stiffness", "5 MPa/mm"},
                              {"Loading/Machine mass", "1e-3 MPa s^2/mm"}}};
  for (const Settings &machine : masses)
    for (const int dim : {2, 3})
      {
        const std::string angle  = dim == 3 ? " at 30 deg" : "";
        const Settings    common = {
             {"Friction/Effects", "subloading, overstress"},
             {"Time stepping/Equal steps per statement", "25"},
             {"Loading/Programme",
              "press 5 MPa in 1 s; slide 0.2 mm/s for 0.1 mm" + angle +
                "; hold 1 s; push 0.2 MPa in 1 s" + angle +
                "; press 6 MPa in 1 s; push -0.3 MPa in 1 s; slide 0.1 mm/s for "
                   "0.1 mm" +
                (machine.size() > 1 ? "; push 2 MPa in 1 s" : "")}};
        const auto block =
          dim == 2 ? run_block_case<2>(make_parameters(rigid_block + in_2d +
                                                       common + machine)) :
                     run_block_case<3>(
                       make_parameters(rigid_block + in_3d + common + machine));
        EXPECT_EQ(block.failure, "");
        const auto   point = point_history(make_parameters(common + machine));
        const double area  = dim == 2 ? 20. : 100.;
        ASSERT_EQ(block.history.size(), point.size());
        for (unsigned int i = 0; i < point.size(); ++i)
          {
            const HistoryRow &a = block.history[i], &b = point[i];
            const double      scale = std::max(1., std::abs(b.displacement));
            ASSERT_NEAR(a.displacement, b.displacement, 1e-5 * scale) << b.time;
            ASSERT_NEAR(a.displacement_y, b.displacement_y, 1e-5 * scale);
            ASSERT_NEAR(a.friction, b.friction, 1e-5) << b.time;
            ASSERT_NEAR(a.friction_y, b.friction_y, 1e-5) << b.time;
            ASSERT_NEAR(a.external_work / area,
                        b.external_work,
                        1e-5 * (1. + std::abs(b.external_work)))
              << b.time;
            ASSERT_NEAR(a.stored_energy / area,
                        b.stored_energy,
                        1e-5 * (1. + b.stored_energy))
              << b.time;
          }
        if (machine.size() > 1)
          {
            EXPECT_GT(point.back().displacement, 1.);
          }
      }
}



// Whether the mass is that of the driven face, of the body or of both.
TEST(BlockMachine, sticks_and_slips_as_the_point)
{
  const Settings programme  = {{"Loading/Speed", "1 mm/s"},
                               {"Loading/Programme",
                                "press 5 MPa in 1 s; slide for 3 mm"}};
  const auto     stick_slip = [](const Settings &more) {
    return make_parameters(more, "stick_slip/stick_slip.prm");
  };
  const Cycle expected = last_cycle(point_history(stick_slip(programme)), 1.5);
  EXPECT_GT(expected.drop, 0.05);
  EXPECT_GT(expected.period, 0.05);
  const Settings masses[] = {{},
                             {{"Loading/Machine mass", "0"},
                              {"Block/Density", "2e-6 t/mm^3"}},
                             {{"Loading/Machine mass", "5e-6 MPa s^2/mm"},
                              {"Block/Density", "1e-6 t/mm^3"}}};
  for (const Settings &mass : masses)
    {
      const auto block =
        run_block_case<2>(stick_slip(rigid_block + in_2d + programme + mass));
      EXPECT_EQ(block.failure, "");
      const Cycle found = last_cycle(block.history, 1.5);
      EXPECT_NEAR(found.period, expected.period, 0.01 * expected.period);
      EXPECT_NEAR(found.drop, expected.drop, 0.01 * expected.drop);
      EXPECT_LT(found.missing, 1e-3);
      expect_balanced(block.history);
    }
}



// Of an elastic block the waves that a machine sends into it are quicker than
// its own swing, and hold next to no energy.
TEST(BlockMachine, makes_steps_as_long_with_the_mass_in_drive_and_body)
{
  const auto with = [](const Settings &masses) {
    return run_block_case<2>(make_parameters(
      Settings{{"Friction/Tangential stiffness", "500"},
               {"Block/Dimension", "2"},
               {"Block/Size", "10 mm, 10 mm"},
               {"Block/Subdivisions", "1, 1"},
               {"Block/Degree", "1"},
               {"Block/Faces/top", "pressure programme; drive; flat"},
               {"Loading/Programme",
                "press 5 MPa in 1 s; slide 1 mm/s for 2 mm"}} +
        masses,
      "stick_slip/stick_slip.prm"));
  };
  const auto in_drive = with({{"Loading/Machine mass", "178.5 kg/m^2"}});
  const auto in_both  = with(
    {{"Loading/Machine mass", "100 kg/m^2"}, {"Block/Density", "7850 kg/m^3"}});
  EXPECT_EQ(in_both.failure, "");
  const std::size_t n = in_drive.history.size();
  EXPECT_GT(n, 300u);
  EXPECT_LT(in_both.history.size(), 1.5 * n);
  EXPECT_GT(in_both.history.size(), n / 1.5);
  const auto last_friction = [](const auto &result) {
    return result.history.back().friction;
  };
  EXPECT_NEAR(last_friction(in_both), last_friction(in_drive), 1e-3);
  expect_balanced(in_both.history);
}



// The shorter the steps, the more round-off of where it is the forces of its
// inertia hold.
TEST(BlockMachine, comes_to_rest_after_a_long_way)
{
  const Settings coulomb  = {{"Friction/Effects", ""},
                             {"Friction/Static coefficient", "0.2"},
                             {"Friction/Tangential stiffness", "1e4"},
                             {"Friction/Normal stiffness", "1e4"},
                             {"Loading/Machine stiffness", "1 MPa/mm"},
                             {"Loading/Machine mass", "1e4 kg/m^2"},
                             {"Loading/Programme",
                              "press 5 MPa in 1 s; slide 1000 mm/s for 10 mm; "
                               "hold 0.02 s"}};
  const Settings block_2d = {{"Block/Dimension", "2"},
                             {"Block/Size", "10 mm, 1 mm"},
                             {"Block/Subdivisions", "1, 1"},
                             {"Block/Degree", "1"},
                             {"Block/Young modulus", "1e5 MPa"},
                             {"Block/Poisson ratio", "0"}};
  const auto     block    = run_block_case<2>(make_parameters(
    coulomb + block_2d + Settings{{"Time stepping/Tolerance", "1e-4"}}));
  EXPECT_EQ(block.failure, "");
  // The closed form of the mass on its spring, friction being 1 MPa: it starts
  // when the spring holds that, and turns half a period after the load point
  // has stopped.
  const double w = std::sqrt(1. / 1e-5), t = 0.01 - 0.001; // [1/s], [s]
  const double farthest = 9. + std::hypot(1000. / w * std::sin(w * t),
                                          1000. * (1. - std::cos(w * t)) / w);
  const auto   turned =
    std::find_if(block.history.begin(),
                 block.history.end(),
                 [](const HistoryRow &row) { return row.friction < -0.1; });
  ASSERT_NE(turned, block.history.end());
  EXPECT_NEAR(turned->slip, farthest, 2e-3);
}



// Faster than waves go through the block: the inertia that the driven face
// meets is no spring, however short the step.
TEST(BlockMachine, pushes_and_pulls_a_body_with_mass)
{
  const Settings common = {{"Friction/Effects", ""},
                           {"Friction/Static coefficient", "0.2"},
                           {"Block/Dimension", "2"},
                           {"Block/Size", "20 mm, 4 mm"},
                           {"Block/Subdivisions", "8, 2"},
                           {"Block/Degree", "1"},
                           {"Block/Density", "7850 kg/m^3"},
                           {"Loading/Machine stiffness", "500 MPa/mm"},
                           {"Loading/Machine mass", "10 kg/m^2"}};
  for (const std::string motion :
       {"push 0.8 MPa in 20 us", "slide 100 mm/s for 20 us"})
    {
      SCOPED_TRACE(motion);
      const auto block = run_block_case<2>(make_parameters(
        common +
        Settings{{"Loading/Programme", "press 5 MPa in 1 ms; " + motion}}));
      EXPECT_EQ(block.failure, "");
      EXPECT_LT(block.history.size(), 1000u);
      EXPECT_GT(block.history.back().tangential_load, 0.);
      expect_balanced(block.history);
    }
}



// Spring and block in series, which stick: the load point carries
// k k_b / (k + k_b) of its motion.
TEST(BlockMachine, is_in_series_with_an_elastic_block)
{
  const Settings sticking  = {{"Friction/Effects", ""},
                              {"Friction/Static coefficient", "1"},
                              {"Block/Young modulus", "100 MPa"},
                              {"Block/Dimension", "2"},
                              {"Block/Size", "20 mm, 5 mm"},
                              {"Block/Subdivisions", "8, 2"},
                              {"Block/Faces/top",
                               "pressure programme; drive; flat"},
                              {"Loading/Programme",
                               "press 5 MPa in 1 s; slide 0.01 mm/s for 0.02 "
                                "mm"}};
  const auto     stiffness = [&](const std::string &machine) {
    const auto result = run_block_case<2>(make_parameters(
      sticking + Settings{{"Loading/Machine stiffness", machine}}));
    EXPECT_EQ(result.failure, "");
    return result.history.back().tangential_load / 20. / 0.02;
  };
  const double block = stiffness("rigid");
  EXPECT_NEAR(stiffness("3 MPa/mm"), 3. * block / (3. + block), 1e-6 * block);
}



// Steady sliding is stable above a stiffness of the machine, which a block has
// in series with its own. How fast an oscillation fades is linear in the excess
// over it, so two such rates tell where they are zero.
TEST(BlockMachine, is_critical_where_the_point_is_in_series_with_the_block)
{
  const Settings elastic = {{"Block/Dimension", "2"},
                            {"Block/Size", "500 mm, 50 mm"},
                            {"Block/Subdivisions", "10, 1"},
                            {"Block/Degree", "1"},
                            {"Block/Young modulus", "870 MPa"},
                            {"Block/Faces/top",
                             "pressure programme; drive; flat"},
                            {"Loading/Speed", "1 mm/s"},
                            {"Loading/Machine mass", "0"},
                            {"Time stepping/Tolerance", "1e-4"}};
  const auto     run     = [&](const Settings &more) {
    const auto result = run_block_case<2>(
      make_parameters(elastic + more, "stick_slip/stick_slip.prm"));
    EXPECT_EQ(result.failure, "");
    return result.history;
  };
  const HistoryRow sticking =
    run({{"Friction/Effects", ""},
         {"Friction/Static coefficient", "5"},
         {"Loading/Machine stiffness", "rigid"},
         {"Loading/Programme",
          "press 5 MPa in 1 s; slide 0.01 mm/s for 0.01 mm"}})
      .back();
  const double compliance =
    sticking.displacement / (sticking.tangential_load / 500.) - 1. / 500.;
  EXPECT_NEAR(compliance, 50. / (870. / 2.6), 0.05 * compliance);

  const FrictionLaw    law(make_parameters({}, "stick_slip/stick_slip.prm"));
  dealii::Tensor<1, 2> velocity;
  velocity[0]           = 1.;
  const double critical = SteadySliding(law, velocity, 5.).limit(0.).stiffness;

  const auto decay = [&](const double factor) {
    const auto history = run(
      {{"Loading/Machine stiffness",
        exact_text(1. / (1. / (factor * critical) - compliance)) + " MPa/mm"},
       {"Loading/Programme", "press 5 MPa in 1 s; slide for 0.6 mm"}});
    std::vector<double> extremes;
    for (unsigned int i = 1; i + 1 < history.size(); ++i)
      if (history[i].time > 1. &&
          (history[i].friction - history[i - 1].friction) *
              (history[i + 1].friction - history[i].friction) <
            0.)
        extremes.push_back(history[i].friction);
    // The first ones are of the contact that breaks loose.
    EXPECT_GE(extremes.size(), 7u);
    const auto swing = [&](const unsigned int i) {
      return std::abs(extremes.at(i + 1) - extremes.at(i));
    };
    return std::log(swing(3) / swing(5)) / 2.;
  };
  const double near = decay(1.1), far = decay(1.3);
  EXPECT_GT(near, 0.);
  EXPECT_NEAR(1.1 - 0.2 * near / (far - near), 1., 0.03);
}



TEST(BlockMachine, keeps_the_balance_of_energy)
{
  const Settings elastic = {
    {"Friction/Effects", "subloading, softening"},
    {"Friction/softening/Rate", "5"},
    {"Block/Young modulus", "1000 MPa"},
    {"Block/Dimension", "2"},
    {"Block/Size", "20 mm, 5 mm"},
    {"Block/Subdivisions", "8, 2"},
    {"Loading/Machine stiffness", "2 MPa/mm"},
    {"Loading/Programme",
     "press 5 MPa in 1 s; slide 1 mm/s for 0.5 mm; push "
     "0.1 MPa in 1 s"}};
  for (const std::string solver : {"direct", "multigrid"})
    for (const std::string mass : {"0", "1e-4 MPa s^2/mm"})
      {
        const auto result = run_block_case<2>(
          make_parameters(elastic + Settings{{"Loading/Machine mass", mass},
                                             {"Block/Solver", solver}}));
        EXPECT_EQ(result.failure, "");
        EXPECT_GT(result.history.back().dissipated_energy, 1.);
        expect_balanced(result.history);
        EXPECT_LT(result.force_imbalance, 1e-6);
      }
}



// Pushed at one end, an elastic block is weak there before its other end feels
// anything: the face as a whole gives way below the static friction. The value
// is that of twice as fine a mesh.
TEST(BlockMachine, of_the_shipped_case_gives_way_from_the_pushed_end)
{
  const auto result = run_block_case<2>(
    make_parameters({{"Loading/Programme",
                      "press 5 MPa in 1 s; hold 1 s; slide 0.1 mm/s for 0.31 "
                      "mm"}},
                    "stick_slip_block/stick_slip_block.prm"));
  EXPECT_EQ(result.failure, "");
  const auto &history = result.history;
  const auto  peak =
    std::max_element(history.begin(),
                     history.end(),
                     [](const HistoryRow &a, const HistoryRow &b) {
                       return a.friction < b.friction;
                     });
  EXPECT_NEAR(peak->friction, 0.2474, 0.001);
  EXPECT_LT(peak->coefficient.minimum, 0.215);
  EXPECT_GT(peak->coefficient.maximum, 0.295);
  EXPECT_LT(history.back().friction, 0.21);
  expect_balanced(history);
}



// Friction falls faster than the spring slackens: without mass there is no
// equilibrium next to the last one.
TEST(BlockMachine, that_would_jump_says_so)
{
  const auto result = run_block_case<2>(
    make_parameters(rigid_block + in_2d +
                    Settings{{"Friction/Effects", "softening"},
                             {"Friction/Static coefficient", "0.2"},
                             {"Friction/softening/Kinetic coefficient", "0.1"},
                             {"Friction/softening/Rate", "100"},
                             {"Loading/Machine stiffness", "1 MPa/mm"},
                             {"Loading/Programme",
                              "press 5 MPa in 1 s; slide 1 mm/s for 2 mm"}}));
  EXPECT_NE(result.failure.find("faster than the machine's spring of 1 MPa/mm"),
            std::string::npos)
    << result.failure;
  EXPECT_NEAR(result.history.back().friction, 0.2, 2e-3);
}
