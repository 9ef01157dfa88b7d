// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_odd_rows_h
#define slipstep_measured_data_odd_rows_h

#include <slipstep/measured_data/measured_test.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace SlipStep
{
  /// What nearly all values (95 %) are below, in size.
  double usual_size(std::vector<double> values);

  /// Values with gaps (NaN) where the load is less than half of the median:
  /// there friction is noise over noise, or none.
  std::vector<double> under_load(std::vector<double> values,
                                 const MeasuredTest &test);

  /// Rows at which the solids hardly touch, before the load is on or after it
  /// is off, with friction there that is far from any under load: the noise of
  /// one sensor over that of the other.
  std::vector<std::size_t> rows_without_load(const MeasuredTest &test);

  /// What a sensor repeats as no noise would.
  struct RepeatedValue
  {
    std::string words; ///< "is exactly 5 in 80 rows ..."
    std::size_t first; ///< row
    /// Of those one after the other; 0 where a limit is met again and again.
    std::size_t n_in_a_row = 0;
  };

  /// A value at the limit of a series, again and again, or one that lasts, in a
  /// series that scatters elsewhere; nothing in most.
  std::optional<RepeatedValue>
  repeated_value(const std::vector<double> &values);

  /// Told what is odd, and the first row of it.
  using TellRow = std::function<void(const std::string &, const std::size_t)>;

  /// Tell of what no laboratory measures: scales, stray rows, jumps of position
  /// and clock, sensors at their limit or dead.
  void warn_of_odd_rows(const MeasuredTest &test, const TellRow &warn);
} // namespace SlipStep

#endif
