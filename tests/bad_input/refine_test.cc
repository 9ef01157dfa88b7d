// SPDX-License-Identifier: LGPL-2.1-or-later

// slipstep refine, from the command line to its files.

#include <slipstep/experiment/summary.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <regex>
#include <sstream>

#include "slipstep_process.h"

using namespace SlipStep;

namespace
{
  // The strip of tests/solid/refinement_test.cc.
  const double exact_force = 206e3 * 1e-3 * 0.00002 * std::tanh(3.);

  const std::string strip =
    "set Loading/Programme = press 1 MPa in 1 s; slide 1 mm/s for 0.00002 mm\n"
    "set Output/Quantities = friction force at 0.00002 mm; pressure at 1.5 mm\n"
    "set Output/Fields = none\n"
    "set Time stepping/Equal steps per statement = 1\n"
    "subsection Friction\n"
    "  set Effects =\n"
    "  set Static coefficient = 0.9\n"
    "  set Tangential stiffness = 206\n"
    "  set Normal stiffness = 1e6\n"
    "end\n"
    "subsection Block\n"
    "  set Dimension = 2\n"
    "  set Size = 3 mm, 0.001 mm\n"
    "  set Subdivisions = 4, 1\n"
    "  set Degree = 1\n"
    "  set Poisson ratio = 0\n"
    "  set Faces/top = pressure programme; flat\n"
    "  set Faces/right = drive\n"
    "end\n"
    "set Refinement study/Uniform meshes = 4\n";

  std::string cell(const std::string &line, const unsigned int n)
  {
    std::istringstream in(line);
    std::string        text;
    for (unsigned int i = 0; i <= n; ++i)
      std::getline(in, text, ',');
    return text;
  }

  // A row of refinement.csv.
  std::string row(const std::string &csv,
                  const std::string &run,
                  const std::string &quantity)
  {
    std::istringstream in(csv);
    for (std::string line; std::getline(in, line);)
      if (line.find("\"" + run + "\"") != std::string::npos &&
          line.find("\"" + quantity + "\"") != std::string::npos)
        return line;
    return "";
  }
} // namespace



