// SPDX-License-Identifier: LGPL-2.1-or-later

// A block whose drive is pushed by a load instead of moved.

#include "block_test_tools.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  const Settings pushed_plane = {{"Friction/Effects", "subloading"},
                                 {"Friction/Static coefficient", "0.2"},
                                 {"Friction/subloading/Rate", "50"},
                                 {"Block/Dimension", "2"},
                                 {"Block/Size", "20 mm, 5 mm"},
                                 {"Block/Subdivisions", "8, 2"}};
  const Settings pushed_space = {{"Friction/Effects", "subloading"},
                                 {"Friction/Static coefficient", "0.2"},
                                 {"Friction/subloading/Rate", "50"},
                                 {"Block/Size", "20 mm, 10 mm, 5 mm"},
                                 {"Block/Subdivisions", "4, 2, 2"}};
  // Stress and slip are uniform then.
  const Settings stiff = {{"Block/Young modulus", "1e10 MPa"},
                          {"Block/Poisson ratio", "0"},
                          {"Block/Newton tolerance", "1e-9"},
                          {"Block/Faces/top",
                           "pressure programme; drive; flat"}};
  const Settings soft  = {{"Block/Young modulus", "1e4 MPa"}};

  Settings does(const std::string &programme)
  {
    return {{"Loading/Programme", programme}};
  }

  /// The last row at or before a time.
  const HistoryRow &row_at_time(const std::vector<HistoryRow> &rows,
                                const double                   time)
  {
    std::size_t i = rows.size() - 1;
    while (i > 0 && rows[i].time > time + 1e-9)
      --i;
    return rows[i];
  }

  const double quarter_turn = std::acos(0.);
} // namespace



TEST(BlockPush, of_stiff_material_is_that_of_the_point)
{
  const std::string rest = "; push 0.9 MPa in 1 s; slide 0.1 mm/s for 0.05 mm; "
                           "hold 1 s; push 0 MPa in 1 s; push -0.6 MPa in 1 s";
  for (const int dim : {2, 3})
    for (const std::string effects :
         {"subloading", "subloading, overstress, softening"})
      {
        const std::string angle = dim == 3 ? " at 30 deg" : "";
        const Settings    common =
          Settings{{"Time stepping/Equal steps per statement", "20"}} +
          does(
            "press 5 MPa in 1 s; push between 0.2 MPa and 0.8 MPa 2 times, 2 "
            "s each" +
            angle + rest);
        const Settings effect = {{"Friction/Effects", effects}};
        const auto     block =
          dim == 2 ? run_block_case<2>(make_parameters(pushed_plane + stiff +
                                                       common + effect)) :
                         run_block_case<3>(
                       make_parameters(pushed_space + stiff + common + effect));
        const auto point =
          point_history(make_parameters(pushed_plane + common + effect));
        const double area = dim == 2 ? 20. : 200.;
        EXPECT_EQ(block.failure, "");
        ASSERT_EQ(block.history.size(), point.size());
        for (unsigned int i = 0; i < point.size(); ++i)
          {
            const HistoryRow &a = block.history[i], &b = point[i];
            ASSERT_NEAR(a.displacement, b.displacement, 1e-7) << b.time;
            ASSERT_NEAR(a.displacement_y, b.displacement_y, 1e-7) << b.time;
            ASSERT_NEAR(a.tangential_load,
                        area * b.tangential_load,
                        5e-6 * area)
              << b.time;
            ASSERT_NEAR(a.dissipated_energy / area, b.dissipated_energy, 1e-6);
            ASSERT_NEAR(a.external_work / area, b.external_work, 1e-6);
          }
      }
}



TEST(BlockPush, ratchets_by_the_closed_form)
{
  // Per cycle 2/(pi u) ln(cos(pi r_1/2) / cos(pi r_2/2)).
  const auto rows =
    run_block_case<2>(
      make_parameters(pushed_plane + stiff +
                      does("press 5 MPa in 1 s; push between 0.3 MPa and 0.9 "
                           "MPa 4 times, 2 s each")))
      .history;
  const double cycle =
    std::log(std::cos(quarter_turn * 0.3) / std::cos(quarter_turn * 0.9)) /
    (quarter_turn * 50.);
  for (const double time : {5., 7., 9.})
    EXPECT_NEAR(row_at_time(rows, time).displacement -
                  row_at_time(rows, time - 2.).displacement,
                cycle,
                0.005 * cycle);
}



