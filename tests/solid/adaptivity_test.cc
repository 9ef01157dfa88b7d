// SPDX-License-Identifier: LGPL-2.1-or-later

// Meshes that are refined, uniformly or where the solution asks for it.

#include "block_test_tools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  // A plane block that is pulled at its right end: slip starts there and runs
  // to the left.
  const Settings pulled = {{"Block/Dimension", "2"},
                           {"Block/Size", "40 mm, 2 mm"},
                           {"Block/Subdivisions", "20, 1"},
                           {"Block/Young modulus", "10 GPa"},
                           {"Block/Poisson ratio", "0"},
                           {"Block/Faces/top", "pressure programme"},
                           {"Block/Faces/right", "drive"},
                           {"Friction/Effects", ""},
                           {"Friction/Static coefficient", "0.1"},
                           {"Time stepping/Tolerance", "1e-3"},
                           {"Time stepping/Least steps per statement", "5"}};

  const Settings adaptive = {{"Block/Refinement", "adaptive 3"},
                             {"Block/Adaptivity/Tolerance", "0.01"}};

  Settings programme(const std::string &text)
  {
    return {{"Loading/Programme", text}};
  }

  const std::string partial_slip =
    "press 5 MPa in 1 s; slide 1 mm/s for 0.004 mm";
} // namespace



TEST(Adaptivity, uniform_is_the_same_as_more_subdivisions)
{
  const Settings common =
    programme("press 5.8 MPa in 1 s; slide 1 mm/s for 0.02 mm") +
    Settings{{"Time stepping/Tolerance", "1e-3"}};
  const auto refined = run_block_case<3>(
    make_parameters(common + Settings{{"Block/Subdivisions", "1, 2, 1"},
                                      {"Block/Refinement", "uniform 1"}}));
  const auto divided = run_block_case<3>(
    make_parameters(common + Settings{{"Block/Subdivisions", "2, 4, 2"}}));
  EXPECT_EQ(refined.summary.cells, 16u);
  EXPECT_EQ(refined.summary.dofs, divided.summary.dofs);
  ASSERT_EQ(refined.history.size(), divided.history.size());
  for (unsigned int i = 0; i < divided.history.size(); ++i)
    EXPECT_NEAR(refined.history[i].friction, divided.history[i].friction, 1e-9);
}



// The force at which a stroke ends in partial slip, on an adaptive mesh, on the
// subdivisions, and on the finest mesh.
TEST(Adaptivity, adaptive_is_better_than_its_size)
{
  const auto run_on = [](const Settings &mesh) {
    return run_block_case<2>(
      make_parameters(pulled + programme(partial_slip) + mesh));
  };
  const auto coarse = run_on({});
  const auto fine   = run_on({{"Block/Refinement", "uniform 3"}});
  const auto found  = run_on(adaptive);
  ASSERT_EQ(found.failure, "");
  const double exact = fine.history.back().friction;
  EXPECT_LT(std::abs(found.history.back().friction - exact),
            0.5 * std::abs(coarse.history.back().friction - exact));
  EXPECT_LT(found.summary.dofs, 0.4 * fine.summary.dofs);
}



TEST(Adaptivity, changes_of_the_mesh_are_not_felt)
{
  unsigned int n_merged = 0, n_repeated = 0, n_after = 0;
  // Pulled to and fro: the mesh has to change after steps, too, because a step
  // is repeated once only.
  for (const std::string degree : {"1", "2"})
    run_block_case<2>(
      make_parameters(
        pulled +
        programme(partial_slip +
                  "; slide -1 mm/s for 0.004 mm; press 0.5 MPa in 1 s") +
        adaptive +
        Settings{{"Block/Degree", degree},
                 {"Block/Adaptivity/Tolerance",
                  degree == "1" ? "0.015" : "0.002"},
                 {"Block/Adaptivity/Most repeats", "1"},
                 {"Block/Adaptivity/Merging share", "0.9"}}),
      MPI_COMM_SELF,
      [&](const Block<2> &block) {
        for (const MeshChange &change : block.state().mesh_changes)
          {
            // What is carried over, to round-off.
            EXPECT_LT(change.load_jump, 1e-10);
            EXPECT_LT(std::abs(change.dissipation_jump), 1e-10);
            n_merged += change.n_merged;
            n_repeated += change.repeats_step;
            n_after += !change.repeats_step;
          }
        EXPECT_LT(block.state().force_imbalance, 1e-7);
      });
  EXPECT_GT(n_merged, 0u);
  EXPECT_GT(n_repeated, 4u);
  EXPECT_GT(n_after, 0u);
}



