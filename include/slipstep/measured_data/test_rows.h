// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_test_rows_h
#define slipstep_measured_data_test_rows_h

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

  /// The displacement with changes of direction less than 2 @p band left out:
  /// it follows only where it would be farther off than @p band.
  std::vector<double> without_jitter(const std::vector<double> &displacement,
                                     const double               band);

  /// The rows at which the displacement turns: the farthest ones of strokes
  /// that are longer than the jitter.
  std::vector<std::size_t> turning_rows(const std::vector<double> &displacement,
                                        const double               band);

  /// Standard deviation of the noise in a series: robust, from its second
  /// differences, and not less than that of rounding to the recorded digits.
  double noise_level(const std::vector<double> &values);

  /// The step to which a series was rounded, in its unit, if it takes few
  /// values, most of them one step apart and all of them whole steps; else, and
  /// of fewer than four values, 0.
  double coarse_step(const std::vector<double> &values);

  /// The same as noise_level() of friction along an axis, and not less than
  /// that of a coarse_step(): what hardly ever goes to the next step seems to
  /// have none.
  double noise_of_friction(const std::vector<double> &friction,
                           const MeasuredTest        &test);

  /// The larger of that along x and along y.
  double noise_of_friction(const MeasuredTest &test);

  /// The channels that a test has.
  std::vector<const Channel *> filled_channels(const MeasuredTest &test);

  /// What messages call a test: its file, or its name if it has none.
  std::string name_in_messages(const MeasuredTest &test);

  /// Keep some rows of a test, in the order given.
  void keep_rows(MeasuredTest &test, const std::vector<std::size_t> &rows);

  /// In the plane, in a straight line [mm].
  double distance_between(const MeasuredTest &test,
                          const std::size_t   from,
                          const std::size_t   to);

  /// The upper one of an even number; 0 for none.
  double median(std::vector<double> values);

  /// Largest minus smallest value; 0 for none.
  double range_of(const std::vector<double> &values);
} // namespace SlipStep

#endif
