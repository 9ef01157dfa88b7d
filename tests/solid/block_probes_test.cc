// SPDX-License-Identifier: LGPL-2.1-or-later

// Displacements of points and what acts through faces, against closed forms.

#include "block_test_tools.h"

#include <slipstep/solid/block_probes.h>
#include <slipstep/solid/point_lines.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "tests/temporary_folder.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  constexpr double L = 10., W = 4., H = 5., E = 1e4;

  // It sticks, and nothing expands sideways.
  Settings stuck(const unsigned int dim)
  {
    return {{"Block/Dimension", std::to_string(dim)},
            {"Block/Size", dim == 2 ? "10 mm, 5 mm" : "10 mm, 4 mm, 5 mm"},
            {"Block/Subdivisions", dim == 2 ? "4, 2" : "4, 2, 2"},
            {"Block/Young modulus", "10 GPa"},
            {"Block/Poisson ratio", "0"},
            {"Block/Newton tolerance", "1e-11"},
            {"Block/Faces/top", "pressure programme"},
            {"Friction/Effects", ""},
            {"Friction/Static coefficient", "0.9"},
            {"Friction/Normal stiffness", "1e4"},
            {"Friction/Tangential stiffness", "1e4"},
            {"Loading/Programme", "press 5 MPa in 1 s"},
            {"Time stepping/Tolerance", "1e-3"}};
  }

  template <int dim>
  std::vector<double> probes_at_end(const Settings    &settings,
                                    const std::string &quantities)
  {
    const Parameters parameters =
      make_parameters(settings + Settings{{"Output/Quantities", quantities}});
    const Programme     programme = parse_programme(parameters);
    std::vector<double> values;
    const auto          result = run_block_case<dim>(
      parameters, MPI_COMM_SELF, [&](const Block<dim> &block) {
        values = BlockProbes<dim>(BlockParameters(parameters, programme),
                                  programme,
                                  parse_quantities(parameters, programme))
                   .values(block, MPI_COMM_SELF);
      });
    EXPECT_EQ(result.failure, "");
    return values;
  }

  // The plane, and the traction of the contact, are elastic: 5 MPa / 1e4
  // MPa/mm.
  constexpr double penetration = 5e-4;
} // namespace



TEST(BlockProbes, uniform_compression_in_2d)
{
  const auto values = probes_at_end<2>(
    stuck(2),
    "displacement y at (3.3 mm, 5 mm); displacement y at (3.3 mm, 1.7 mm); "
    "displacement x at (10 mm, 0 mm); force y on bottom; force y on top; "
    "moment z on bottom; largest pressure; smallest pressure; force x on left");
  EXPECT_NEAR(values[0], -penetration - 5. * H / E, 1e-10);
  EXPECT_NEAR(values[1], -penetration - 5. * 1.7 / E, 1e-10);
  EXPECT_NEAR(values[2], 0., 1e-10);
  EXPECT_NEAR(values[3], 5. * L, 1e-8);
  EXPECT_NEAR(values[4], -5. * L, 1e-8);
  EXPECT_NEAR(values[5], 0., 1e-8);
  EXPECT_NEAR(values[6], 5., 1e-8);
  EXPECT_NEAR(values[7], 5., 1e-8);
  EXPECT_NEAR(values[8], 0., 1e-8);
}



// Simple shear by a drive and by tractions on the sides: gamma = tau / G,
// G = E / 2. The contact gives way, too, by 1 MPa / 1e4 MPa/mm.
TEST(BlockProbes, simple_shear_in_3d)
{
  const double tau    = 1.;
  const auto   values = probes_at_end<3>(
    stuck(3) +
      Settings{{"Block/Degree", "2"},
               {"Block/Newton tolerance", "1e-10"},
               {"Block/Faces/top", "pressure 5 MPa; drive"},
               {"Block/Faces/left", "traction 0 0 -1 MPa"},
               {"Block/Faces/right", "traction 0 0 1 MPa"},
               {"Loading/Programme", "hold 1 s; slide 1 mm/s for 0.0011 mm"}},
    "displacement x at (5 mm, 1 mm, 5 mm); displacement x at (5 mm, 1 mm, 0 "
      "mm); force x on bottom; force x on top; force z on right; moment y on "
      "bottom; force z on bottom; moment x on bottom; moment z on bottom");
  EXPECT_NEAR(values[0] - values[1], tau * H / (E / 2.), 1e-9);
  EXPECT_NEAR(values[2], -tau * L * W, 1e-5);
  EXPECT_NEAR(values[3], tau * L * W, 1e-5);
  EXPECT_NEAR(values[4], tau * H * W, 1e-7);
  EXPECT_NEAR(values[6], 5. * L * W, 1e-5);
  for (const unsigned int i : {5, 7, 8})
    EXPECT_NEAR(values[i], 0., 1e-4) << i;
}



