// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_test_rows_h
#define slipstep_measured_data_test_rows_h

#include <deal.II/base/tensor.h>

#include <slipstep/measured_data/measured_test.h>

#include <string>
#include <vector>

namespace SlipStep
{
  /// The displacement with changes of direction less than 2 @p band left out:
  /// it follows only where it would be farther off than @p band.
  std::vector<double> without_jitter(const std::vector<double> &displacement,
                                     const double               band);

  /// The rows at which the displacement turns: the farthest ones of strokes
  /// that are longer than the jitter.
  std::vector<std::size_t> turning_rows(const std::vector<double> &displacement,
                                        const double               band);

  /// Below which displacements do not tell motion from jitter [mm].
  double jitter_of(const MeasuredTest &test);

  /// The path of a test [mm], along rows that are farther apart than jitter;
  /// turns and ends count in full.
  double path_of(const MeasuredTest &test);

  /// Second differences of a series.
  std::vector<double> bends_of(const std::vector<double> &values);

  /// Standard deviation of the noise in a series: robust, from its second
  /// differences, and not less than that of rounding to the recorded digits.
  double noise_level(const std::vector<double> &values);

  /// The step to which a series was rounded, in its unit, if it takes few
  /// values, most of them one step apart and all of them whole steps, and stays
  /// at neighbouring ones, as a ramp does not that is passed once; else, and
  /// of fewer than four values, 0.
  double coarse_step(const std::vector<double> &values);

  /// Of every row, of both axes.
  std::vector<double> sizes_of_friction(const MeasuredTest &test);

  /// To what a series was rounded.
  struct Rounding
  {
    double step = 0.; ///< 0 if it scatters enough for means to be right
    /// Of the error of rounding the share that means of many rows keep:
    /// exp(-2 pi^2 s^2 / step^2) where they scatter by s within the steps, as
    /// in the first term of its Fourier series over the value.
    double kept = 0.;

    /// Standard deviation of what means are off by.
    double deviation() const;
  };

  /// @param step to which the series was rounded, as of coarse_step()
  Rounding rounding_to(const double step, const std::vector<double> &values);

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

  /// Where a test was at a row, along both axes [mm].
  dealii::Tensor<1, 2> position(const MeasuredTest &test,
                                const std::size_t   row);

  /// In the plane, in a straight line [mm].
  double distance_between(const MeasuredTest &test,
                          const std::size_t   from,
                          const std::size_t   to);

  /// Some of the values, in the order of @p rows.
  template <typename T>
  std::vector<T> chosen(const std::vector<T>           &values,
                        const std::vector<std::size_t> &rows)
  {
    std::vector<T> result;
    result.reserve(rows.size());
    for (const std::size_t row : rows)
      result.push_back(values[row]);
    return result;
  }

  /// A curve of straight lines through values at increasing times (one at
  /// least), at other times [s], which increase, too; outside, its first and
  /// last value.
  std::vector<double> at_times(const std::vector<double> &times,
                               const std::vector<double> &values,
                               const std::vector<double> &wanted_times);

  /// The upper one of an even number; 0 for none.
  double median(std::vector<double> values);

  /// Largest minus smallest value; 0 for none.
  double range_of(const std::vector<double> &values);
} // namespace SlipStep

#endif
