// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_calibration_text_h
#define slipstep_report_calibration_text_h

#include <slipstep/calibration/calibration.h>
#include <slipstep/report/text_table.h>

#include <string>
#include <vector>

namespace SlipStep
{
  /// @name What a calibration found, in the words of screen and page.
  ///@{
  /// "6 parameters from 4 tests: rms difference of friction 0.0021 ..."
  std::string calibration_headline(const Calibration &calibration);

  /// Those parameters whose interval is open, "" if there are none.
  std::string open_intervals(const Calibration &calibration);

  /// Pairs that the tests determine only together, apart from those that a weak
  /// direction names; "" if there are none.
  std::string close_pairs(const Calibration &calibration);

  std::string correlation_text(const double correlation);

  /// What one standard deviation along a weak direction changes:
  /// "Rate × 1.5, Amount -0.03".
  std::string change_text(const Calibration   &calibration,
                          const WeakDirection &direction);

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

  /// @param in_full with what the terminal has no room for
  std::vector<TableLine> derived_lines(const Calibration &calibration,
                                       const bool         in_full);
  std::vector<TableLine> test_lines(const Calibration &calibration,
                                    const bool         in_full);
  ///@}
} // namespace SlipStep

#endif