// A stiff block driven at its top by a force T turns on the springs of the
// plane: the pressure is linear, p + 12 M x / L^3 with M = T H, and its moment
// is M.
TEST(BlockProbes, moment_of_a_linear_traction)
{
  const auto values = probes_at_end<2>(
    stuck(2) +
      Settings{{"Block/Young modulus", "1e5 GPa"},
               {"Block/Newton tolerance", "1e-8"},
               {"Block/Faces/top", "pressure 5 MPa; drive"},
               {"Loading/Programme", "hold 1 s; slide 1 mm/s for 0.0001 mm"}},
    "moment z on bottom; force x on bottom; largest pressure; smallest "
    "pressure; moment z on top; force x on top");
  const double T = values[5], M = T * H;
  EXPECT_GT(T, 1.);
  EXPECT_NEAR(values[0], M, 1e-5 * M);
  EXPECT_NEAR(values[1], -T, 1e-5 * T);
  // The outermost of two Gauss points in cells of 2.5 mm.
  const double x = L / 2. - 1.25 * (1. - 1. / std::sqrt(3.));
  EXPECT_NEAR(values[2], 5. + 12. * M * x / (L * L * L), 5e-3);
  EXPECT_NEAR(values[3], 5. - 12. * M * x / (L * L * L), 5e-3);
  EXPECT_NEAR(values[4], 0., 1e-5 * M);
}



// All that acts on a block that is driven, held and loaded, on an adaptive mesh
// with hanging nodes: no resultant, and no moment about the origin.
TEST(BlockProbes, actions_through_all_faces_are_in_balance)
{
  const std::vector<std::string> faces = face_names(3);
  const Settings                 settings =
    stuck(3) + Settings{{"Block/Poisson ratio", "0.3"},
                        {"Block/Faces/top", "pressure programme; drive; flat"},
                        {"Block/Faces/left", "traction 0.5 0 0 MPa"},
                        {"Block/Faces/back", "displacement y 0 mm"},
                        {"Friction/Static coefficient", "0.1"},
                        {"Loading/Programme",
                         "press 5 MPa in 1 s; slide 1 mm/s for 0.01 mm"},
                        {"Block/Refinement", "adaptive 1"},
                        {"Block/Adaptivity/Tolerance", "0.001"},
                        {"Block/Adaptivity/Most cells", "60"},
                        {"Block/Adaptivity/Beyond the limit", "warn"},
                        {"Time stepping/Tolerance", "3e-2"},
                        {"Time stepping/Least steps per statement", "2"}};
  run_block_case<3>(
    make_parameters(settings), MPI_COMM_SELF, [&](const Block<3> &block) {
      EXPECT_TRUE(
        block.state().unknowns.get_triangulation().has_hanging_nodes());
      dealii::Tensor<1, 3> force, moment;
      double               largest = 0.;
      for (unsigned int f = 0; f < 6; ++f)
        {
          const FaceAction     action = block.action_on(f);
          dealii::Tensor<1, 3> centre;
          const double         size[] = {L, W, H};
          for (unsigned int d = 0; d < 3; ++d)
            centre[d] = d != f / 2 ? size[d] / 2. : f % 2 == 0 ? 0. : size[d];
          force += action.force;
          moment +=
            action.moment + dealii::cross_product_3d(centre, action.force);
          largest = std::max(largest, action.force.norm());
        }
      EXPECT_GT(largest, 100.);
      EXPECT_LT(force.norm(), 1e-6 * largest);
      EXPECT_LT(moment.norm(), 1e-5 * largest * L);
      // The drive pulls forward, the plane back.
      EXPECT_GT(block.action_on(5).force[0], 1.);
      EXPECT_LT(block.action_on(4).force[0], -1.);
      // Nothing touches the front.
      EXPECT_EQ(block.action_on(2).force.norm(), 0.);
    });
}



// Displacements are in space: the top follows the drive.
TEST(BlockProbes, displacements_are_in_space)
{
  const auto values = probes_at_end<2>(
    stuck(2) + Settings{{"Block/Faces/top", "pressure programme; drive"},
                        {"Loading/Programme",
                         "press 5 MPa in 1 s; slide 1 mm/s for 0.002 mm"}},
    "displacement x at (5 mm, 5 mm); displacement x at (5 mm, 0 mm)");
  EXPECT_NEAR(values[0], 0.002, 1e-12);
  EXPECT_GT(values[1], 0.);
  EXPECT_LT(values[1], 0.002);
}