// An elastic block, whose face slips little by little: the load is met at every
// step, all steps of Newton's method included, and energy is balanced.
TEST(BlockPush, of_elastic_blocks_meets_the_load_and_balances_energy)
{
  const Settings in_2d =
    pushed_plane + soft +
    does(
      "press 5 MPa in 1 s; push 0.9 MPa in 1 s; push -0.5 MPa in 1 s; slide "
      "0.1 mm/s for 0.05 mm; push 0.3 MPa in 1 s; press 8 MPa in 1 s; push 1 "
      "MPa in 1 s");
  const Settings in_3d =
    pushed_space + soft +
    does("press 5 MPa in 1 s; push 0.8 MPa in 1 s at 90 deg; push 0.9 MPa in 1 "
         "s at 30 deg; slide 0.1 mm/s for 0.02 mm");
  const Settings pulled = {{"Block/Faces/top", "pressure programme; flat"},
                           {"Block/Faces/left", "drive"}};
  for (const std::string solver : {"direct", "amg", "multigrid"})
    for (const bool is_pulled : {false, true})
      {
        const auto result = run_block_case<2>(
          make_parameters(in_2d + (is_pulled ? pulled : Settings()) +
                          Settings{{"Block/Solver", solver}}));
        EXPECT_EQ(result.failure, "");
        // What is held while the block is pressed carries some of it.
        const double begin = row_at_time(result.history, 1.).tangential_load;
        EXPECT_EQ(std::abs(begin) > 0.1, is_pulled);
        for (const HistoryRow &row : result.history)
          if (row.time > 1. && row.time <= 2.)
            {
              EXPECT_NEAR(row.tangential_load,
                          begin + (18. - begin) * (row.time - 1.),
                          2e-5);
            }
        EXPECT_NEAR(row_at_time(result.history, 3.).tangential_load,
                    -10.,
                    2e-5);
        EXPECT_NEAR(result.history.back().tangential_load, 20., 2e-5);
        EXPECT_LT(result.force_imbalance, 1e-6);
        EXPECT_NEAR(result.history.back().external_work,
                    result.history.back().dissipated_energy +
                      result.history.back().stored_energy,
                    1e-3 * result.history.back().external_work);
      }
  const auto result = run_block_case<3>(make_parameters(in_3d));
  EXPECT_EQ(result.failure, "");
  const HistoryRow &turned = row_at_time(result.history, 3.);
  EXPECT_NEAR(turned.tangential_load, 180. * std::sqrt(0.75), 2e-4);
  EXPECT_NEAR(turned.friction_y * turned.normal_load, 90., 2e-4);
  EXPECT_GT(turned.displacement_y, 0.);
  EXPECT_NEAR(result.history.back().external_work,
              result.history.back().dissipated_energy +
                result.history.back().stored_energy,
              1e-3 * result.history.back().external_work);
}



// The drive moves one part of the block, another is held in space: what the
// drive carries is more than what friction does.
TEST(BlockPush, counts_what_supports_hold_as_well)
{
  const auto result =
    run_block_case<2>(make_parameters(
                        pushed_plane + soft +
                        does("press 5 MPa in 1 s; push 0.9 MPa in 1 s") +
                        Settings{{"Block/Faces/top", "pressure programme"},
                                 {"Block/Faces/left", "drive"},
                                 {"Block/Faces/right", "displacement x 0 mm"},
                                 {"Block/Poisson ratio", "0"}}),
                      MPI_COMM_SELF,
                      [](const Block<2> &block) {
                        const double drive = block.action_on(0).force[0];
                        EXPECT_NEAR(drive, 18., 2e-5);
                        EXPECT_NEAR(drive + block.action_on(1).force[0] +
                                      block.action_on(2).force[0],
                                    0.,
                                    1e-5);
                        EXPECT_LT(block.action_on(1).force[0], -1.);
                      });
  EXPECT_EQ(result.failure, "");
  EXPECT_NEAR(result.history.back().external_work,
              result.history.back().dissipated_energy +
                result.history.back().stored_energy,
              1e-3 * result.history.back().external_work);
}



TEST(BlockPush, beyond_friction_fails_at_that_load)
{
  for (const std::string effects : {"", "subloading"})
    for (const Settings &material : {soft, stiff})
      {
        const auto result = run_block_case<2>(make_parameters(
          pushed_plane + material + Settings{{"Friction/Effects", effects}} +
          does("press 5 MPa in 1 s; push 1.5 MPa in 1 s")));
        EXPECT_NE(result.failure.find(
                    "friction cannot hold the push of 1.5 MPa; it held "
                    "up to 1 MPa"),
                  std::string::npos)
          << result.failure;
        EXPECT_NEAR(result.history.back().tangential_load, 20., 0.02);
      }
}



TEST(BlockPush, goes_on_through_changes_of_the_mesh)
{
  const auto result = run_block_case<2>(make_parameters(
    pushed_plane + soft +
    does("press 5 MPa in 1 s; push 0.9 MPa in 1 s; push 0.2 MPa in 1 s") +
    Settings{{"Block/Refinement", "adaptive 2"},
             {"Block/Adaptivity/Tolerance", "0.1"}}));
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.summary.cells, 16u);
  EXPECT_NEAR(row_at_time(result.history, 2.).tangential_load, 18., 2e-5);
  EXPECT_NEAR(result.history.back().tangential_load, 4., 2e-5);
}
