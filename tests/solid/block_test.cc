// SPDX-License-Identifier: LGPL-2.1-or-later

// The block: patch test, supports, orientation, elements, solvers, failures.

#include "block_test_tools.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  const Settings coulomb      = {{"Friction/Effects", ""},
                                 {"Friction/Static coefficient", "0.1"}};
  const Settings slippery     = {{"Friction/Effects", ""},
                                 {"Friction/Static coefficient", "1e-9"}};
  const Settings two_cells    = {{"Block/Subdivisions", "2, 2, 2"}};
  const Settings coarse_steps = {{"Time stepping/Tolerance", "1e-3"}};
  const Settings plane        = {{"Block/Dimension", "2"},
                                 {"Block/Size", "10 mm, 10 mm"},
                                 {"Block/Subdivisions", "3, 2"}};
  const Settings press        = {{"Loading/Programme", "press 5.8 MPa in 1 s"}};
  const Settings slide        = {
           {"Loading/Programme", "press 5.8 MPa in 1 s; slide 1 mm/s for 0.05 mm"}};

  // Free to widen, but not to move away.
  const Settings guided = {{"Block/Faces/top", "pressure programme"},
                           {"Block/Faces/left", "displacement x 0 mm"}};

  double relative_difference(const BlockResult &a, const BlockResult &b)
  {
    double largest = 0.;
    for (unsigned int i = 0; i < a.history.size(); ++i)
      largest = std::max(
        {largest,
         std::abs(a.history[i].friction - b.history[i].friction),
         std::abs(a.history[i].normal_load / b.history[i].normal_load - 1.)});
    return largest;
  }
} // namespace



// Without friction and free to widen, the state is uniaxial: the pressure is
// that of the programme at every contact point, on any mesh of any degree.
TEST(PatchTest, uniform_compression)
{
  for (const std::string degree : {"1", "2"})
    {
      const auto in_3d = run_block_case<3>(
        make_parameters(slippery + press +
                        Settings{{"Block/Size", "10 mm, 4 mm, 7 mm"},
                                 {"Block/Subdivisions", "3, 1, 2"},
                                 {"Block/Degree", degree}} +
                        guided +
                        Settings{{"Block/Faces/front", "displacement y 0 mm"}}),
        MPI_COMM_SELF,
        [](const Block<3> &block) {
          for (const auto &face : block.state().contact_face.cell_faces())
            for (const auto &point : face.points)
              EXPECT_NEAR(point.point.committed().normal_traction, 5.8, 1e-6);
        });
      EXPECT_NEAR(in_3d.history.back().normal_load, 5.8 * 40., 1e-7);
      // Energy: p^2 / (2 E) per volume and p^2 / (2 alpha_n) per area.
      EXPECT_NEAR(in_3d.history.back().stored_energy,
                  5.8 * 5.8 / 2. * (280. / 206e3 + 40. / 1e5),
                  1e-8);

      const auto in_2d =
        run_block_case<2>(make_parameters(slippery + press + plane + guided +
                                          Settings{{"Block/Degree", degree}}));
      const double plane_modulus = 206e3 / (1. - 0.3 * 0.3);
      EXPECT_NEAR(in_2d.history.back().stored_energy,
                  5.8 * 5.8 / 2. * (100. / plane_modulus + 10. / 1e5),
                  1e-8);
    }
}



// Pressed by a prescribed displacement: block and contact are springs in
// series.
TEST(PatchTest, prescribed_displacement)
{
  const auto result = run_block_case<3>(make_parameters(
    slippery + two_cells +
    Settings{{"Loading/Programme", "hold 1 s"},
             {"Block/Faces/top", "displacement z -0.001 mm; drive"},
             {"Block/Poisson ratio", "0"}}));
  EXPECT_EQ(result.failure, "");
  EXPECT_NEAR(result.history.back().pressure,
              0.001 / (10. / 206e3 + 1. / 1e5),
              1e-7);
}



TEST(FullSlip, friction_is_the_coefficient_on_any_mesh)
{
  for (const std::string cells : {"1, 1, 1", "2, 3, 2"})
    for (const std::string degree : {"1", "2"})
      {
        const auto result = run_block_case<3>(make_parameters(
          coulomb + slide +
          Settings{{"Block/Subdivisions", cells}, {"Block/Degree", degree}}));
        EXPECT_EQ(result.failure, "");
        EXPECT_NEAR(result.history.back().friction, 0.1, 1e-9);
        EXPECT_NEAR(result.history.back().friction_y, 0., 1e-9);
        EXPECT_DOUBLE_EQ(result.history.back().slip_fraction, 1.);
        EXPECT_LT(result.force_imbalance, 1e-7);
      }
  const auto result =
    run_block_case<2>(make_parameters(coulomb + slide + plane));
  EXPECT_NEAR(result.history.back().friction, 0.1, 1e-9);
}



