// SPDX-License-Identifier: LGPL-2.1-or-later

// A block distributed over all ranks against the same block on each rank alone.

#include "../block_test_tools.h"

#include <gtest/gtest.h>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  template <int dim>
  void compare(const Settings &settings, const bool repeats_steps = true)
  {
    // Coarse steps, because ranks may outnumber cores.
    const Parameters parameters = make_parameters(
      Settings{{"Time stepping/Tolerance", "0.05"},
               {"Time stepping/Least steps per statement", "3"}} +
      settings);
    const auto together = run_block_case<dim>(parameters, MPI_COMM_WORLD);
    const auto alone    = run_block_case<dim>(parameters, MPI_COMM_SELF);

    EXPECT_EQ(together.failure, "");
    // Steps that are repeated, too.
    if (repeats_steps)
      {
        EXPECT_GT(together.summary.rejected_steps, 0u);
      }
    EXPECT_EQ(together.summary.rejected_steps, alone.summary.rejected_steps);
    ASSERT_EQ(together.history.size(), alone.history.size());
    for (unsigned int i = 0; i < alone.history.size(); ++i)
      {
        const HistoryRow &a = together.history[i], &b = alone.history[i];
        const double      force = b.normal_load;
        ASSERT_EQ(a.time, b.time);
        ASSERT_NEAR(a.normal_load, b.normal_load, 1e-9 * force);
        ASSERT_NEAR(a.tangential_load, b.tangential_load, 1e-9 * force);
        ASSERT_NEAR(a.friction_y, b.friction_y, 1e-9);
        ASSERT_NEAR(a.dissipated_energy,
                    b.dissipated_energy,
                    1e-9 * b.external_work);
        ASSERT_NEAR(a.coefficient.mean, b.coefficient.mean, 1e-9);
        ASSERT_NEAR(a.loading_ratio.maximum, b.loading_ratio.maximum, 1e-8);
      }
  }

  const Settings medium_steps = {{"Time stepping/Tolerance", "0.01"}};

  const std::string programme =
    "press 5.8 MPa in 1 s; slide 1 mm/s for 0.1 mm at 20 deg; slide -1 mm/s for "
    "0.05 mm; press 3 MPa in 1 s";
} // namespace



TEST(Ranks, agree_in_3d_in_many_steps)
{
  for (const std::string solver : {"direct", "amg", "multigrid"})
    compare<3>({{"Loading/Programme", programme},
                {"Block/Subdivisions", "3, 2, 3"},
                {"Block/Solver", solver}});
}



TEST(Ranks, agree_in_2d_with_quadratic_elements)
{
  compare<2>(medium_steps +
             Settings{{"Loading/Programme",
                       "press 5.8 MPa in 1 s; slide 1 mm/s for 0.1 mm"},
                      {"Block/Dimension", "2"},
                      {"Block/Size", "10 mm, 5 mm"},
                      {"Block/Subdivisions", "4, 3"},
                      {"Block/Degree", "2"}});
}



TEST(Ranks, agree_on_the_levels_of_multigrid_in_many_steps)
{
  // Coarse levels have fewer cells than there are ranks.
  for (const std::string degree : {"1", "2"})
    compare<3>({{"Loading/Programme", programme},
                {"Block/Subdivisions", "4, 4, 4"},
                {"Block/Degree", degree},
                {"Block/Solver", "multigrid"}});
}



TEST(Ranks, agree_with_much_friction_on_stiff_contact)
{
  const Settings much = {{"Friction/Effects", "subloading"},
                         {"Friction/Static coefficient", "1"},
                         {"Friction/Normal stiffness", "1e6 MPa/mm"},
                         {"Friction/Tangential stiffness", "1e6 MPa/mm"},
                         {"Block/Newton iterations", "40"},
                         {"Block/Solver", "multigrid"},
                         {"Loading/Programme",
                          "press 5.8 MPa in 1 s; slide 1 mm/s for 0.01 mm"}};
  compare<3>(much + Settings{{"Block/Size", "10 mm, 10 mm, 2.5 mm"},
                             {"Block/Subdivisions", "4, 4, 2"},
                             {"Block/Degree", "2"}},
             false);
  compare<2>(much + Settings{{"Block/Dimension", "2"},
                             {"Block/Size", "10 mm, 5 mm"},
                             {"Block/Subdivisions", "8, 4"}},
             false);
}



TEST(Ranks, agree_with_a_flat_face_in_many_steps)
{
  // All unknowns of the face hang on one, which most ranks do not own.
  compare<3>({{"Loading/Programme", programme},
              {"Block/Subdivisions", "3, 3, 2"},
              {"Block/Faces/top", "pressure programme; drive; flat"}});
}



// Contact that opens and closes, at points of which other ranks know nothing.
TEST(Ranks, agree_on_a_curved_face_with_a_weak_patch_in_many_steps)
{
  const Settings curved = {{"Contact/Gap", "(x - 5)^2/(2*200)"},
                           {"Contact/Strength", "1 - 0.4*(abs(x - 5) < 0.5)"},
                           {"Friction/Effects", "subloading"},
                           {"Friction/Static coefficient", "0.3"},
                           {"Block/Young modulus", "1e4 MPa"},
                           {"Block/Newton tolerance", "1e-11"},
                           {"Loading/Programme",
                            "press 20 MPa in 1 s; slide 1 mm/s for 0.004 mm"}};
  for (const std::string refinement : {"uniform 0", "adaptive 1"})
    compare<2>(curved + Settings{{"Block/Dimension", "2"},
                                 {"Block/Size", "10 mm, 5 mm"},
                                 {"Block/Subdivisions", "12, 6"},
                                 {"Block/Refinement", refinement}},
               false);
  compare<3>(curved + Settings{{"Block/Size", "10 mm, 2 mm, 5 mm"},
                               {"Block/Subdivisions", "8, 2, 4"}},
             false);
}



