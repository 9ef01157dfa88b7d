// SPDX-License-Identifier: LGPL-2.1-or-later

// A face that is not flat, and one that is not equally strong everywhere.

#include "block_test_tools.h"

#include <slipstep/utilities/lists.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

#include "tests/temporary_folder.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  const Settings coulomb_law = {{"Friction/Effects", ""},
                                {"Friction/Static coefficient", "0.1"}};
  const Settings flat_2d     = {{"Block/Dimension", "2"},
                                {"Block/Size", "10 mm, 10 mm"},
                                {"Block/Subdivisions", "4, 4"}};
  // Held along the normal, and moved towards the plane.
  const Settings moved_2d = {{"Block/Faces/top",
                              "displacement y -0.001 mm; drive"},
                             {"Block/Poisson ratio", "0"}};

  // Least squares of p^2 over (x - x_0)^2: p_0 and a of Hertz's ellipse.
  template <int dim>
  std::array<double, 2> fit_ellipse(const ContactFace<dim> &contact,
                                    const double            centre)
  {
    std::array<double, 5> sums{};
    double                highest = 0.;
    for (const bool is_sum : {false, true})
      for (const auto &face : contact.cell_faces())
        for (const auto &point : face.points)
          {
            const double p = point.point.committed().normal_traction;
            highest        = std::max(highest, p);
            if (!is_sum || p < 0.3 * highest)
              continue;
            const double x = std::pow(point.position[0] - centre, 2);
            const double w = point.JxW;
            sums[0] += w;
            sums[1] += w * x;
            sums[2] += w * x * x;
            sums[3] += w * p * p;
            sums[4] += w * p * p * x;
          }
    const double det   = sums[0] * sums[2] - sums[1] * sums[1];
    const double start = (sums[3] * sums[2] - sums[4] * sums[1]) / det;
    const double slope = (sums[0] * sums[4] - sums[1] * sums[3]) / det;
    return {{std::sqrt(start), std::sqrt(-start / slope)}};
  }
} // namespace



// Block and contact are springs in series once the gap has closed.
TEST(Gap, ClosesBeforeItPresses)
{
  const double pressure = (0.001 - 0.0004) / (10. / 206e3 + 1. / 1e5);
  const auto   in_2d    = run_block_case<2>(
    make_parameters(coulomb_law + flat_2d + moved_2d +
                    Settings{{"Contact/Gap", "0.0004 + 0*x"},
                             {"Loading/Programme", "hold 1 s"}}));
  EXPECT_EQ(in_2d.failure, "");
  EXPECT_NEAR(in_2d.history.back().pressure, pressure, 1e-7);
  EXPECT_EQ(in_2d.history.front().pressure, 0.);

  const auto in_3d = run_block_case<3>(make_parameters(
    coulomb_law + moved_2d +
    Settings{{"Block/Faces/top", "displacement z -0.001 mm; drive"},
             {"Block/Subdivisions", "2, 2, 2"},
             {"Contact/Gap", "0.0004 + 0*(x + y)"},
             {"Loading/Programme", "hold 1 s"}}));
  EXPECT_EQ(in_3d.failure, "");
  EXPECT_NEAR(in_3d.history.back().pressure, pressure, 1e-7);
}



// A block that nothing holds stands on the plane before it is loaded.
TEST(Gap, AConstantMakesNoDifferenceToABlockThatFalls)
{
  const Settings settings =
    coulomb_law + flat_2d +
    Settings{
      {"Loading/Programme", "press 5.8 MPa in 1 s; slide 1 mm/s for 1 um"}};
  const auto flat  = run_block_case<2>(make_parameters(settings));
  const auto above = run_block_case<2>(
    make_parameters(settings + Settings{{"Contact/Gap", "3"}}));
  EXPECT_NEAR(flat.history.back().friction,
              above.history.back().friction,
              1e-5);
}