// The error of the balance is that of the time steps, on any mesh.
TEST(Adaptivity, energy_balance_holds)
{
  const auto run_on = [](const Settings &mesh) {
    return run_block_case<2>(make_parameters(
      pulled +
      programme("press 5 MPa in 1 s; slide 1 mm/s for 0.04 mm; slide -1 mm/s "
                "for 0.04 mm") +
      mesh));
  };
  const auto uniform = run_on({{"Block/Refinement", "uniform 1"}});
  const auto found   = run_on(adaptive);
  EXPECT_EQ(found.failure, "");
  EXPECT_LT(found.summary.balance_error,
            1.2 * uniform.summary.balance_error + 1e-3);
  EXPECT_LT(found.force_imbalance, 1e-7);
  EXPECT_NEAR(found.history.back().friction,
              uniform.history.back().friction,
              1e-4);
}



// Where the part of the face that slips ends, cells are the smallest.
TEST(Adaptivity, mesh_follows_the_slip_front)
{
  const auto size_at = [](const Block<2> &block, const double x) {
    double size = 0.;
    for (const auto &face : block.state().contact_face.cell_faces())
      if (std::abs(face.cell->center()[0] - x) <=
          0.5 * face.cell->face(face.face)->measure())
        size = std::max(size, face.cell->face(face.face)->measure());
    return size;
  };
  for (const std::string stroke : {"0.001", "0.004"})
    run_block_case<2>(
      make_parameters(
        pulled +
        programme("press 5 MPa in 1 s; slide 1 mm/s for " + stroke + " mm") +
        adaptive + Settings{{"Block/Adaptivity/Tolerance", "0.005"}}),
      MPI_COMM_SELF,
      [&](const Block<2> &block) {
        double front = 40.;
        for (const auto &face : block.state().contact_face.cell_faces())
          for (const auto &point : face.points)
            if (point.point.committed().loading_ratio > 1. - 1e-6)
              front = std::min(front, point.position[0]);
        EXPECT_NEAR(size_at(block, front), 0.25, 1e-9) << stroke;
        EXPECT_GE(size_at(block, 9.), 0.9) << stroke;
        if (stroke == "0.001")
          {
            EXPECT_GT(front, 30.);
            EXPECT_GE(size_at(block, 23.5), 0.5);
          }
        else
          {
            EXPECT_LT(front, 25.);
          }
      });
}



// Cells for the contact face are at its edges, whichever face it is; the other
// edges of the block are as they were.
TEST(Adaptivity, contact_goal_leaves_the_driven_face_alone)
{
  for (const std::string contact : {"bottom", "top"})
    {
      const std::string other = contact == "top" ? "bottom" : "top";
      const auto        sizes = [&](const std::string &goal) {
        std::array<double, 2> smallest{{10., 10.}}; // there, at the other face
        const auto            result = run_block_case<2>(
          make_parameters(
            programme("press 5 MPa in 1 s; slide 1 mm/s for 0.001 mm") +
            Settings{{"Block/Dimension", "2"},
                     {"Block/Size", "10 mm, 10 mm"},
                     {"Block/Subdivisions", "4, 4"},
                     {"Block/Degree", "2"},
                     {"Block/Faces/" + contact, "contact"},
                     {"Block/Faces/" + other, "pressure programme; drive"},
                     {"Friction/Normal stiffness", "1e6"},
                     {"Friction/Tangential stiffness", "1e6"},
                     {"Time stepping/Equal steps per statement", "3"},
                     {"Block/Refinement", "adaptive 5"},
                     {"Block/Adaptivity/Goal", goal},
                     {"Block/Adaptivity/Tolerance", "0.02"}}),
          MPI_COMM_SELF,
          [&](const Block<2> &block) {
            for (const auto &cell : block.state()
                                      .unknowns.get_triangulation()
                                      .active_cell_iterators())
              for (const unsigned int f : {2, 3})
                if (cell->at_boundary(f))
                  {
                    double &size =
                      smallest[(f == 3) == (contact == "top") ? 0 : 1];
                    size = std::min(size, cell->face(f)->measure());
                  }
            EXPECT_LE(block.state().mesh_error.last, 0.0205);
          });
        EXPECT_EQ(result.failure, "");
        return smallest;
      };
      const auto energy = sizes("energy"), aimed = sizes("contact");
      EXPECT_LT(energy[1], 1.) << contact;
      EXPECT_GT(aimed[1], 1.) << contact;
      EXPECT_LT(aimed[0], 0.4) << contact;
    }
}