TEST(FullSlip, friction_opposes_motion_at_an_angle_and_after_reversal)
{
  const auto   result       = run_block_case<3>(make_parameters(
    coulomb + two_cells +
    Settings{{"Loading/Programme",
                      "press 5.8 MPa in 1 s; slide 1 mm/s for 0.2 mm at 30 deg; slide "
                              "-1 mm/s for 0.1 mm"}}));
  unsigned int end_of_first = 0;
  while (result.history[end_of_first].time < 1.2 - 1e-9)
    ++end_of_first;
  EXPECT_NEAR(result.history[end_of_first].friction,
              0.1 * std::cos(dealii::numbers::PI / 6.),
              1e-6);
  EXPECT_NEAR(result.history[end_of_first].friction_y, 0.05, 1e-6);
  EXPECT_NEAR(result.history.back().friction, -0.1, 1e-4);
}



TEST(FullSlip, pulled_at_an_end_face)
{
  const auto result = run_block_case<3>(
    make_parameters(coulomb + slide + two_cells +
                    Settings{{"Block/Faces/top", "pressure programme; flat"},
                             {"Block/Faces/right", "drive"}}));
  EXPECT_EQ(result.failure, "");
  EXPECT_NEAR(result.history.back().friction, 0.1, 1e-9);
  EXPECT_LT(result.force_imbalance, 1e-7);
}



// The same experiment with the plane on each of the six sides.
TEST(Orientation, any_face_can_be_in_contact)
{
  const std::vector<std::pair<std::string, std::string>> opposite = {
    {"bottom", "top"},
    {"top", "bottom"},
    {"left", "right"},
    {"right", "left"},
    {"front", "back"},
    {"back", "front"}};
  std::vector<BlockResult> results;
  for (const auto &faces : opposite)
    {
      Settings settings = {{"Block/Faces/bottom", "free"},
                           {"Block/Faces/top", "free"}};
      settings.emplace_back("Block/Faces/" + faces.first, "contact");
      settings.emplace_back("Block/Faces/" + faces.second,
                            "pressure programme; drive");
      results.push_back(run_block_case<3>(
        make_parameters(slide + coarse_steps + two_cells + settings)));
      ASSERT_EQ(results.back().failure, "");
      ASSERT_EQ(results.back().history.size(), results[0].history.size());
      EXPECT_LT(relative_difference(results.back(), results[0]), 1e-8)
        << faces.first;
    }
}



TEST(Solvers, direct_and_amg_agree)
{
  for (const std::string degree : {"1", "2"})
    {
      const Settings settings =
        slide + coarse_steps +
        Settings{{"Block/Degree", degree}, {"Block/Subdivisions", "4, 3, 3"}};
      const auto direct = run_block_case<3>(
        make_parameters(settings + Settings{{"Block/Solver", "direct"}}));
      const auto amg = run_block_case<3>(
        make_parameters(settings + Settings{{"Block/Solver", "amg"}}));
      ASSERT_EQ(direct.history.size(), amg.history.size());
      EXPECT_LT(relative_difference(direct, amg), 1e-9);
    }
  const auto direct = run_block_case<2>(
    make_parameters(slide + plane + Settings{{"Block/Solver", "direct"}}));
  const auto amg = run_block_case<2>(
    make_parameters(slide + plane + Settings{{"Block/Solver", "amg"}}));
  EXPECT_LT(relative_difference(direct, amg), 1e-9);
}



TEST(Newton, converges_quadratically)
{
  const auto   result   = run_block_case<3>(make_parameters(
    slide + two_cells + Settings{{"Block/Newton tolerance", "1e-10"}}));
  unsigned int n_judged = 0;
  for (const auto &norms : result.newton_residuals)
    for (unsigned int i = 1; i < norms.size(); ++i)
      // Judged where round-off is far away, and where the linear systems are
      // solved the better the smaller the residual is.
      if (norms[i] > 1e-9 && norms[i - 1] < 2e-3)
        {
          EXPECT_LT(norms[i], 40. * norms[i - 1] * norms[i - 1]);
          ++n_judged;
        }
  EXPECT_GE(n_judged, 1u);
  // In each of the two stages.
  EXPECT_LE(result.summary.newton_iterations, 6. * result.summary.steps);
}