// A plane that leans against the block: that tips until it lies on it, at no
// load, and is then pressed evenly, so that it feels no friction. A first step
// of a tenth of the load held the block back by a tenth of the strength.
TEST(Gap, BlocksTipAtNoLoad)
{
  const Settings settings =
    coulomb_law + Settings{{"Loading/Programme", "press 5 MPa in 1 s"}};
  const auto in_2d = run_block_case<2>(make_parameters(
    settings + flat_2d + Settings{{"Contact/Gap", "0.0005*x"}}));
  ASSERT_EQ(in_2d.failure, "");
  EXPECT_LT(std::abs(in_2d.history.back().friction), 1e-3 * 0.1);
  EXPECT_LT(in_2d.history.size(), 60);
  const auto in_3d = run_block_case<3>(make_parameters(
    settings + Settings{{"Block/Subdivisions", "2, 2, 2"},
                        {"Contact/Gap", "0.0005*x + 0.0003*y"}}));
  ASSERT_EQ(in_3d.failure, "");
  EXPECT_LT(std::abs(in_3d.history.back().friction), 1e-3 * 0.1);
}



// On its edge, too: the less the first load, the nearer the way it goes.
TEST(Gap, BlocksAreSetOnEdgesGently)
{
  const Settings settings =
    coulomb_law + flat_2d +
    Settings{{"Block/Young modulus", "10 GPa"},
             {"Contact/Gap", "0.0005*abs(x - 3)"},
             {"Loading/Programme", "press 5 MPa in 1 s"}};
  const auto once  = run_block_case<2>(make_parameters(settings));
  const auto twice = run_block_case<2>(make_parameters(
    settings + Settings{{"Loading/Programme",
                         "press 0.01 MPa in 1 s; press 5 MPa in 1 s"}}));
  ASSERT_EQ(once.failure + twice.failure, "");
  EXPECT_NEAR(once.history.back().friction,
              twice.history.back().friction,
              2e-3 * 0.1);
}



// A point that closes during a step slips from when it touches: exact in a
// rigid block that moves evenly, however long the steps.
TEST(Gap, SlipCountsFromTouch)
{
  for (const std::string steps : {"3", "5", "16"})
    {
      const auto result = run_block_case<2>(make_parameters(
        flat_2d + moved_2d +
        Settings{{"Friction/Effects", ""},
                 {"Friction/Static coefficient", "50"},
                 {"Block/Young modulus", "1e10"},
                 {"Block/Subdivisions", "1, 1"},
                 {"Contact/Gap", "0.0004"},
                 {"Time stepping/Equal steps per statement", steps},
                 {"Loading/Programme", "slide 0.002 mm/s for 0.002 mm"}}));
      EXPECT_EQ(result.failure, "");
      const HistoryRow &end = result.history.back();
      EXPECT_NEAR(end.normal_load, 0.006 / (1e-5 + 1e-9), 1e-6) << steps;
      // Touches at 0.4 s.
      EXPECT_NEAR(end.tangential_load, 1e4 * 0.0012 * 10., 1e-2) << steps;
    }
}



// Where a point of a pattern is does not depend on when it touched: it was
// carried along before, as those that never touch are.
TEST(Gap, PlacesAreWhereTheBlockHasGoneTo)
{
  // The contact widens while it slides.
  const std::filesystem::path ramp = test_folder() / "ramp.csv";
  std::ofstream(ramp) << "time_s,displacement_mm,pressure_MPa,friction\n"
                         "0,0,1,0\n5,5,10,0.3\n";
  const std::map<std::string, Settings> patterns = {
    {"track_1_mm",
     {{"Friction/Effects", "texture"}, {"Friction/texture/Wavelength", "2"}}},
    {"position_mm",
     {{"Friction/Effects", "expression"},
      {"Friction/expression/Covariate", "position"},
      {"Friction/expression/Formula", "1 + 0.1*sin(x)"}}}};
  for (const auto &[place, pattern] : patterns)
    for (const std::string steps : {"4", "12"})
      {
        double least = 1e9, most = -1e9;
        run_block_case<2>(
          make_parameters(
            flat_2d + pattern +
            Settings{{"Friction/Static coefficient", "0.3"},
                     {"Block/Young modulus", "1e4"},
                     {"Contact/Gap", "(x - 5)^2/6000"},
                     {"Time stepping/Equal steps per statement", steps},
                     {"Loading/Programme",
                      "press 1 MPa in 1 s; follow " + ramp.string()}}),
          MPI_COMM_SELF,
          [&, memory = contact_memory(place)](const Block<2> &block) {
            for (const auto &face : block.state().contact_face.cell_faces())
              for (const auto &point : face.points)
                {
                  const double at = point.point.committed()[memory];
                  least           = std::min(least, at);
                  most            = std::max(most, at);
                }
          });
        // The elastic displacement of the face is of this size.
        EXPECT_GT(least, 4.95) << place << ' ' << steps;
        EXPECT_LT(most, 5.) << place << ' ' << steps;
      }
}