// Supports, driven and flat faces, and pressures, all with hanging nodes.
TEST(Adaptivity, supports_and_loads_on_hanging_nodes)
{
  for (const std::string degree : {"1", "2"})
    {
      const auto result = run_block_case<3>(
        make_parameters(
          programme("press 5.8 MPa in 1 s; slide 1 mm/s for 0.02 mm at 30 "
                    "deg") +
          Settings{{"Block/Subdivisions", "3, 2, 1"},
                   {"Block/Degree", degree},
                   {"Block/Faces/top", "pressure programme; flat"},
                   {"Block/Faces/right", "drive"},
                   {"Friction/Effects", ""},
                   {"Friction/Static coefficient", "0.1"},
                   {"Time stepping/Tolerance", "3e-2"},
                   {"Time stepping/Least steps per statement", "2"},
                   {"Block/Refinement", "adaptive 2"},
                   {"Block/Adaptivity/Tolerance", "0.001"},
                   {"Block/Adaptivity/Most cells", "40"},
                   {"Block/Adaptivity/Beyond the limit", "warn"}}),
        MPI_COMM_SELF,
        [](const Block<3> &block) {
          EXPECT_TRUE(
            block.state().unknowns.get_triangulation().has_hanging_nodes());
        });
      EXPECT_EQ(result.failure, "");
      EXPECT_LT(result.force_imbalance, 1e-7);
      EXPECT_NEAR(std::hypot(result.history.back().friction,
                             result.history.back().friction_y),
                  0.1,
                  1e-4);
      EXPECT_NEAR(result.history.back().pressure, 5.8, 1e-8);
    }
}



TEST(Adaptivity, limit_of_cells)
{
  const Settings limited = pulled + programme(partial_slip) + adaptive +
                           Settings{{"Block/Adaptivity/Most cells", "60"}};
  const auto stopped = run_block_case<2>(make_parameters(limited));
  EXPECT_NE(stopped.failure.find("'Most cells' in section Block/Adaptivity "
                                 "allows 60"),
            std::string::npos)
    << stopped.failure;

  const auto warned = run_block_case<2>(make_parameters(
    limited + Settings{{"Block/Adaptivity/Beyond the limit", "warn"}}));
  EXPECT_EQ(warned.failure, "");
  EXPECT_LE(warned.summary.cells, 60u);
  EXPECT_GT(warned.summary.cells, 40u);
  ASSERT_FALSE(warned.summary.warnings.empty());
  EXPECT_NE(warned.summary.warnings[0].find("limit"), std::string::npos);

  const auto small_memory = run_block_case<2>(
    make_parameters(pulled + programme(partial_slip) + adaptive +
                    Settings{{"Block/Adaptivity/Most memory", "0.012"}}));
  EXPECT_NE(small_memory.failure.find("Most memory"), std::string::npos)
    << small_memory.failure;
}