// Only round-off is left of the forces then, 3e-10 of the contact force.
TEST(Newton, ends_where_a_rigid_block_has_no_more_digits)
{
  const auto result = run_block_case<3>(make_parameters(
    Settings{{"Block/Young modulus", "1e8 GPa"},
             {"Block/Subdivisions", "2, 2, 2"},
             {"Block/Degree", "2"},
             {"Time stepping/Tolerance", "1e-3"},
             {"Loading/Programme",
              "press 5.8 MPa in 1 s; slide 1 mm/min for 0.001 mm"}}));
  EXPECT_EQ(result.failure, "");
  EXPECT_LT(result.force_imbalance, 1e-7);
}



// As after a signal: every third step is left undone once, and does not count.
TEST(Newton, steps_that_are_given_up_are_made_again)
{
  const auto parameters  = make_parameters(plane + slide + coarse_steps);
  const auto undisturbed = run_block_case<2>(parameters);
  ASSERT_GT(undisturbed.history.size(), 20u);

  const FrictionLaw       law(parameters);
  const Programme         programme = parse_programme(parameters);
  Block<2>                block(BlockParameters(parameters, programme),
                 law,
                 programme,
                 StepControl(parameters, programme, law),
                 MPI_COMM_SELF);
  std::vector<HistoryRow> history;
  std::size_t             n_given_up = 0, n_between = 0;
  bool                    gives_up = false;
  block.run(
    nullptr,
    [&](const HistoryRow &row) {
      history.push_back(row);
      gives_up = history.size() % 3 == 0;
    },
    [&]() { ++n_between; },
    [&]() {
      n_given_up += gives_up;
      return std::exchange(gives_up, false);
    });
  ASSERT_EQ(history.size(), undisturbed.history.size());
  EXPECT_GE(n_given_up, 6u);
  EXPECT_EQ(n_between,
            history.size() + n_given_up + block.state().control.n_rejected());
  for (unsigned int i = 0; i < history.size(); ++i)
    {
      EXPECT_NEAR(history[i].friction, undisturbed.history[i].friction, 1e-7);
      EXPECT_NEAR(history[i].time, undisturbed.history[i].time, 1e-6);
    }
  Summary summary;
  block.fill(summary);
  EXPECT_EQ(summary.newton_iterations, undisturbed.summary.newton_iterations);
}



TEST(Energy, balance)
{
  // With equal steps the error falls with the square of the step.
  const std::string programme =
    "press 5.8 MPa in 1 s; slide 1 mm/s for 0.003 mm";
  double last_error = 0.;
  for (const std::string n_steps : {"50", "100", "200"})
    {
      const auto result = run_block_case<3>(make_parameters(
        two_cells +
        Settings{{"Loading/Programme", programme},
                 {"Time stepping/Tolerance", "0.1"},
                 {"Time stepping/First slip", "1e6"},
                 {"Time stepping/Least steps per statement", n_steps}}));
      EXPECT_EQ(result.failure, "");
      if (last_error > 0.)
        {
          EXPECT_GT(std::log2(last_error / result.summary.balance_error), 1.8);
        }
      last_error = result.summary.balance_error;
    }

  // With the steps that the law asks for, through everything that can happen.
  const auto result = run_block_case<3>(make_parameters(
    two_cells +
    Settings{{"Loading/Programme",
              "press 5.8 MPa in 1 s; slide 1 mm/s for 2 mm; slide -1 mm/s "
              "for 1 mm; press 8 MPa in 1 s; slide 1 mm/s for 1 mm"}}));
  EXPECT_EQ(result.failure, "");
  EXPECT_LT(result.summary.balance_error, 1e-4);
}



TEST(Frame, long_slides_cost_no_digits)
{
  // 600 mm forth and back, then a short slide, equals the short slide after a
  // short way with the same history: here of a law that forgets.
  const auto end = [](const std::string &programme) {
    return run_block_case<3>(
             make_parameters(two_cells +
                             Settings{{"Friction/Effects", "subloading"},
                                      {"Loading/Programme", programme}}))
      .history.back();
  };
  const HistoryRow far = end(
    "press 5.8 MPa in 1 s; slide 100 mm/s for 600 mm; slide -1 mm/s for 0.01 "
    "mm");
  const HistoryRow near = end(
    "press 5.8 MPa in 1 s; slide 100 mm/s for 60 mm; slide -1 mm/s for 0.01 "
    "mm");
  EXPECT_NEAR(far.friction, near.friction, 1e-8);
  EXPECT_NEAR(far.stored_energy / near.stored_energy, 1., 1e-8);
}