TEST(Refine, finds_order_and_limit)
{
  const SlipstepProcess process;
  process.write("strip.prm", strip);
  const auto result = process.run({"refine", "strip.prm"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_TRUE(std::regex_search(
    result.out,
    std::regex("friction force at 0.00002 mm \\[N/mm\\], uniform: "
               "reference .* \\(Richardson, order (1.9|2)")))
    << result.out;
  EXPECT_TRUE(contains(result.out, "report.html"));

  const std::string csv    = process.read("output/strip/refine/refinement.csv");
  const std::string force  = "friction force at 0.00002 mm";
  const std::string finest = row(csv, "uniform 3", force);
  EXPECT_EQ(cell(finest, 2), "finished") << csv;
  EXPECT_EQ(cell(finest, 4), std::to_string(2 * 33 * 9));
  EXPECT_NEAR(std::stod(cell(finest, 10)), exact_force, 1e-2 * exact_force);
  EXPECT_NEAR(std::stod(cell(finest, 11)), exact_force, 1e-3 * exact_force);
  EXPECT_NEAR(std::stod(cell(finest, 13)), 2., 0.2);
  EXPECT_GT(std::stod(cell(row(csv, "uniform 0", force), 12)),
            10. * std::stod(cell(finest, 12)));
  // First of all a summary: quantity, runs, reference, error, order, cheapest.
  EXPECT_TRUE(std::regex_search(
    result.out,
    std::regex("quantity +runs +reference +error of the finest +order +"
               "cheapest for 1 %\n[ -]+\n +friction force at 0.00002 mm "
               "\\[N/mm\\] +uniform +0.00[0-9]+ +0.00[0-9]+ +(1.9|2.0)[0-9] "
               "+uniform 1 \\(")))
    << result.out;
  // It is the same on all meshes: no order, and that is said.
  EXPECT_TRUE(contains(result.out, "because the last two values agree"));

  const Summary summary = read_summary(
    process.folder() / "output/strip/refine/uniform_1/summary.json");
  ASSERT_EQ(summary.quantities.size(), 2u);
  EXPECT_EQ(summary.quantities[0].name, force);
  EXPECT_EQ(summary.quantities[0].unit, "N/mm");
  EXPECT_GT(summary.cpu_time, 0.);
  EXPECT_TRUE(contains(process.read("output/strip/refine/report.html"),
                       "Convergence of the"));
}



// What three runs cannot tell is not shown: no order, and no error of the run
// that the reference was extrapolated from.
TEST(Refine, shows_nothing_below_the_uncertainty_of_the_reference)
{
  const SlipstepProcess process;
  process.write("strip.prm", strip);
  const auto result = process.run(
    {"refine", "strip.prm", "--set=Refinement study/Uniform meshes=3"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string force = "friction force at 0.00002 mm";
  const std::string csv   = process.read("output/strip/refine/refinement.csv");
  const std::string fine  = row(csv, "uniform 2", force);
  EXPECT_EQ(cell(fine, 12), "nan") << csv;
  EXPECT_EQ(cell(fine, 13), "nan") << csv;
  // The truth is within the uncertainty, and the bound is one.
  const double uncertainty = std::stod(cell(fine, 14));
  EXPECT_LT(std::abs(std::stod(cell(fine, 11)) - exact_force), uncertainty);
  EXPECT_LT(std::abs(std::stod(cell(fine, 10)) - exact_force),
            std::stod(cell(fine, 15)) * exact_force);
  EXPECT_TRUE(
    std::regex_search(result.out, std::regex("uniform 2 .* < 0.0[0-9]+ +–\n")))
    << result.out;

  // Every error that is shown is above it, here and for programs.
  const auto object =
    nlohmann::json::parse(process.read("output/strip/refine/refinement.json"));
  unsigned int n_shown = 0;
  for (const auto &curve : object.at("curves"))
    for (const auto &run : curve.at("runs"))
      {
        EXPECT_TRUE(run.at("order").is_null());
        if (run.at("relative_error").is_null())
          continue;
        ++n_shown;
        EXPECT_GT(run.at("relative_error").get<double>(),
                  curve.at("reference_uncertainty").get<double>() /
                    curve.at("reference").get<double>());
      }
  EXPECT_GT(n_shown, 0u);
}



TEST(Refine, time_steps_against_a_finer_run)
{
  const SlipstepProcess process;
  process.write("strip.prm", strip);
  const auto result =
    process.run({"refine",
                 "strip.prm",
                 "--quiet",
                 "--output=here",
                 "--set=Friction/Effects=overstress",
                 "--set=Friction/overstress/Viscosity=1e3",
                 "--set=Friction/Static coefficient=0.002",
                 "--set=Refinement study/Uniform meshes=0",
                 "--set=Refinement study/Time steps=equal steps 10, 20, 40, 80",
                 "--set=Refinement study/Time reference=equal steps 640"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "");
  const std::string csv   = process.read("here/refinement.csv");
  const std::string force = "friction force at 0.00002 mm";
  const std::string fine  = row(csv, "equal steps 80", force);
  EXPECT_EQ(cell(fine, 5), "160") << csv;
  EXPECT_GT(std::stod(cell(fine, 13)), 1.5) << csv;
}



// One mesh cannot write its files; the others go on.
TEST(Refine, reports_a_run_that_fails)
{
  const SlipstepProcess process;
  process.write("strip.prm", strip);
  std::filesystem::create_directories(process.folder() / "output/strip/refine");
  process.write("output/strip/refine/.slipstep", "refine 1\n");
  process.write("output/strip/refine/uniform_1", "in the way");
  const auto result = process.run({"refine", "strip.prm"});
  EXPECT_NE(result.exit_code, 0);
  EXPECT_TRUE(std::regex_search(result.out,
                                std::regex("uniform 1 failed: .*summary.json")))
    << result.out;
  const std::string csv   = process.read("output/strip/refine/refinement.csv");
  const std::string force = "friction force at 0.00002 mm";
  EXPECT_EQ(cell(row(csv, "uniform 1", force), 2), "failed");
  EXPECT_EQ(cell(row(csv, "uniform 2", force), 2), "finished");
}



TEST(Refine, refuses_a_sweep_but_takes_a_member)
{
  const SlipstepProcess process;
  process.write("strip.prm",
                strip + "subsection Sweep\n  set Key = Block/Degree\n"
                        "  set Values = 1, 2\nend\n");
  const auto refused = process.run({"refine", "strip.prm"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(contains(refused.err, "choose a member with --variant"));
  EXPECT_FALSE(std::filesystem::exists(process.folder() / "output"));

  const auto taken =
    process.run({"refine", "strip.prm", "--variant=Degree 2", "--quiet"});
  ASSERT_EQ(taken.exit_code, 0) << taken.err;
  const std::string csv =
    process.read("output/strip/refine/Degree_2/refinement.csv");
  EXPECT_NEAR(
    std::stod(cell(row(csv, "uniform 3", "friction force at 0.00002 mm"), 13)),
    4.,
    0.3)
    << csv;
}



// Both sequences against a finer adaptive run.
TEST(Refine, adaptive_meshes)
{
  const SlipstepProcess process;
  process.write("block.prm",
                "set Loading/Programme = press 5.8 MPa in 1 s; slide 1 mm/min "
                "for 0.1 um\n"
                "set Output/Quantities = pressure at 10 mm\n"
                "set Output/Fields = none\n"
                "set Time stepping/Equal steps per statement = 3\n"
                "set Friction/Effects =\n"
                "set Block/Dimension = 2\n"
                "set Block/Size = 10 mm, 10 mm\n"
                "set Block/Subdivisions = 2, 2\n"
                "subsection Refinement study\n"
                "  set Uniform meshes      = 3\n"
                "  set Adaptive tolerances = 0.2, 0.05\n"
                "  set Adaptive levels     = 4\n"
                "  set Mesh reference      = adaptive 0.02\n"
                "end\n");
  const auto result = process.run({"refine", "block.prm"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "(adaptive 0.02)"));
  const std::string csv = process.read("output/block/refine/refinement.csv");
  const std::string quantity = "pressure at 10 mm";
  const std::string coarse   = row(csv, "adaptive 0.2", quantity);
  const std::string fine     = row(csv, "adaptive 0.05", quantity);
  EXPECT_EQ(cell(fine, 0), "adaptive");
  EXPECT_GT(std::stod(cell(fine, 4)), std::stod(cell(coarse, 4))) << csv;
  const auto difference = [](const std::string &line) {
    return std::abs(std::stod(cell(line, 10)) - std::stod(cell(line, 11)));
  };
  EXPECT_LT(difference(fine), difference(coarse)) << csv;
  // Adaptive values still run away from each other by as much (0.110 and
  // 0.119 MPa): no limit is in sight, and the reference tells no errors.
  EXPECT_EQ(cell(fine, 12), "nan");
  EXPECT_TRUE(contains(result.out, "not seen to approach a limit"));
}
