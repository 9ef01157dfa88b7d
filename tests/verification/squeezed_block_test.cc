// SPDX-License-Identifier: LGPL-2.1-or-later

// A published problem with a coefficient of friction of 1: a plane-strain block
// of 40 x 40 mm (E = 130 GPa, nu = 0.2) on a rigid plane, pressed from above
// with 50 MPa and from the side with 150 MPa, which stands for half of a block
// of 80 mm squeezed from both sides. The contact face opens at the pressed
// side, slips in the middle, and sticks at the plane of symmetry.
//
// The problem was set by the French research group GRECO for a comparison of
// codes; M. Raous, P. Chabrand, F. Lebon, "Numerical methods for frictional
// contact problems and applications", and R. A. Feijoo, H. J. C. Barbosa,
// N. Zouain, "Numerical formulations for contact problems with friction", both
// J. Mec. Theor. Appl. 7, supplement 1 (1988), solve it. The displacements of
// five points of the face are averages over the codes, as code_aster quotes
// them for its validation test SSNV128 (document V6.04.128), which meets the
// first four within 1 %, the last within 4 % (28.65, 27.27, 22.92, 19.93, 15.61
// um with penalties), and itself calls the uncertainty of the averages
// important.

#include <slipstep/solid/block_probes.h>

#include "../solid/block_test_tools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  constexpr double length = 40.; // and height [mm]

  // Distance from the pressed side [mm], displacement away from it [mm], and
  // how well it is known: three digits and the study below, or two digits
  // (1.5e-5 m).
  struct PublishedPoint
  {
    double distance, displacement, tolerance;
  };

  constexpr std::array<PublishedPoint, 5> published = {
    {{0., 28.6e-3, 0.005},
     {1.25, 27.2e-3, 0.005},
     {5., 22.8e-3, 0.005},
     {7.5, 19.8e-3, 0.005},
     {11.25, 15.0e-3, 0.04}}};

  // The mesh is that of SSNV128. The plane has to be stiff: 1e6 MPa/mm yields
  // as much as 0.13 mm of the block.
  const Settings squeezed = {{"Friction/Effects", ""},
                             {"Friction/Static coefficient", "1"},
                             {"Friction/Normal stiffness", "1e6"},
                             {"Friction/Tangential stiffness", "1e6"},
                             {"Block/Dimension", "2"},
                             {"Block/Size", "40 mm, 40 mm"},
                             {"Block/Subdivisions", "32, 32"},
                             {"Block/Young modulus", "130 GPa"},
                             {"Block/Poisson ratio", "0.2"},
                             {"Block/Newton tolerance", "1e-10"},
                             {"Time stepping/Equal steps per statement", "5"},
                             {"Block/Faces/left", "pressure 3 x programme"},
                             {"Block/Faces/right", "displacement x 0 mm"},
                             {"Block/Faces/top", "pressure programme"},
                             {"Loading/Programme", "press 50 MPa in 1 s"}};

  struct Solution
  {
    std::array<double, published.size()> displacement{}; // [mm]
    double open_until = 0., slip_until = 0.; // distance from the side [mm]
    bool   zones_in_order = true;
  };

  // Open, slipping and sticking points in this order from the pressed side on,
  // and the borders half way between them.
  template <int dim>
  void find_zones(const ContactFace<dim> &contact,
                  const bool              mirrored,
                  Solution               &solution)
  {
    double last_open = 0., first_closed = length;
    double last_slip = 0., first_stick = length;
    for (const auto &face : contact.cell_faces())
      for (const auto &point : face.points)
        {
          const ContactState &state = point.point.trial();
          const double        x     = point.position[0];
          const double        d     = mirrored ? length - x : x;
          const bool          open  = state.normal_traction == 0.;
          const bool          slips = state.loading_ratio > 1. - 1e-6;
          if (open)
            last_open = std::max(last_open, d);
          else
            first_closed = std::min(first_closed, d);
          if (!open && slips)
            last_slip = std::max(last_slip, d);
          if (!open && !slips)
            first_stick = std::min(first_stick, d);
        }
    solution.open_until     = (last_open + first_closed) / 2.;
    solution.slip_until     = (last_slip + first_stick) / 2.;
    solution.zones_in_order = last_open < first_closed &&
                              first_closed < last_slip &&
                              last_slip < first_stick;
  }

  template <int dim = 2>
  Solution solve(const Settings &settings = {}, const bool mirrored = false)
  {
    std::vector<dealii::Point<dim>> points(published.size());
    for (unsigned int i = 0; i < points.size(); ++i)
      points[i][0] =
        mirrored ? length - published[i].distance : published[i].distance;
    Solution   solution;
    const auto result = run_block_case<dim>(
      make_parameters(squeezed + settings),
      MPI_COMM_SELF,
      [&](const Block<dim> &block) {
        const auto u = displacements_at(block, points, MPI_COMM_SELF);
        for (unsigned int i = 0; i < points.size(); ++i)
          solution.displacement[i] = (mirrored ? -1. : 1.) * u[i][0];
        find_zones(block.state().contact_face, mirrored, solution);
      });
    EXPECT_EQ(result.failure, "");
    return solution;
  }

  double largest_difference(const Solution &a, const Solution &b)
  {
    double result = 0.;
    for (unsigned int i = 0; i < published.size(); ++i)
      result =
        std::max(result, std::abs(a.displacement[i] / b.displacement[i] - 1.));
    return result;
  }

  // In tolerances.
  double worst_miss(const Solution &solution)
  {
    double result = 0.;
    for (unsigned int i = 0; i < published.size(); ++i)
      result =
        std::max(result,
                 std::abs(solution.displacement[i] / published[i].displacement -
                          1.) /
                   published[i].tolerance);
    return result;
  }
} // namespace