// Hertz (1882), a cylinder in plane strain: a = (4 P R / (pi E*))^(1/2),
// p_0 = 2 P / (pi a); the load is controlled, and no point touches at first.
TEST(Gap, Hertz)
{
  const double P = 10., R = 100., E = 1000. / (1. - 0.3 * 0.3);
  const double a = std::sqrt(4. * P * R / (dealii::numbers::PI * E));
  run_block_case<2>(
    make_parameters(
      Settings{{"Friction/Effects", ""},
               {"Friction/Static coefficient", "1e-9"},
               {"Friction/Normal stiffness", "1e6"},
               {"Block/Dimension", "2"},
               {"Block/Size", "40 mm, 40 mm"},
               {"Block/Subdivisions", "8, 8"},
               {"Block/Degree", "2"},
               {"Block/Young modulus", "1000 MPa"},
               {"Block/Refinement", "adaptive 7"},
               {"Block/Adaptivity/Goal", "contact"},
               {"Block/Adaptivity/Tolerance", "0.2"},
               {"Block/Faces/top", "pressure programme; flat; drive"},
               {"Contact/Gap", "(x - 20)^2/(2*100)"},
               {"Time stepping/Equal steps per statement", "4"},
               {"Loading/Programme", "press 0.25 MPa in 1 s"}}),
    MPI_COMM_SELF,
    [&](const Block<2> &block) {
      const auto fit = fit_ellipse(block.state().contact_face, 20.);
      EXPECT_NEAR(fit[0], 2. * P / (dealii::numbers::PI * a), 0.01 * fit[0]);
      EXPECT_NEAR(fit[1], a, 0.01 * a);
      // The edge of the contact has been refined, the free face has not.
      for (const auto &face : block.state().contact_face.cell_faces())
        {
          const double away =
            std::abs(face.cell->face(face.face)->center()[0] - 20.);
          if (std::abs(away - a) < 0.1)
            {
              EXPECT_GE(face.cell->level(), 8);
            }
          else if (away > 10.)
            {
              EXPECT_LE(face.cell->level(), 5);
            }
        }
    });
}



// In full slip every point bears its own strength, also on cells that were
// refined and merged on the way.
// A cylinder of 20 mm touches over 2 * 1.1 mm of 10 mm.
TEST(Gap, AContactOfFewCellsIsTold)
{
  const auto is_told = [](const std::string &subdivisions,
                          const std::string &gap) {
    const auto result = run_block_case<2>(make_parameters(
      coulomb_law + flat_2d +
      Settings{{"Contact/Gap", gap},
               {"Block/Subdivisions", subdivisions},
               {"Block/Young modulus", "1 GPa"},
               {"Block/Faces/top", "pressure programme; drive; flat"},
               {"Loading/Programme", "press 5 MPa in 1 s"}}));
    EXPECT_EQ(result.failure, "");
    return any_of(result.summary.warnings, [](const std::string &warning) {
      return warning.find("lie across the contact of the rounded face") !=
             std::string::npos;
    });
  };
  EXPECT_TRUE(is_told("8, 4", "(x - 5)^2/40"));
  EXPECT_FALSE(is_told("64, 16", "(x - 5)^2/40"));
  // All of it touches.
  EXPECT_FALSE(is_told("4, 2", "1e-6*(x - 5)^2"));
}