// Whatever keeps the mesh from being fine enough is said, with numbers.
TEST(Adaptivity, missed_tolerance_is_told)
{
  const auto warning_of = [](const Settings &mesh, MeshErrorSummary &error) {
    const auto result = run_block_case<2>(
      make_parameters(pulled + programme(partial_slip) + adaptive + mesh));
    EXPECT_EQ(result.failure, "");
    error = result.summary.mesh_error;
    EXPECT_GE(error.largest, error.last);
    std::string missed;
    for (const std::string &text : result.summary.warnings)
      if (text.find("tolerance is") != std::string::npos)
        missed += text;
    return missed;
  };

  MeshErrorSummary  error;
  const std::string by_levels =
    warning_of({{"Block/Refinement", "adaptive 1"},
                {"Block/Adaptivity/Tolerance", "0.001"}},
               error);
  EXPECT_NE(by_levels.find("tolerance is 0.001"), std::string::npos)
    << by_levels;
  EXPECT_NE(by_levels.find("'Refinement = adaptive 1' allows no finer cells"),
            std::string::npos)
    << by_levels;
  EXPECT_GT(error.last, 0.001);
  EXPECT_GT(error.n_missed, 0u);
  EXPECT_LE(error.n_missed, error.n_checked);

  const std::string by_cells =
    warning_of({{"Block/Adaptivity/Most cells", "60"},
                {"Block/Adaptivity/Beyond the limit", "warn"}},
               error);
  EXPECT_NE(by_cells.find("'Most cells'"), std::string::npos) << by_cells;
  EXPECT_GT(error.largest, 0.01);

  const std::string by_repeats =
    warning_of({{"Block/Adaptivity/Most repeats", "0"}}, error);
  EXPECT_NE(by_repeats.find("'Most repeats'"), std::string::npos) << by_repeats;

  // With enough of everything the tolerance is met, and nothing is said.
  EXPECT_EQ(warning_of({{"Block/Refinement", "adaptive 10"},
                        {"Block/Adaptivity/Tolerance", "0.03"},
                        {"Block/Adaptivity/Most repeats", "20"}},
                       error),
            "");
  EXPECT_EQ(error.n_missed, 0u);
  EXPECT_GT(error.n_checked, 10u);
  EXPECT_LE(error.largest, 0.03 * (1. + MarkedCells::slack));
}



// The error shown beside a mesh is that of the step made on it: the one before
// the change of the next.
TEST(Adaptivity, error_shown_is_that_of_the_mesh_beside_it)
{
  unsigned int n_chained = 0;
  run_block_case<2>(
    make_parameters(pulled + programme(partial_slip) + adaptive +
                    Settings{{"Block/Adaptivity/Tolerance", "0.002"}}),
    MPI_COMM_SELF,
    [&](const Block<2> &block) {
      const auto &changes = block.state().mesh_changes;
      ASSERT_GT(changes.size(), 3u);
      for (const MeshChange &change : changes)
        EXPECT_TRUE(std::isfinite(change.error));
      for (unsigned int i = 1; i < changes.size(); ++i)
        if (changes[i].repeats_step && changes[i - 1].repeats_step &&
            changes[i].time == changes[i - 1].time)
          {
            ++n_chained;
            EXPECT_EQ(changes[i].error_before, changes[i - 1].error);
            EXPECT_LT(changes[i].error, changes[i].error_before);
          }
      EXPECT_EQ(changes.back().time < block.state().control.time(), true);
      EXPECT_GT(block.state().mesh_error.last, 0.);
    });
  EXPECT_GT(n_chained, 0u);
}



// A rare check leaves out steps, but not the last one.
TEST(Adaptivity, what_the_run_ends_with_is_looked_at)
{
  const auto result = run_block_case<2>(make_parameters(
    pulled + programme(partial_slip) + adaptive +
    Settings{{"Block/Adaptivity/Steps between checks", "1000000"}}));
  EXPECT_EQ(result.summary.mesh_error.n_checked, 1u);
  EXPECT_GT(result.summary.cells, 20u);
}



// Newton's method may fail after a change of the mesh: the step gets smaller,
// the mesh stays.
TEST(Adaptivity, failure_of_newton_makes_the_step_smaller)
{
  const auto result = run_block_case<2>(make_parameters(
    pulled + programme(partial_slip) + adaptive +
    Settings{{"Block/Newton iterations", "6"},
             {"Time stepping/Tolerance", "0.1"},
             {"Time stepping/First slip", "1e3"},
             {"Time stepping/Least steps per statement", "1"}}));
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.summary.rejected_steps, 0u);
  EXPECT_GT(result.summary.cells, 20u);
}