// Meshes with hanging nodes on several levels, supports and histories that move
// from rank to rank.
TEST(Ranks, agree_on_a_drive_that_gives_way_in_many_steps)
{
  for (const std::string solver : {"direct", "multigrid"})
    compare<3>(
      {{"Loading/Programme",
        "press 5.8 MPa in 1 s; push 0.4 MPa in 1 s at 30 deg; push -0.3 "
        "MPa in 1 s; slide 1 mm/s for 0.05 mm"},
       {"Loading/Machine stiffness",
        solver == "direct" ? "rigid" : "20 MPa/mm"},
       {"Block/Young modulus", "1e4 MPa"},
       {"Block/Newton tolerance", "1e-11"},
       {"Block/Subdivisions", "4, 2, 2"},
       {"Block/Solver", solver}});
}



// Waves that cross the borders of ranks.
TEST(Ranks, agree_on_a_block_in_motion_in_many_steps)
{
  const Settings waves = {{"Block/Density", "1e9 kg/m^3"},
                          {"Block/Damping time", "0.1 ms"},
                          {"Block/Newton tolerance", "1e-11"},
                          {"Loading/Machine stiffness", "20 MPa/mm"},
                          {"Loading/Programme",
                           "press 5.8 MPa in 0.1 s; slide 1 mm/s for 0.02 mm"}};
  for (const std::string solver : {"direct", "multigrid"})
    {
      compare<3>(waves + Settings{{"Block/Subdivisions", "4, 2, 2"},
                                  {"Block/Solver", solver}},
                 false);
      compare<2>(waves + Settings{{"Block/Dimension", "2"},
                                  {"Block/Size", "10 mm, 5 mm"},
                                  {"Block/Subdivisions", "6, 4"},
                                  {"Block/Refinement", "adaptive 1"},
                                  {"Block/Degree", "2"},
                                  {"Block/Solver", solver}},
                 false);
    }
}



// Forces that the assembled matrix adds for other ranks are damped, too.
TEST(Ranks, agree_on_a_damped_block_that_is_pushed)
{
  compare<2>({{"Loading/Programme",
               "press 5.8 MPa in 0.1 s; push 0.4 MPa in 0.1 s; push 0.2 MPa in "
               "0.1 s"},
              {"Block/Density", "1e9 kg/m^3"},
              {"Block/Damping time", "1 s"},
              {"Block/Newton tolerance", "1e-11"},
              {"Block/Dimension", "2"},
              {"Block/Size", "10 mm, 5 mm"},
              {"Block/Subdivisions", "4, 2"},
              {"Block/Solver", "direct"}},
             false);
}



TEST(Ranks, agree_on_adaptive_meshes_in_many_steps)
{
  const Settings few_steps =
    medium_steps + Settings{{"Loading/Programme",
                             "press 5.8 MPa in 1 s; slide 1 mm/s for 0.003 "
                             "mm"}};
  compare<3>(few_steps +
             Settings{{"Block/Subdivisions", "3, 2, 1"},
                      {"Block/Faces/top", "pressure programme; flat"},
                      {"Block/Faces/left", "drive"},
                      {"Block/Refinement", "adaptive 3"},
                      {"Block/Adaptivity/Tolerance", "1e-3"},
                      {"Block/Adaptivity/Most cells", "90"},
                      {"Block/Adaptivity/Beyond the limit", "warn"}});
  for (const std::string goal : {"energy", "contact"})
    compare<2>(few_steps + Settings{{"Block/Dimension", "2"},
                                    {"Block/Size", "10 mm, 5 mm"},
                                    {"Block/Subdivisions", "4, 3"},
                                    {"Block/Degree", "2"},
                                    {"Block/Refinement", "adaptive 3"},
                                    {"Block/Adaptivity/Goal", goal},
                                    {"Block/Adaptivity/Tolerance", "0.02"}});
}



// Most ranks have nothing to do, at first or ever.
// The pressure is given, so the forces of a mesh with hanging nodes and of
// batches of cells at the borders of ranks are known.
TEST(Ranks, adaptive_meshes_in_space_carry_the_load)
{
  for (const std::string degree : {"1", "2"})
    {
      const auto result = run_block_case<3>(
        make_parameters(
          {{"Loading/Programme", "press 5.8 MPa in 1 s"},
           {"Time stepping/Equal steps per statement", "1"},
           {"Block/Size", "10 mm, 6 mm, 5 mm"},
           {"Block/Subdivisions", "2, 2, 1"},
           {"Block/Degree", degree},
           {"Block/Solver", "multigrid"},
           {"Block/Refinement", "adaptive 3"},
           {"Block/Adaptivity/Tolerance", degree == "1" ? "0.15" : "0.06"}}),
        MPI_COMM_WORLD);
      EXPECT_EQ(result.failure, "");
      EXPECT_GT(result.summary.cells, 500u);
      EXPECT_NEAR(result.history.back().normal_load, 348., 3.5e-6) << degree;
      EXPECT_LT(result.history.back().newton_iterations, 13u) << degree;
    }
}



TEST(Ranks, more_than_cells)
{
  const Settings one_cell =
    medium_steps + Settings{{"Loading/Programme",
                             "press 5.8 MPa in 1 s; slide 1 mm/s for 0.003 "
                             "mm"},
                            {"Block/Subdivisions", "1, 1, 1"}};
  compare<3>(one_cell);
  compare<3>(one_cell + Settings{{"Block/Refinement", "adaptive 1"},
                                 {"Block/Adaptivity/Tolerance", "0.001"}});
}
