// SPDX-License-Identifier: LGPL-2.1-or-later

// What the contact face remembers can be seen in all files.

#include <slipstep/solid/block_output.h>
#include <slipstep/solid/stress.h>
#include <slipstep/utilities/csv.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "block_test_tools.h"
#include "tests/temporary_folder.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  Settings settings(const std::string &effects)
  {
    return {{"Friction/Effects", effects},
            {"Block/Subdivisions", "2, 2, 2"},
            {"Time stepping/Tolerance", "1e-3"},
            {"Output/Fields", "end"},
            {"Loading/Programme",
             "press 5.8 MPa in 1 s; slide 1 mm/s for 0.05 mm"}};
  }

  /// The header of contact_face.csv, and what of it is in the VTU.
  template <int dim = 3>
  std::string run(const Parameters &parameters, HistoryRow &last)
  {
    const auto            folder = test_folder();
    const FrictionLaw     law(parameters);
    const Programme       programme = parse_programme(parameters);
    const BlockParameters block_parameters(parameters, programme);
    BlockOutput<dim>      output(block_parameters, folder, MPI_COMM_SELF);
    Block<dim>            block(block_parameters,
                     law,
                     programme,
                     StepControl(parameters, programme, law),
                     MPI_COMM_SELF);
    block.run(&output, [&](const HistoryRow &row) { last = row; });
    output.write_end(block.state().unknowns,
                     block.state().displacements,
                     block.state().contact_face);

    std::string   header;
    std::ifstream in(folder / "contact_face.csv");
    std::getline(in, header);
    std::ostringstream vtu;
    for (const auto &file : std::filesystem::directory_iterator(folder))
      if (file.path().extension() == ".vtu" &&
          file.path().filename().string().compare(0, 8, "contact_") == 0)
        vtu << std::ifstream(file.path()).rdbuf();
    std::istringstream names(header);
    for (std::string name; std::getline(names, name, ',');)
      if (name.find("_mm") == std::string::npos || name == "slip_mm")
        {
          EXPECT_NE(vtu.str().find('"' + name + '"'), std::string::npos)
            << name;
        }
    return header;
  }

  const std::string always =
    "x_mm,y_mm,cell_size_x_mm,cell_size_y_mm,area_mm2,pressure_MPa,"
    "traction_x_MPa,traction_y_MPa,slip_mm,r,r_s,mu,"
    "dissipated_energy_Nmm_per_mm2";
} // namespace



TEST(BlockOutput, shows_what_effects_remember)
{
  HistoryRow last;
  const auto parameters =
    make_parameters(settings("subloading, heating, ageing"));
  EXPECT_EQ(run(parameters, last),
            always + ",contact_age_s,temperature_rise_degC");

  // Files agree with each other and with the history, which weights by load.
  const CsvTable face(test_folder() / "contact_face.csv",
                      {"area_mm2",
                       "pressure_MPa",
                       "slip_mm",
                       "dissipated_energy_Nmm_per_mm2",
                       "temperature_rise_degC",
                       "contact_age_s"});
  double         load = 0., slip = 0., energy = 0., heat = 0., age = 0.;
  for (std::size_t i = 0; i < face.size(); ++i)
    {
      const double area   = face["area_mm2"][i];
      const double weight = area * face["pressure_MPa"][i];
      load += weight;
      slip += weight * face["slip_mm"][i];
      heat += weight * face["temperature_rise_degC"][i];
      age += weight * face["contact_age_s"][i];
      energy += area * face["dissipated_energy_Nmm_per_mm2"][i];
    }
  EXPECT_NEAR(last.slip, slip / load, 0.02 * last.slip);
  const auto memory = [&last](const std::string &name) {
    return last.memories[contact_memory(name).slot];
  };
  EXPECT_NEAR(memory("temperature_rise_degC"),
              heat / load,
              0.1 * memory("temperature_rise_degC"));
  EXPECT_NEAR(memory("contact_age_s"),
              age / load,
              0.02 * memory("contact_age_s"));
  EXPECT_EQ(memory("hold_time_s"), 0.);
  EXPECT_NEAR(last.dissipated_energy, energy, 1e-9 * energy);
  EXPECT_GT(last.slip, 0.03);
  EXPECT_GT(memory("temperature_rise_degC"), 0.);
  EXPECT_GT(memory("contact_age_s"), 0.);
}