TEST(Flat, face_stays_flat)
{
  const auto tilt = [](const std::string &top) {
    double lowest = 1e300, highest = -1e300;
    run_block_case<3>(
      make_parameters(slide + two_cells + Settings{{"Block/Faces/top", top}}),
      MPI_COMM_SELF,
      [&](const Block<3> &block) {
        for (const auto &face : block.state().contact_face.cell_faces())
          for (const auto &point : face.points)
            {
              const double p = point.point.committed().normal_traction;
              lowest         = std::min(lowest, p);
              highest        = std::max(highest, p);
            }
      });
    return highest - lowest;
  };
  // A platen that cannot tilt takes up the moment of the friction force.
  EXPECT_LT(tilt("pressure programme; drive; flat"),
            0.5 * tilt("pressure programme; drive"));
}



TEST(Failure, tall_block_tips_over)
{
  const auto result = run_block_case<3>(make_parameters(Settings{
    {"Block/Size", "4 mm, 10 mm, 40 mm"},
    {"Block/Subdivisions", "2, 2, 4"},
    {"Friction/Static coefficient", "0.3"},
    {"Loading/Programme", "press 5.8 MPa in 1 s; slide 1 mm/s for 1 mm"}}));
  EXPECT_NE(result.failure.find("tips over"), std::string::npos)
    << result.failure;
  // What was computed is kept.
  EXPECT_GT(result.history.size(), 10u);
  EXPECT_NEAR(result.history.back().pressure, 5.8, 1e-6);
}



// Sinking into a soft contact strains nothing.
TEST(Failure, a_block_may_sink_into_a_soft_contact)
{
  const auto result = run_block_case<2>(make_parameters(Settings{
    {"Block/Dimension", "2"},
    {"Block/Size", "10 mm, 5 mm"},
    {"Block/Subdivisions", "4, 2"},
    {"Block/Young modulus", "3000 MPa"},
    {"Block/Poisson ratio", "0"},
    {"Friction/Normal stiffness", "10"},
    {"Loading/Programme", "press 5 MPa in 1 s; slide 1 mm/s for 0.05 mm"}}));
  EXPECT_EQ(result.failure, "");
  EXPECT_NEAR(result.history.back().pressure, 5., 1e-6);
}



// The motion along a strip is small for its length, if not for its height.
TEST(Failure, thin_strip_may_be_stretched)
{
  const auto result = run_block_case<2>(make_parameters(Settings{
    {"Block/Dimension", "2"},
    {"Block/Size", "30 mm, 0.02 mm"},
    {"Block/Subdivisions", "30, 1"},
    {"Block/Faces/top", "pressure programme"},
    {"Block/Faces/right", "drive"},
    {"Time stepping/Tolerance", "1e-3"},
    {"Loading/Programme", "press 5.8 MPa in 1 s; slide 1 mm/s for 0.1 mm"}}));
  EXPECT_EQ(result.failure, "");
  EXPECT_EQ(result.history.back().slip_fraction, 1.);
}



TEST(Failure, pressure_lost)
{
  const auto result = run_block_case<3>(make_parameters(
    two_cells +
    Settings{
      {"Loading/Programme",
       "press 5.8 MPa in 1 s; slide 1 mm/s for 0.01 mm; press 0 MPa in 1 "
       "s; slide 1 mm/s for 0.01 mm"}}));
  EXPECT_NE(result.failure.find("no contact pressure is left"),
            std::string::npos)
    << result.failure;
  EXPECT_GT(result.history.size(), 10u);
}



// Where edges of a soft block slip outward and its middle sticks, updates that
// never lower the residual went round and round.
TEST(Newton, presses_soft_blocks_whatever_their_friction)
{
  for (const std::string friction :
       {"0.2", "0.25", "0.3", "0.35", "0.4", "0.5"})
    for (const std::string mesh : {"4, 2", "8, 4"})
      {
        const auto result = run_block_case<2>(
          make_parameters({{"Friction/Effects", ""},
                           {"Friction/Static coefficient", friction},
                           {"Block/Dimension", "2"},
                           {"Block/Size", "10 mm, 2 mm"},
                           {"Block/Subdivisions", mesh},
                           {"Block/Degree", "2"},
                           {"Block/Young modulus", "5 MPa"},
                           {"Block/Poisson ratio", "0.49"},
                           {"Loading/Programme", "press 0.1 MPa in 1 s"}}));
        EXPECT_EQ(result.failure, "") << friction << ", " << mesh;
        EXPECT_NEAR(result.history.back().normal_load, 1., 1e-6);
        // Symmetry.
        EXPECT_NEAR(result.history.back().tangential_load, 0., 1e-6);
      }
}



