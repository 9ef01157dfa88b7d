// SPDX-License-Identifier: LGPL-2.1-or-later

// A block that wears, against Archard's law for the whole face and for each
// point of it.

#include <gtest/gtest.h>

#include <cmath>

#include "block_test_tools.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  constexpr double pressure = 10., path = 0.5; // [MPa], [mm]

  // Its top stays flat, so that the moment of friction does not tilt it.
  Settings worn(const double specific_rate)
  {
    return {{"Friction/Effects", "wear"},
            {"Friction/wear/Specific rate", std::to_string(specific_rate)},
            {"Friction/Static coefficient", "0.2"},
            {"Friction/Normal stiffness", "1e4 MPa/mm"},
            {"Friction/Tangential stiffness", "1e5 MPa/mm"},
            {"Block/Dimension", "2"},
            {"Block/Size", "10 mm, 5 mm"},
            {"Block/Subdivisions", "16, 8"},
            {"Block/Young modulus", "1e4 MPa"},
            {"Block/Faces/top", "pressure programme; drive; flat"},
            {"Loading/Programme",
             "press 10 MPa in 1 s; slide 1 mm/s for 0.5 mm"}};
  }

  struct Worn
  {
    BlockResult result;
    double      volume = 0.; ///< per width [mm^2]
    double      spread = 0.; ///< of the pressure, relative to its mean
  };

  Worn wear(const Settings &settings)
  {
    const ContactMemory &depth = contact_memory("worn_depth_mm");
    Worn                 worn;
    worn.result = run_block_case<2>(
      make_parameters(settings), MPI_COMM_SELF, [&](const Block<2> &block) {
        for (const auto &face : block.state().contact_face.cell_faces())
          for (const auto &point : face.points)
            {
              const ContactState &state = point.point.committed();
              worn.volume += point.JxW * state[depth];
              worn.spread =
                std::max(worn.spread,
                         std::abs(state.normal_traction / pressure - 1.));
            }
      });
    EXPECT_EQ(worn.result.failure, "");
    return worn;
  }
} // namespace



// Load times path times k, wherever the pressure is.
TEST(BlockWear, loses_load_times_path_times_k)
{
  for (const double specific_rate : {0.1, 1., 10.})
    {
      const Worn        worn_block = wear(worn(specific_rate));
      const HistoryRow &last       = worn_block.result.history.back();
      const double      load       = pressure * 10.;
      EXPECT_NEAR(last.normal_load, load, 1e-6 * load);
      // Part of the path is shear of the block.
      EXPECT_NEAR(last.slip, path, 0.01 * path);
      EXPECT_NEAR(worn_block.volume / (1e-3 * specific_rate * load * last.slip),
                  1.,
                  1e-3)
        << specific_rate;
      EXPECT_NEAR(last.stored_energy + last.dissipated_energy,
                  last.external_work,
                  2e-3 * last.external_work)
        << specific_rate;
    }
}



// Where the pressure is high more wears away, until it is the same everywhere.
TEST(BlockWear, evens_the_pressure_out)
{
  const double fresh = wear(worn(0.)).spread;
  EXPECT_GT(fresh, 0.1);
  EXPECT_LT(wear(worn(1.)).spread, 0.7 * fresh);
  EXPECT_LT(wear(worn(20.)).spread, 0.01);
}



// Steps may be longer than what wears away is deep.
TEST(BlockWear, hardly_depends_on_the_steps)
{
  std::vector<double> volumes, spreads;
  for (const std::string n : {"10", "20", "40"})
    {
      const Worn result = wear(
        worn(2.) + Settings{{"Time stepping/Equal steps per statement", n}});
      volumes.push_back(result.volume);
      spreads.push_back(result.spread);
    }
  EXPECT_NEAR(volumes[0], volumes[2], 1e-3 * volumes[2]);
  EXPECT_LT(std::abs(spreads[1] - spreads[2]),
            0.5 * std::abs(spreads[0] - spreads[1]) + 1e-6);
}



// Geometry and stiffness are those of the fresh block.
TEST(BlockWear, tells_when_little_is_left)
{
  const Settings few_steps = {{"Time stepping/Equal steps per statement", "10"},
                              {"Block/Subdivisions", "4, 2"}};
  const auto     end       = [&](const double specific_rate) {
    return run_block_case<2>(make_parameters(worn(specific_rate) + few_steps));
  };
  const auto is_warned = [](const BlockResult &result) {
    for (const std::string &warning : result.summary.warnings)
      if (warning.find("of the block's 5 mm are worn away") !=
          std::string::npos)
        return true;
    return false;
  };
  EXPECT_FALSE(is_warned(end(50.)));
  EXPECT_TRUE(is_warned(end(200.)));
  EXPECT_NE(end(1500.).failure.find("the block is worn through"),
            std::string::npos);
}



// The approach of the top is held, so that wear takes the pressure away: with
// the block and its contact as springs in series of stiffness K,
// p = K D exp(-k K s).
TEST(BlockWear, takes_the_pressure_of_a_held_approach)
{
  constexpr double approach = 0.01, k = 1e-5; // [mm], [1/MPa]
  const double     stiffness     = 1. / (5. / 1e7 + 1. / 5714.);
  const auto       largest_error = [&](const std::string &tolerance) {
    const auto result = run_block_case<2>(make_parameters(
      {{"Friction/Effects", "subloading, wear"},
       {"Friction/wear/Specific rate", "1e-2"},
       {"Friction/Static coefficient", "0.2"},
       {"Friction/Normal stiffness", "5714"},
       {"Block/Dimension", "2"},
       {"Block/Size", "10 mm, 5 mm"},
       {"Block/Subdivisions", "2, 2"},
       {"Block/Young modulus", "1e7 MPa"},
       {"Block/Poisson ratio", "0"},
       {"Block/Faces/top", "displacement y -0.01 mm; drive"},
       {"Time stepping/Tolerance", tolerance},
       {"Loading/Programme", "hold 1 s; slide 10 mm/s for 50 mm"}}));
    EXPECT_EQ(result.failure, "");
    double error = 0.;
    for (const HistoryRow &row : result.history)
      if (row.time > 1.)
        error = std::max(error,
                         std::abs(row.pressure /
                                    (stiffness * approach *
                                     std::exp(-k * stiffness * row.slip)) -
                                  1.));
    // Down to 6 % of it.
    EXPECT_LT(result.history.back().pressure, 0.1 * stiffness * approach);
    return error;
  };
  const double coarse = largest_error("5e-4"), fine = largest_error("5e-5");
  EXPECT_LT(coarse, 3e-3);
  EXPECT_LT(fine, 0.3 * coarse);
}