// What presses on the back of a block slides over it along z at 90 deg: that
// is where it is held, by the coefficient times the pressure.
TEST(BlockOutput, columns_bear_the_axes_of_the_block)
{
  const auto on_side = [](const std::string &contact,
                          const std::string &opposite) {
    return settings("subloading") +
           Settings{{"Block/Faces/bottom", "free"},
                    {"Block/Faces/top", "free"},
                    {"Block/Faces/" + contact, "contact"},
                    {"Block/Faces/" + opposite, "pressure programme; drive"}};
  };
  HistoryRow last;
  EXPECT_EQ(run(make_parameters(on_side("back", "front") +
                                Settings{{"Block/Size", "8 mm, 4 mm, 6 mm"},
                                         {"Loading/Programme",
                                          "press 5.8 MPa in 1 s; slide 1 mm/s "
                                          "for 0.05 mm at 90 deg"}}),
                last)
              .substr(0, 100),
            "x_mm,z_mm,cell_size_x_mm,cell_size_z_mm,area_mm2,pressure_MPa,"
            "traction_x_MPa,traction_z_MPa,slip_mm,");
  const CsvTable face(test_folder() / "contact_face.csv",
                      {"x_mm", "z_mm", "cell_size_z_mm", "traction_z_MPa"});
  EXPECT_EQ(face["x_mm"], (std::vector<double>{2., 6., 2., 6.}));
  EXPECT_EQ(face["z_mm"], (std::vector<double>{1.5, 1.5, 4.5, 4.5}));
  EXPECT_EQ(face["cell_size_z_mm"], std::vector<double>(4, 3.));
  double mean = 0.;
  for (const double traction : face["traction_z_MPa"])
    mean += 0.25 * traction;
  EXPECT_NEAR(mean, 5.8 * last.friction_y, 1e-3);
  EXPECT_GT(mean, 0.5);

  const Settings flat = {{"Block/Dimension", "2"},
                         {"Block/Size", "4 mm, 6 mm"},
                         {"Block/Subdivisions", "2, 2"}};
  EXPECT_EQ(run<2>(make_parameters(on_side("left", "right") + flat), last)
              .substr(0, 40),
            "y_mm,z_mm,cell_size_y_mm,cell_size_z_mm,");
  EXPECT_EQ(run<2>(make_parameters(settings("subloading") + flat), last),
            always);
}



// A round face that slides: where it touches, r is 1 without effects, and in a
// cell at its edge, part of which is open, as well.
TEST(BlockOutput, ratios_are_those_of_closed_points)
{
  HistoryRow last;
  run<2>(make_parameters(settings("") +
                         Settings{{"Block/Dimension", "2"},
                                  {"Block/Size", "8 mm, 4 mm"},
                                  {"Block/Subdivisions", "16, 8"},
                                  {"Contact/Gap", "(x - 4.2)^2 / (2 * 500)"},
                                  {"Loading/Programme",
                                   "press 20 MPa in 1 s; slide 1 mm/s for 0.05 "
                                   "mm"}}),
         last);
  const CsvTable face(test_folder() / "contact_face.csv",
                      {"pressure_MPa", "traction_x_MPa", "r", "mu"});
  unsigned int   n_open = 0;
  for (std::size_t i = 0; i < face["r"].size(); ++i)
    {
      const double pressure = face["pressure_MPa"][i];
      n_open += pressure == 0.;
      if (pressure > 0.)
        {
          EXPECT_NEAR(face["r"][i],
                      std::abs(face["traction_x_MPa"][i]) /
                        (face["mu"][i] * pressure),
                      1e-6)
            << i;
        }
    }
  EXPECT_GT(n_open, 0u);
}



