// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_tidy_rows_h
#define slipstep_measured_data_tidy_rows_h

#include <slipstep/measured_data/measured_test.h>

#include <functional>
#include <string>
#include <vector>

namespace SlipStep
{
  /// Where the rows of a test come from, for messages.
  struct RowOrigin
  {
    /// Throws InputError "file:line:column: why"; rows counted from 0, channels
    /// named as in channels().
    std::function<void(const std::size_t  row,
                       const std::string &channel,
                       const std::string &why)>
      reject;

    /// The line in which a row stands.
    std::function<std::size_t(const std::size_t row)> line;
  };

  /// Put the rows of a test as recorded in order and check them. What is done
  /// is told in the test's warnings:
  ///
  /// - A row with a gap (NaN) in any column is left out.
  /// - Rows that stand newest first are turned round.
  /// - Rows out of order by at most 1 % of the duration are sorted. Time that
  ///   goes back further is an error: a clock set back, or two tests in a file.
  /// - Rows of the same time are averaged.
  ///
  /// Pressure must be positive; it may be zero where friction is, too, as
  /// before the first touch. Friction that drives the motion instead of
  /// resisting it is an error, since only the user knows what the sign of the
  /// record means; so is friction of one sign in strokes forth and back.
  ///
  /// @throws InputError through @p origin, or if fewer than two rows are left
  void tidy_rows(MeasuredTest &test, const RowOrigin &origin);

  /// Share of the work of friction that is done against the motion, less the
  /// share that drives it: 1 where it resists throughout, -1 where it drives; 0
  /// without any. Rows with gaps (NaN) do not count.
  double share_of_resistance(const std::vector<double> &displacement,
                             const std::vector<double> &friction);
} // namespace SlipStep

#endif
