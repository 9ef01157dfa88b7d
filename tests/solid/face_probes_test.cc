// SPDX-License-Identifier: LGPL-2.1-or-later

// Quantities of interest on the contact face: pressures at points and the slip
// front.

#include "block_test_tools.h"

#include <slipstep/solid/block_probes.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  const Settings plane_block = {{"Block/Dimension", "2"},
                                {"Block/Size", "10 mm, 5 mm"},
                                {"Block/Subdivisions", "5, 3"},
                                {"Time stepping/Tolerance", "1e-3"}};

  // Values of the probes when the case is over.
  template <int dim>
  std::vector<double> probes_at_end(const Parameters &parameters)
  {
    std::vector<double> values;
    const Programme     programme = parse_programme(parameters);
    const auto          result    = run_block_case<dim>(
      parameters, MPI_COMM_SELF, [&](const Block<dim> &block) {
        const BlockProbes<dim> probes(BlockParameters(parameters, programme),
                                      programme,
                                      parse_quantities(parameters, programme));
        values = probes.values(block, MPI_COMM_SELF);
      });
    EXPECT_EQ(result.failure, "");
    return values;
  }
} // namespace



// The pressure under the drive varies from end to end. Read off at a quadrature
// point it is the value there; at a border of cells, the finite element
// solution is continuous.
TEST(FaceProbes, pressure_is_that_of_the_solution)
{
  for (const std::string degree : {"1", "2"})
    {
      const Settings slide = {
        {"Loading/Programme", "press 5.8 MPa in 1 s; slide 1 mm/s for 0.01 mm"},
        {"Block/Subdivisions", "2, 3, 2"},
        {"Block/Degree", degree},
        {"Time stepping/Tolerance", "1e-3"}};
      const Parameters parameters = make_parameters(slide);
      const Programme  programme  = parse_programme(parameters);
      run_block_case<3>(parameters, MPI_COMM_SELF, [&](const Block<3> &block) {
        const auto &faces = block.state().contact_face.cell_faces();
        ASSERT_EQ(faces.size(), 6u);
        double least = 1e300, largest = 0.;
        for (const auto &face : faces)
          for (const auto &point : face.points)
            {
              Settings there = slide;
              there.emplace_back("Output/Quantities",
                                 "pressure at (" +
                                   std::to_string(point.position[0]) + " mm, " +
                                   std::to_string(point.position[1]) + " mm)");
              const Parameters     with_point = make_parameters(there);
              const BlockProbes<3> probes(
                BlockParameters(parameters, programme),
                programme,
                parse_quantities(with_point, programme));
              const double pressure = point.point.committed().normal_traction;
              // The text has six digits.
              EXPECT_NEAR(probes.values(block, MPI_COMM_SELF)[0],
                          pressure,
                          1e-4);
              least   = std::min(least, pressure);
              largest = std::max(largest, pressure);
            }
        EXPECT_GT(largest, least + 1.);
      });
      const auto at_border = probes_at_end<3>(make_parameters(
        slide + Settings{{"Output/Quantities",
                          "pressure at (5 mm, 3 mm); pressure at (4.999999 mm, "
                          "3 mm); pressure at (5.000001 mm, 3 mm)"}}));
      EXPECT_NEAR(at_border[0], at_border[1], 1e-4);
      EXPECT_NEAR(at_border[0], at_border[2], 1e-4);
    }
}



