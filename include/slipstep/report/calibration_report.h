// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_calibration_report_h
#define slipstep_report_calibration_report_h

#include <slipstep/calibration/calibration.h>

#include <filesystem>
#include <string>
#include <vector>

namespace SlipStep
{
  /// The table printed at the end: value, interval, start of every parameter,
  /// rms of every test, weak directions in words.
  std::string calibration_table(const Calibration &calibration);

  /// Write calibration.json.
  /// @throws RunError if the disk refuses
  void write_calibration_json(const std::filesystem::path &file,
                              const Parameters            &parameters,
                              const Calibration           &calibration);

  /// Write report.html with the pictures inside, and their data and scripts
  /// into `<folder>/report/`: measured and fitted curves, residuals, table of
  /// parameters, profiles, correlation, starts.
  /// @return warnings for the user
  std::vector<std::string>
  write_calibration_report(const std::filesystem::path &folder,
                           const Parameters            &parameters,
                           const Calibration           &calibration);
} // namespace SlipStep

#endif
