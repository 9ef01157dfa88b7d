// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_run_measured_h
#define slipstep_report_run_measured_h

#include <slipstep/report/run_figures.h>

namespace SlipStep
{
  /// Draw measured friction beside the runs: tests that their programmes follow
  /// and those that "Report/Measured" names.
  /// What they differ by is told where a programme follows a test.
  void add_measured_pictures(const std::filesystem::path   &folder,
                             const Parameters              &parameters,
                             const std::vector<RunResults> &runs,
                             std::vector<Picture>          &pictures,
                             std::vector<std::string>      &warnings);
} // namespace SlipStep

#endif
