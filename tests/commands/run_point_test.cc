// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/commands/run_point.h>
#include <slipstep/experiment/quantities.h>
#include <slipstep/report/run_report.h>

#include <gtest/gtest.h>

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
  EXPECT_NE(coarse.find(" % of the work is neither"), std::string::npos);
  EXPECT_NE(coarse.find("smaller Time stepping/Tolerance than 1 "),
            std::string::npos)
    << coarse;
  // The table and the report say so, too.
  const std::vector<ReportedRun> runs = {{"a run", options.output}};
  EXPECT_NE(result_table(parameters, runs).find("a run: warning: "),
            std::string::npos);
  write_report(options.output, parameters, runs);
  EXPECT_TRUE(contains(content(options.output / "report.html"),
                       " % of the work is neither"));

  parameters.set("Time stepping/Tolerance", "5e-5", "here");
  EXPECT_NE(warnings("Time stepping/Equal steps per statement", "1")
              .find("more Time stepping/Equal steps per statement than 1 "),
            std::string::npos);
}