// Nothing but friction holds it along the plane.
TEST(Failure, slides_away_where_friction_does_not_hold_its_loads)
{
  const auto sliding = [](const std::string &top, const std::string &degree) {
    return run_block_case<2>(
      make_parameters({{"Friction/Effects", ""},
                       {"Friction/Static coefficient", "0.2"},
                       {"Friction/Normal stiffness", "1e5"},
                       {"Block/Dimension", "2"},
                       {"Block/Size", "10 mm, 2 mm"},
                       {"Block/Subdivisions", "4, 2"},
                       {"Block/Degree", degree},
                       {"Block/Faces/top", "pressure 1 MPa at once; " + top},
                       {"Loading/Programme", "hold 1 s"}}));
  };
  for (const std::string degree : {"1", "2"})
    {
      const auto away = sliding("traction 0.25 0 MPa", degree);
      EXPECT_TRUE(
        away.failure.find("the block slides away along x: friction cannot "
                          "hold the loads of its faces") != std::string::npos ||
        away.failure.find("friction, which alone holds the loads of the faces "
                          "along the plane, can hardly do so") !=
          std::string::npos)
        << away.failure;
      EXPECT_NEAR(away.history.back().time, 0.8, 1e-3);
      EXPECT_EQ(sliding("traction 0.15 0 MPa", degree).failure, "");
      // It goes as far as it is told.
      EXPECT_EQ(sliding("displacement x 20 mm", degree).failure, "");
    }
}



// Forth and back over a plane whose friction depends on the place: a part of
// the face that lifts at the reversal comes down where it is.
TEST(Block, keeps_its_place_where_it_lifts)
{
  const Parameters parameters =
    make_parameters({{"Friction/Effects", "expression"},
                     {"Friction/expression/Covariate", "position"},
                     {"Friction/expression/Formula", "1 + 0.05*x"},
                     {"Friction/expression/From", "-10"},
                     {"Friction/expression/To", "10"},
                     {"Friction/Static coefficient", "0.3"},
                     {"Friction/Normal stiffness", "1e4 MPa/mm"},
                     {"Friction/Tangential stiffness", "1e4 MPa/mm"},
                     {"Block/Dimension", "2"},
                     {"Block/Size", "10 mm, 10 mm"},
                     {"Block/Subdivisions", "4, 4"},
                     {"Loading/Programme",
                      "press 5 MPa in 1 s; slide 10 mm/min for 1 mm; slide "
                      "-10 mm/min for 1 mm"}});
  bool              has_lifted = false;
  const BlockResult result =
    run_block_case<2>(parameters, MPI_COMM_SELF, [&](const Block<2> &block) {
      Summary summary;
      block.fill(summary);
      has_lifted = summary.opening.has_happened();
    });
  ASSERT_EQ(result.failure, "");
  EXPECT_TRUE(has_lifted);
  // But for the shear of the block, some micrometres.
  EXPECT_NEAR(result.history.back().friction, -0.3, 3e-4);
}



// Rubber on a contact of 1e4 MPa/mm: what is out of balance moves it farther
// than its contact gives way.
TEST(Block, slides_where_it_is_far_softer_than_its_contact)
{
  struct Case
  {
    const char *degree, *subdivisions;
    double      pressure; // [MPa]
  };
  for (const Case &now :
       {Case{"2", "8, 4", 1e-3}, {"2", "5, 3", 3e-4}, {"1", "16, 8", 3e-3}})
    {
      const auto result = run_block_case<2>(
        make_parameters({{"Block/Dimension", "2"},
                         {"Block/Size", "40 mm, 20 mm"},
                         {"Block/Subdivisions", now.subdivisions},
                         {"Block/Degree", now.degree},
                         {"Block/Young modulus", "1 MPa"},
                         {"Block/Faces/bottom", "contact"},
                         {"Block/Faces/top", "drive; pressure programme"},
                         {"Friction/Effects", "subloading"},
                         {"Friction/Static coefficient", "0.1"},
                         {"Loading/Programme",
                          "press " + std::to_string(now.pressure) +
                            " MPa in 1 s; slide 1 mm/s for 0.02 mm"}}));
      EXPECT_EQ(result.failure, "") << now.subdivisions;
      EXPECT_GT(result.history.back().friction, 0.01) << now.subdivisions;
    }
}