// A soft contact is a bed that the block sinks into.
TEST(BlockProbes, a_bed_that_gives_is_told)
{
  const auto soft = run_block_case<2>(make_parameters(
    stuck(2) + Settings{{"Friction/Normal stiffness", "10 MPa/mm"}}));
  ASSERT_FALSE(soft.summary.warnings.empty());
  EXPECT_NE(soft.summary.warnings[0].find("sinks 0.5 mm into the plane"),
            std::string::npos)
    << soft.summary.warnings[0];
}



// The load on a post of 10 mm x 200 mm whose foot sticks and whose head is
// pushed aside: bent as a cantilever, N delta / (F H) = N H^2 / (3 E' I).
TEST(BlockProbes, a_lean_that_turns_the_load_is_told)
{
  const Settings post = {{"Block/Dimension", "2"},
                         {"Block/Size", "10 mm, 200 mm"},
                         {"Block/Subdivisions", "2, 16"},
                         {"Block/Degree", "2"},
                         {"Block/Young modulus", "2e5 MPa"},
                         {"Block/Poisson ratio", "0.3"},
                         {"Block/Faces/bottom", "contact"},
                         {"Block/Faces/top", "drive; pressure programme"},
                         {"Friction/Effects", "subloading"},
                         {"Friction/Static coefficient", "0.5"},
                         {"Friction/Normal stiffness", "1e6"},
                         {"Friction/Tangential stiffness", "1e6"}};
  const auto     lean = [&](const double pressure, const double distance) {
    const auto result = run_block_case<2>(
      make_parameters(post + Settings{{"Loading/Programme",
                                       "press " + std::to_string(pressure) +
                                         " MPa in 1 s; slide 1 mm/s for " +
                                         std::to_string(distance) + " mm"}}));
    for (const std::string &warning : result.summary.warnings)
      if (warning.find("leans") != std::string::npos)
        return warning;
    return std::string();
  };
  const auto share = [&](const std::string &warning, const std::string &what) {
    const std::size_t at = warning.find(what + " some ");
    return at == std::string::npos ?
             0. :
             std::stod(warning.substr(at + what.size() + 6));
  };
  // A foot that gives a little adds to 36.4 % of a cantilever.
  for (const double distance : {0.05, 0.45})
    {
      const std::string warning = lean(50., distance);
      EXPECT_NEAR(share(warning, "edges is off by"), 60. * distance, 0.5)
        << warning;
      EXPECT_NEAR(share(warning, "bends it by"), 36.4, 1.) << warning;
    }
  // Under less load it turns on its edge: F H = N L / 2.
  EXPECT_NEAR(share(lean(5., 0.45), "bends it by"), 9., 1.1) << lean(5., 0.45);
  // A lean that hardly counts.
  EXPECT_EQ(lean(5., 0.05), "");
}



// The same post in elements that cannot bend without a change of volume.
TEST(BlockProbes, elements_that_lock_are_told)
{
  const auto warnings = [](const std::string &degree,
                           const std::string &poisson_ratio) {
    return run_block_case<2>(
             make_parameters(stuck(2) +
                             Settings{{"Block/Degree", degree},
                                      {"Block/Poisson ratio", poisson_ratio}}))
      .summary.warnings;
  };
  EXPECT_TRUE(warnings("2", "0.49").empty());
  EXPECT_TRUE(warnings("1", "0.4").empty());
  ASSERT_EQ(warnings("1", "0.49").size(), 1u);
  EXPECT_NE(warnings("1", "0.49")[0].find("Poisson's ratio of 0.49"),
            std::string::npos);
}



