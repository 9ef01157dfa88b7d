// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/commands/commands.h>
#include <slipstep/experiment/quantities.h>
#include <slipstep/report/run_report.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/experiment/point_run.h"
#include "tests/file_text.h"
#include "tests/temporary_folder.h"

using namespace SlipStep;
using namespace SlipStep::Testing;



TEST(RunPoint, StepsTooLongForTheEnergyAreWarnedOf)
{
  Parameters parameters = point_parameters({});
  declare_report_parameters(parameters);
  declare_quantities(parameters);
  RunOptions options;
  options.quiet       = true;
  options.output      = test_folder();
  const auto warnings = [&](const std::string &key, const std::string &value) {
    parameters.set("Loading/Programme",
                   "press 5 MPa in 1 s; slide 1 mm/s for 0.0001 mm",
                   "here");
    parameters.set("Friction/Effects", "", "here");
    parameters.set(key, value, "here");
    run_point(parameters, options);
    std::string text;
    for (const std::string &warning :
         read_summary(options.output / "summary.json").warnings)
      text += warning + "\n";
    return text;
  };
  EXPECT_EQ(warnings("Time stepping/Tolerance", "1e-6"), "");
  // It begins to slide in the middle of its only step.
  parameters.set("Time stepping/Least steps per statement", "1", "here");
  parameters.set("Time stepping/First slip", "1e6", "here");
  const std::string coarse = warnings("Time stepping/Tolerance", "1");
  EXPECT_TRUE(contains(coarse, " % of the work is neither"));
  EXPECT_TRUE(contains(coarse, "smaller Time stepping/Tolerance than 1 "));
  // The table and the report say so, too.
  const std::vector<ReportedRun> runs = {{"a run", options.output}};
  EXPECT_TRUE(contains(result_table(parameters, runs), "a run: warning: "));
  write_report(options.output, parameters, runs);
  EXPECT_TRUE(contains(content(options.output / "report.html"),
                       " % of the work is neither"));

  parameters.set("Time stepping/Tolerance", "5e-5", "here");
  EXPECT_TRUE(contains(warnings("Time stepping/Equal steps per statement", "1"),
                       "more Time stepping/Equal steps per statement than 1 "));
}



// Simulated: 0 and ten times 0.2; measured 0 and ten times 0.25.
TEST(RunPoint, ATestThatIsFollowedIsDrawnBesideIt)
{
  const auto folder = test_folder();
  {
    std::ofstream file(folder / "slide.csv");
    file << "# name: a slide\ntime_s,displacement_mm,pressure_MPa,friction\n";
    for (int i = 0; i <= 10; ++i)
      file << i << ',' << i << ",5," << (i == 0 ? 0. : 0.25) << '\n';
  }
  Parameters parameters = point_parameters({});
  declare_report_parameters(parameters);
  declare_quantities(parameters);
  parameters.set("Loading/Programme",
                 "press 5 MPa in 1 s; follow " +
                   (folder / "slide.csv").string(),
                 "here");
  parameters.set("Friction/Effects", "", "here");
  parameters.set("Friction/Static coefficient", "0.2", "here");
  RunOptions options;
  options.quiet  = true;
  options.output = folder / "results";
  std::filesystem::create_directory(options.output);
  run_point(parameters, options);
  write_report(options.output, parameters, {{"", options.output}});
  const std::string page = content(options.output / "report.html");
  EXPECT_TRUE(contains(page,
                       "Root mean square of their difference: a slide: 0.048, "
                       "20 % of friction."));
  EXPECT_TRUE(contains(page, "Measured and simulated"));
  // Without its file there are the other pictures, and a word.
  std::filesystem::remove(folder / "slide.csv");
  write_report(options.output, parameters, {{"", options.output}});
  const std::string without = content(options.output / "report.html");
  EXPECT_FALSE(contains(without, "Measured and simulated"));
  EXPECT_TRUE(contains(without, "no measured tests in the pictures"));
}



// Along the line on which its friction lies: the picture of a slide along y was
// one of zeros.
TEST(RunPoint, DrawsMeasuredTestsAlongTheirOwnAxis)
{
  SlipstepProcess process;
  const auto      page_of = [&](const std::string &axis) {
    const bool  is_y = axis == "y";
    std::string rows = "time_s,displacement_mm,displacement_y_mm,"
                            "pressure_MPa,friction,friction_y\n";
    for (unsigned int i = 0; i <= 20; ++i)
      {
        const std::string place = std::to_string(0.01 * i);
        const std::string mu    = i == 0 ? "0" : "0.2";
        rows += std::to_string(0.1 * i) + ',' +
                (is_y ? "0," + place : place + ",0") + ",5," +
                (is_y ? "0," + mu : mu + ",0") + '\n';
      }
    process.write(axis + ".csv", rows);
    process.write(axis + ".prm",
                  "set Loading/Programme = press 5 MPa in 1 s; follow " + axis +
                    ".csv\nset Friction/Static coefficient = 0.1\n");
    const auto result = process.run({"point", axis + ".prm", "--output", axis});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return process.read(axis + "/report.html");
  };
  const auto difference = [](const std::string &page) {
    const std::size_t begin = page.find("of their difference: ");
    return begin == std::string::npos ?
             "" :
             page.substr(begin + 24, page.find('<', begin) - begin - 24);
  };
  const std::string along_x = page_of("x"), along_y = page_of("y");
  EXPECT_TRUE(contains(along_y, "Measured and simulated along y"));
  EXPECT_TRUE(contains(difference(along_x), " % of friction"));
  EXPECT_EQ(difference(along_y), difference(along_x));
}