TEST(StrengthMap, HoldsAtEveryPoint)
{
  const std::string map = "1 - 0.4*(abs(x - 5) < 1.3)";
  for (const std::string refinement : {"uniform 0", "adaptive 2"})
    {
      const auto result = run_block_case<2>(
        make_parameters(
          coulomb_law + flat_2d +
          Settings{{"Contact/Strength", map},
                   {"Block/Refinement", refinement},
                   {"Loading/Programme",
                    "press 5.8 MPa in 1 s; slide 1 mm/s for 0.05 mm"}}),
        MPI_COMM_SELF,
        [&](const Block<2> &block) {
          for (const auto &face : block.state().contact_face.cell_faces())
            for (const auto &point : face.points)
              {
                const ContactState &state = point.point.committed();
                const double        factor =
                  std::abs(point.position[0] - 5.) < 1.3 ? 0.6 : 1.;
                EXPECT_NEAR(state.traction[0],
                            factor * 0.1 * state.normal_traction,
                            1e-6);
              }
        });
      EXPECT_EQ(result.failure, "");
      EXPECT_LT(result.history.back().friction, 0.095);
    }
}



// A strip between the contact points, and one that they see well.
TEST(StrengthMap, IsWarnedOfWhereContactPointsMissIt)
{
  const auto result = [](const std::string &subdivisions) {
    return run_block_case<2>(make_parameters(
      coulomb_law + flat_2d +
      Settings{{"Contact/Strength", "1 - 0.5*(abs(x - 5) < 0.5)"},
               {"Block/Subdivisions", subdivisions},
               {"Block/Poisson ratio", "0"},
               {"Loading/Programme",
                "press 5.8 MPa in 1 s; slide 1 mm/s for 0.05 mm"}}));
  };
  const auto coarse = result("2, 1");
  EXPECT_NEAR(coarse.history.back().friction, 0.1, 1e-6);
  ASSERT_FALSE(coarse.summary.warnings.empty());
  EXPECT_NE(coarse.summary.warnings[0].find(
              "(map Contact/Strength) is too high, by 5.3 % on average"),
            std::string::npos)
    << coarse.summary.warnings[0];
  const auto fine = result("20, 1");
  EXPECT_NEAR(fine.history.back().friction, 0.095, 1e-4);
  for (const std::string &warning : fine.summary.warnings)
    EXPECT_EQ(warning.find("the map"), std::string::npos) << warning;
}



// A factor of the strength is one of the coefficient, for all effects that
// multiply; tangents follow.
TEST(StrengthMap, IsAFactorOfTheCoefficient)
{
  const auto parameters = [](const std::string &coefficient) {
    return make_parameters(
      {{"Friction/Effects", "subloading, overstress, pressure"},
       {"Friction/pressure/Exponent", "0.8"},
       {"Friction/Static coefficient", coefficient}});
  };
  const FrictionLaw    whole(parameters("0.2")), part(parameters("0.12"));
  ContactState         start = whole.initial_state(), end, expected;
  dealii::Tensor<1, 2> slip;
  slip[0]               = 1e-3;
  slip[1]               = 5e-4;
  start.strength_factor = 0.6;
  const auto response   = whole.update(start, slip, 5., 0.1, end);
  const auto other = part.update(part.initial_state(), slip, 5., 0.1, expected);
  EXPECT_NEAR(end.strength, expected.strength, 1e-12);
  EXPECT_LT((response.traction - other.traction).norm(), 1e-12);
  EXPECT_LT((response.d_slip - other.d_slip).norm(), 1e-8);
  EXPECT_LT((response.d_normal - other.d_normal).norm(), 1e-12);
}