TEST(BlockOutput, leaves_out_what_no_effect_remembers)
{
  HistoryRow last;
  EXPECT_EQ(run(make_parameters(settings("subloading")), last), always);
}



// Between smooth faces a block that is pressed shrinks evenly: sigma_z = -p.
TEST(BlockOutput, draws_the_surface)
{
  HistoryRow     last;
  const Settings pressed = {{"Block/Subdivisions", "2, 3, 4"},
                            {"Block/Poisson ratio", "0"},
                            {"Block/Faces/top", "pressure programme"},
                            {"Output/Fields", "end"},
                            {"Loading/Programme", "press 5.8 MPa in 1 s"}};
  run(make_parameters(pressed), last);

  std::vector<std::string> names = {
    "von_mises_MPa", "contact", "pressure_MPa", "slip_mm", "r"};
  for (const std::string axis : {"x", "y", "z", "ux", "uy", "uz"})
    for (const std::string corner : {"0", "1", "2", "3"})
      names.push_back(axis + corner + "_mm");
  const CsvTable surface(test_folder() / "surface_0000.csv", names);
  ASSERT_EQ(surface.size(), 2u * (2 * 3 + 3 * 4 + 2 * 4));
  const BlockParameters block(make_parameters(pressed),
                              parse_programme(make_parameters(pressed)));
  double                area = 0., contact_area = 0.;
  for (std::size_t i = 0; i < surface.size(); ++i)
    {
      EXPECT_NEAR(surface["von_mises_MPa"][i], 5.8, 0.02);
      // Of the quadrilateral, if its corners go round it.
      dealii::Tensor<1, 3> corners[4], u[4];
      for (unsigned int k = 0; k < 4; ++k)
        for (unsigned int d = 0; d < 3; ++d)
          {
            const std::string name =
              std::string(1, "xyz"[d]) + std::to_string(k) + "_mm";
            corners[k][d] = surface[name][i];
            u[k][d]       = surface["u" + name][i];
          }
      const double size =
        0.5 * dealii::cross_product_3d(corners[2] - corners[0],
                                       corners[3] - corners[1])
                .norm();
      area += size;
      for (unsigned int k = 0; k < 4; ++k)
        for (unsigned int l = 0; l < k; ++l)
          EXPECT_NEAR((u[k] - u[l])[2],
                      -5.8 / block.young_modulus * (corners[k] - corners[l])[2],
                      2e-6);
      if (surface["contact"][i] == 0.)
        continue;
      contact_area += size;
      EXPECT_NEAR(surface["pressure_MPa"][i], 5.8, 0.02);
      for (unsigned int k = 0; k < 4; ++k)
        EXPECT_EQ(corners[k][2], 0.);
    }
  const auto &size = block.size;
  EXPECT_NEAR(area,
              2. * (size[0] * size[1] + size[1] * size[2] + size[2] * size[0]),
              1e-6 * area);
  EXPECT_NEAR(contact_area, size[0] * size[1], 1e-6 * area);
}



TEST(BlockOutput, von_mises_of_plane_strain)
{
  const Settings        flat       = {{"Block/Dimension", "2"},
                                      {"Block/Size", "10 mm, 10 mm"},
                                      {"Block/Subdivisions", "2, 2"}};
  const Parameters      parameters = make_parameters(flat);
  const BlockParameters block(parameters, parse_programme(parameters));
  dealii::Tensor<2, 2>  gradient;
  gradient[1][1]      = 1e-3;
  const auto   stress = stress_of(gradient, block);
  const double shear  = block.shear_modulus();
  // Strains 0, e, 0: two normal stresses are equal, the third differs by 2 mu
  // e.
  EXPECT_NEAR(stress[1][1] - stress[2][2], 2. * shear * 1e-3, 1e-9);
  EXPECT_NEAR(stress[0][0], stress[2][2], 1e-9);
  gradient       = 0.;
  gradient[0][1] = 1e-3;
  EXPECT_NEAR(stress_of(gradient, block)[0][1], shear * 1e-3, 1e-12);
}
