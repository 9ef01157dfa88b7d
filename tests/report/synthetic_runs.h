// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_tests_report_synthetic_runs_h
#define slipstep_tests_report_synthetic_runs_h

// Folders of runs that nobody made, to be reported.

#include <slipstep/experiment/history.h>
#include <slipstep/experiment/point_driver.h>
#include <slipstep/experiment/summary.h>
#include <slipstep/report/run_report.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/report/page_text.h"

namespace SyntheticRuns
{
  using namespace SlipStep;

  inline Parameters parameters_with(
    const std::vector<std::pair<std::string, std::string>> &values)
  {
    Parameters parameters;
    declare_loading_parameters(parameters);
    declare_report_parameters(parameters);
    for (const auto &[key, value] : values)
      parameters.set("Report/" + key, value, "test");
    return parameters;
  }

  inline Parameters parameters_of_the_paper()
  {
    return parameters_with(
      {{"Title", "Flat <surface> test"},
       {"Reference kinetic coefficient", "0.00420*log(V) + 0.100"},
       {"Reference name", "eq. 4"},
       {"Reference quasi-static coefficient", "0.078"},
       {"Reference speeds", "1, 10, 50, 200"}});
  }

  /// A run whose friction peaks at 0.5 mm and ends 1 % above eq. 4.
  inline ReportedRun make_run(const double speed, const std::string &label)
  {
    const auto folder = test_folder() / label;
    std::filesystem::create_directories(folder);

    SlideSummary slide;
    slide.speed             = speed / 60.;
    slide.length            = 20.;
    slide.kinetic           = 1.01 * (0.0042 * std::log(speed) + 0.1);
    slide.peak              = slide.kinetic / 0.9;
    slide.peak_displacement = 0.5;
    slide.dynamic_ratio     = slide.kinetic / 0.078;
    slide.coefficient       = 0.078;

    HistoryWriter writer(folder / "history.csv");
    for (int i = 0; i <= 200; ++i)
      {
        HistoryRow row;
        row.time         = i;
        row.displacement = 0.1 * i;
        row.friction =
          i < 5 ? slide.peak * i / 5. :
                  slide.peak + (slide.kinetic - slide.peak) * (i - 5) / 195.;
        writer.write(row);
      }

    Summary summary;
    summary.case_name      = "flat";
    summary.label          = label;
    summary.command        = "run";
    summary.slides         = {slide};
    summary.status         = "finished";
    summary.final_friction = slide.kinetic;
    write_summary(folder / "summary.json", summary);
    return {label, folder};
  }

  /// Of cells as wide as that [mm] along the axes of the face.
  inline void write_face(const ReportedRun &run,
                         const std::string &x     = "x",
                         const std::string &y     = "y",
                         const double       width = 1.)
  {
    std::ofstream out(run.folder / "contact_face.csv");
    out << x << "_mm," << y << "_mm,cell_size_" << x << "_mm,cell_size_" << y
        << "_mm,area_mm2,pressure_MPa,traction_" << x << "_MPa,traction_" << y
        << "_MPa,slip_mm,r,r_s,mu\n";
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 3; ++j)
        out << width * (i + 0.5) << "," << width * (j + 0.5) << "," << width
            << "," << width << ",1," << 5.8 + 0.1 * i << ",0,0,"
            << 20 - 0.001 * j << ",1,1,0.078\n";
  }

  /// A run that has slid so.
  inline ReportedRun make_slides(const std::string               &label,
                                 const std::vector<SlideSummary> &slides)
  {
    const ReportedRun run     = make_run(1., label);
    Summary           summary = read_summary(run.folder / "summary.json");
    summary.slides            = slides;
    summary.dimension         = 3;
    write_summary(run.folder / "summary.json", summary);
    return run;
  }

  inline SlideSummary make_slide(const unsigned int statement,
                                 const double       speed,
                                 const double       before,
                                 const double       peak,
                                 const double       kinetic)
  {
    SlideSummary slide;
    slide.statement         = statement;
    slide.speed             = speed / 60.;
    slide.pressure          = 5.;
    slide.length            = 10.;
    slide.before            = before;
    slide.peak              = peak;
    slide.dip               = std::min(before, kinetic);
    slide.kinetic           = kinetic;
    slide.peak_displacement = 0.1;
    return slide;
  }

  /// Headline and table of the page.
  inline std::string told_of(const std::vector<ReportedRun> &runs,
                             const Parameters &parameters = parameters_with({}))
  {
    write_report(test_folder(), parameters, runs);
    const std::string page  = content(test_folder() / "report.html");
    const auto        begin = page.find("<p class='headline'>");
    return page.substr(begin, page.find("<h2>", begin) - begin);
  }
} // namespace SyntheticRuns

#endif
