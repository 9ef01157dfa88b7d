// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_calibration_report_h
#define slipstep_report_calibration_report_h

#include <slipstep/calibration/calibration.h>
#include <slipstep/report/text_table.h>

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

  /// @name What a calibration found, in the words of screen and page.
  ///@{
  /// "95 % interval"
  std::string interval_name(const double confidence);

  /// A value with as many digits as its uncertainty leaves meaning, without
  /// unit. @p value in base units.
  std::string digits_text(const FittedParameter &fitted, const double value);

  /// "0.041 … 0.049"; "≥ 0.041", "≤ 0.049" or "open" where it reaches a bound,
  /// "–" at a constraint.
  std::string interval_text(const FittedParameter &fitted);

  /// "± 0.002", or "×/÷ 1.05" on a logarithmic scale.
  std::string deviation_text(const FittedParameter &fitted);

  ///@}
} // namespace SlipStep

#endif