// A block as high as long, with much friction, lifts at its rear edge.
TEST(BlockProbes, opening_of_the_contact_is_told)
{
  const Settings tall =
    stuck(2) + Settings{{"Block/Faces/top", "pressure programme; drive"},
                        {"Friction/Static coefficient", "0.6"},
                        {"Loading/Programme",
                         "press 5 MPa in 1 s; slide 1 mm/s for 0.02 mm"}};
  const auto closed = run_block_case<2>(
    make_parameters(tall + Settings{{"Friction/Static coefficient", "0.1"}}));
  EXPECT_EQ(closed.summary.opening.share, 0.);
  EXPECT_TRUE(closed.summary.warnings.empty());

  const auto open = run_block_case<2>(
    make_parameters(tall + Settings{{"Block/Subdivisions", "64, 4"}}));
  EXPECT_GT(open.summary.opening.share, 0.);
  EXPECT_GT(open.summary.opening.time, 1.);
  ASSERT_FALSE(open.summary.warnings.empty());
  EXPECT_NE(open.summary.warnings[0].find("lifted off the plane"),
            std::string::npos);

  // Few cells along the motion, which is along y for a block on its side, turn
  // it early.
  const auto warning = [&](const std::string &subdivisions,
                           const std::string &refinement = "none") {
    const auto result = run_block_case<2>(make_parameters(
      tall + Settings{{"Block/Refinement", refinement},
                      {"Block/Faces/bottom", "free"},
                      {"Block/Faces/top", "free"},
                      {"Block/Faces/left", "contact"},
                      {"Block/Faces/right", "pressure programme; drive"},
                      {"Friction/Static coefficient", "0.45"},
                      {"Block/Subdivisions", subdivisions}}));
    return result.summary.warnings.empty() ? "" : result.summary.warnings[0];
  };
  EXPECT_EQ(warning("2, 8").find("so few cells along its length"),
            std::string::npos)
    << warning("2, 8");
  EXPECT_NE(warning("8, 2").find("so few cells along its length"),
            std::string::npos)
    << warning("8, 2");
  // The same cells, halved.
  EXPECT_EQ(warning("4, 2", "uniform 1").find("so few cells along its length"),
            std::string::npos);
  EXPECT_NE(warning("4, 2", "uniform 1").find("lifted off the plane"),
            std::string::npos);
  EXPECT_NE(warning("4, 1", "uniform 1").find("so few cells along its length"),
            std::string::npos);

  // A gap, as small as it is, tells of what had touched before.
  const auto gap = run_block_case<2>(
    make_parameters(tall + Settings{{"Block/Subdivisions", "64, 4"},
                                    {"Contact/Gap", "1e-12*x"}}));
  EXPECT_NEAR(gap.summary.opening.share, open.summary.opening.share, 1e-9);
  ASSERT_FALSE(gap.summary.warnings.empty());
  EXPECT_NE(gap.summary.warnings[0].find("lifted off the plane"),
            std::string::npos);
}



// What needs no pressure is lost by and by where the face lifts off: lost at
// once, there was no equilibrium. Only the last corner lifts here, under which
// friction is that of all the others and what is added.
TEST(BlockProbes, a_face_that_bonds_or_drags_lifts_off)
{
  const auto peak = [](const std::string &effect, const std::string &key) {
    const auto result = run_block_case<2>(make_parameters(
      {{"Loading/Programme", "press 5 MPa in 1 s; slide 20 mm/s for 1 mm"},
       {"Friction/Effects", effect},
       {"Friction/Static coefficient", "0.3"},
       {"Friction/" + effect + "/" + key, "0.01"},
       {"Block/Dimension", "2"},
       {"Block/Size", "10 mm, 10 mm"},
       {"Block/Subdivisions", "4, 4"},
       {"Block/Faces/top", "pressure programme; drive"}}));
    EXPECT_GT(result.summary.opening.share, 0.);
    return result.summary.final_friction;
  };
  // Of the share that stays closed.
  EXPECT_NEAR(peak("viscous", "Drag"), 0.3 + 0.01 * 20. / 5., 0.02);
  EXPECT_NEAR(peak("adhesion", "Strength"), 0.3 + 0.01 / 5., 1e-3);
}



// Uniform compression along a vertical line, 5 points.
TEST(PointLines, have_the_displacements_of_their_points)
{
  const Parameters parameters = make_parameters(
    stuck(2) +
    Settings{{"Output/Lines", "(3 mm, 0 mm) to (3 mm, 5 mm) with 5 points"}});
  const Programme       programme = parse_programme(parameters);
  const BlockParameters block_parameters(parameters, programme);
  const auto            folder = test_folder();
  run_block_case<2>(parameters, MPI_COMM_SELF, [&](const Block<2> &block) {
    write_lines(folder,
                parse_lines(parameters, block_parameters),
                block,
                MPI_COMM_SELF);
  });
  std::ifstream in(folder / "lines.csv");
  std::string   text;
  std::getline(in, text);
  EXPECT_EQ(text,
            "line,distance_mm,x_mm,y_mm,displacement_x_mm,displacement_y_mm");
  for (unsigned int n = 0; n < 5; ++n)
    {
      std::getline(in, text);
      std::istringstream  cells(text);
      std::vector<double> row;
      for (std::string cell; std::getline(cells, cell, ',');)
        row.push_back(std::stod(cell));
      ASSERT_EQ(row.size(), 6u);
      EXPECT_EQ(row[0], 1.);
      EXPECT_NEAR(row[1], 1.25 * n, 1e-12);
      EXPECT_NEAR(row[2], 3., 1e-12);
      EXPECT_NEAR(row[3], 1.25 * n, 1e-12);
      EXPECT_NEAR(row[5], -penetration - 5. * 1.25 * n / E, 1e-10);
    }
  EXPECT_FALSE(std::getline(in, text));
}