TEST(SqueezedBlock, PublishedDisplacements)
{
  const Solution solution = solve();
  for (unsigned int i = 0; i < published.size(); ++i)
    {
      EXPECT_NEAR(solution.displacement[i] / published[i].displacement,
                  1.,
                  published[i].tolerance);
      std::cout << "at " << published[i].distance
                << " mm: " << 1e3 * solution.displacement[i]
                << " um, published " << 1e3 * published[i].displacement
                << " um\n";
    }
  EXPECT_TRUE(solution.zones_in_order);
  std::cout << "open until " << solution.open_until << ", slip until "
            << solution.slip_until << " mm\n";
}



// What the tolerance of the points known to three digits (0.2 %) has to cover.
TEST(SqueezedBlock, MeshDegreeStepsAndPlaneMatterLittle)
{
  const Solution solution = solve();
  const auto     study =
    [&](const std::string &what, const Settings &settings, const double limit) {
      const Solution finer      = solve(settings);
      const double   difference = largest_difference(finer, solution);
      EXPECT_LT(difference, limit) << what;
      EXPECT_NEAR(finer.open_until, solution.open_until, 1.25) << what;
      EXPECT_NEAR(finer.slip_until, solution.slip_until, 1.25) << what;
      std::cout << what << ": " << 100. * difference << " %\n";
    };
  study("64 x 64 cells", {{"Block/Subdivisions", "64, 64"}}, 1e-3);
  study("Q2", {{"Block/Degree", "2"}}, 1e-3);
  study("1 step", {{"Time stepping/Equal steps per statement", "1"}}, 1e-6);
  study("50 steps", {{"Time stepping/Equal steps per statement", "50"}}, 1e-6);
  study("plane ten times as stiff",
        {{"Friction/Normal stiffness", "1e7"},
         {"Friction/Tangential stiffness", "1e7"}},
        2.5e-3);
}



TEST(SqueezedBlock, WrongFrictionOrLoadWouldBeSeen)
{
  const auto miss = [](const std::string &key, const std::string &value) {
    return worst_miss(solve({{key, value}}));
  };
  EXPECT_LT(worst_miss(solve()), 1.);
  EXPECT_GT(miss("Friction/Static coefficient", "0.95"), 1.5);
  EXPECT_GT(miss("Friction/Static coefficient", "1.05"), 1.5);
  EXPECT_GT(miss("Block/Faces/left", "pressure 2.95 x programme"), 1.5);
  EXPECT_GT(miss("Block/Faces/left", "pressure 3.05 x programme"), 1.5);
  EXPECT_GT(miss("Loading/Programme", "press 49 MPa in 1 s"), 1.5);
  EXPECT_GT(miss("Block/Poisson ratio", "0.19"), 1.5);
}



// Loads that grow together leave what slips slipping, so what counts is their
// end. Pressed first and squeezed then, the block first sticks everywhere, and
// the slip that follows grows from the side, too.
TEST(SqueezedBlock, OrdersAndSpellingsAgree)
{
  const Solution solution    = solve();
  const Settings hold        = {{"Loading/Programme", "hold 1 s"}};
  const auto     expect_same = [&](const Solution &other, const double limit) {
    EXPECT_LT(largest_difference(other, solution), limit);
    EXPECT_NEAR(other.open_until, solution.open_until, 1e-9);
    EXPECT_NEAR(other.slip_until, solution.slip_until, 1e-9);
  };
  expect_same(solve(hold + Settings{{"Block/Faces/left", "pressure 150 MPa"},
                                    {"Block/Faces/top", "traction 0 -50 MPa"}}),
              1e-9);
  expect_same(solve(hold +
                    Settings{{"Block/Faces/left", "traction 150 0 MPa at once"},
                             {"Block/Faces/top", "pressure 50 MPa at once"}}),
              1e-6);
  expect_same(
    solve(hold + Settings{{"Block/Faces/left", "pressure 150 MPa"},
                          {"Block/Faces/top", "pressure 50 MPa at once"},
                          {"Time stepping/Equal steps per statement", "50"}}),
    1e-4);
  expect_same(solve({{"Block/Faces/right", "pressure 3 x programme"},
                     {"Block/Faces/left", "displacement x 0 mm"}},
                    true),
              1e-7);
}



// The slice of a block between two walls without friction.
TEST(SqueezedBlock, InThreeDimensions)
{
  const Solution solid =
    solve<3>({{"Block/Dimension", "3"},
              {"Block/Size", "40 mm, 2.5 mm, 40 mm"},
              {"Block/Subdivisions", "32, 2, 32"},
              {"Block/Faces/front", "displacement y 0 mm"},
              {"Block/Faces/back", "displacement y 0 mm"}});
  EXPECT_LT(largest_difference(solid, solve()), 1e-6);
  EXPECT_LT(worst_miss(solid), 1.);
  EXPECT_TRUE(solid.zones_in_order);
}