// A strip pulled at one end slips from there (shear lag, nu = 0): with an
// interface of stiffness k the force is tau (l + Lambda tanh((L - l)/Lambda)),
// l being the length that slips, Lambda = sqrt(E h / k).
TEST(FaceProbes, slip_front_of_a_strip)
{
  const double L = 40., E = 206e3, h = 0.5, k = 1e4, p = 5.8, mu = 0.1;
  const double Lambda = std::sqrt(E * h / k), tau = mu * p;
  for (const std::string sense : {"", "-"})
    {
      const bool       forward    = sense.empty();
      const Parameters parameters = make_parameters(Settings{
        {"Friction/Effects", ""},
        {"Friction/Static coefficient", "0.1"},
        {"Friction/Tangential stiffness", "1e4"},
        {"Block/Dimension", "2"},
        {"Block/Size", "40 mm, 0.5 mm"},
        {"Block/Subdivisions", "160, 1"},
        {"Block/Degree", "2"},
        {"Block/Poisson ratio", "0"},
        {"Block/Faces/top", "pressure programme"},
        {forward ? "Block/Faces/right" : "Block/Faces/left", "drive"},
        {"Loading/Programme",
         "press 5.8 MPa in 1 s; slide " + sense + "1 mm/s for 0.0015 mm"},
        {"Time stepping/Tolerance", "1e-3"},
        {"Output/Quantities", "slip front at r = 0.9999"}});
      const Programme  programme  = parse_programme(parameters);
      const auto       result     = run_block_case<2>(
        parameters, MPI_COMM_SELF, [&](const Block<2> &block) {
          const BlockProbes<2> probes(BlockParameters(parameters, programme),
                                      programme,
                                      parse_quantities(parameters, programme));
          const double         front = probes.values(block, MPI_COMM_SELF)[0];
          const double         length = forward ? L - front : front;
          double               force  = 0.;
          for (const auto &face : block.state().contact_face.cell_faces())
            for (const auto &point : face.points)
              force +=
                point.JxW * std::abs(point.point.committed().traction[0]);
          EXPECT_GT(length, 2.);
          EXPECT_LT(length, L - 2.);
          EXPECT_NEAR(tau *
                        (length + Lambda * std::tanh((L - length) / Lambda)),
                      force,
                      0.02 * force);
        });
      EXPECT_EQ(result.failure, "");
    }
}



// Contact points that lie on a known curve: the place is as good as the curve,
// not as a straight line between two points.
TEST(FaceProbes, slip_front_of_a_curve)
{
  const auto error_with = [](const std::string &n_cells) {
    const Parameters parameters = make_parameters(
      plane_block + Settings{{"Block/Subdivisions", n_cells + ", 1"},
                             {"Loading/Programme",
                              "press 5.8 MPa in 1 s; slide 1 mm/s "
                              "for 0.00001 mm"},
                             {"Output/Quantities", "slip front at r = 0.7"}});
    const Programme programme = parse_programme(parameters);
    double          error     = 0.;
    run_block_case<2>(parameters, MPI_COMM_SELF, [&](const Block<2> &block) {
      ContactFace<2> contact = block.state().contact_face;
      for (unsigned int i = 0; i < contact.cell_faces().size(); ++i)
        {
          std::vector<ContactState> states;
          for (const auto &point : contact.cell_faces()[i].points)
            {
              states.push_back(point.point.committed());
              states.back().loading_ratio =
                0.5 + 0.5 * std::tanh(point.position[0] - 6.3);
            }
          contact.set_states(i, states);
        }
      const FaceProbes<2> probes(BlockParameters(parameters, programme),
                                 programme);
      const double        front =
        probes.value(parse_quantities(parameters, programme)[0],
                     contact,
                     MPI_COMM_SELF);
      error = std::abs(front - 6.3 - std::atanh(0.4));
    });
    return error;
  };
  EXPECT_LT(error_with("20"), 1e-3);
  EXPECT_LT(error_with("40"), 1e-4);
}



TEST(FaceProbes, no_slip_front_where_nothing_slips)
{
  const auto values = probes_at_end<2>(make_parameters(
    plane_block +
    Settings{{"Loading/Programme",
              "press 5.8 MPa in 1 s; slide 1 mm/s for 0.00001 mm"},
             {"Output/Quantities", "slip front; pressure at 5 mm"}}));
  EXPECT_TRUE(std::isnan(values[0]));
  EXPECT_GT(values[1], 1.);
}
