// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_run_report_h
#define slipstep_report_run_report_h

#include <slipstep/utilities/parameters.h>

#include <filesystem>
#include <string>
#include <vector>

namespace SlipStep
{
  /// A finished run to be shown: its legend and its output folder, which holds
  /// history.csv, summary.json and, for a block, contact_face.csv.
  struct ReportedRun
  {
    std::string           label;
    std::filesystem::path folder;
  };

  /// Declares section "Report": what the results are compared with.
  void declare_report_parameters(Parameters &parameters);

  /// Check what section "Report" says, before a run is started.
  /// @throws InputError for a formula or a speed that cannot be read
  void check_report_parameters(const Parameters &parameters);

  /// Whether all variants slide under the same law.
  bool has_one_law(const Parameters &parameters);

  /// Write report.html (self-contained, pictures inside as SVG made by gnuplot)
  /// and the data and gnuplot scripts behind each picture into
  /// `<folder>/report/`. Without gnuplot the data and scripts are still written
  /// and a warning is returned.
  /// @param study HTML about all runs together, shown first
  /// @param is_one_case whether the runs are of the case of these parameters,
  ///   so that its values are theirs
  /// @return warnings for the user
  std::vector<std::string> write_report(const std::filesystem::path &folder,
                                        const Parameters            &parameters,
                                        const std::vector<ReportedRun> &runs,
                                        const std::string &study       = "",
                                        const bool         is_one_case = true);

  /// The table printed at the end: one row per slide and run: speed, peak,
  /// kinetic coefficient, reference, difference in %.
  std::string result_table(const Parameters               &parameters,
                           const std::vector<ReportedRun> &runs);
} // namespace SlipStep

#endif
