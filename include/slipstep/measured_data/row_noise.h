// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_row_noise_h
#define slipstep_measured_data_row_noise_h

#include <cstddef>
#include <vector>

namespace SlipStep
{
  /// Noise of the rows of one record: white, or in part an autoregressive
  /// process of first order, as of a filter in the instrument.
  struct RowNoise
  {
    double deviation = 0.; ///< of one row
    double share     = 0.; ///< of its variance that hangs together
    double decay     = 0.; ///< what is left of that in the next row

    /// Variance of the mean of n neighbouring rows, n >= 1.
    double variance_of_mean(const double n) const;

    /// Covariance of the means of n rows and of the n rows that follow.
    double covariance_of_means(const double n) const;
  };

  /// Which numbers of a record are far from those on either side: no flank, no
  /// step and no noise, unless it has many such.
  std::vector<bool> spikes(const std::vector<double> &values);

  /// With what lies between their neighbours in the place of these numbers.
  void bridge(const std::vector<bool> &is_spike, std::vector<double> &values);

  /// How second differences of the means of n rows scatter.
  struct ScaleScatter
  {
    double n_rows   = 1.;
    double variance = 0.; ///< of second differences, over 6
    double freedom  = 0.; ///< how well it is known, as of so many squares
    /// What a drift of variance 1 adds, for each of the times over which it
    /// forgets, see RowNoiseFit.
    std::vector<double> drift;
  };

  /// The records of a campaign, looked at on several scales.
  class RowNoiseFit
  {
  public:
    /// @param drift a standard deviation of friction that drifts are believed
    ///   to have, by a factor of two or so
    /// @param drift_time over which it forgets, a share of a test's duration
    RowNoiseFit(const double drift, const double drift_time);

    /// Add a record: what a model leaves of it, in bins of equal numbers of
    /// rows.
    /// @param time of the bins, from 0 to 1
    /// @param rows_per_bin 1 or more
    /// @param row_deviation from neighbouring rows of the record
    /// @param level of friction, of which the drift is a share
    void add(const std::vector<double> &values,
             const std::vector<double> &time,
             const double               rows_per_bin,
             const double               row_deviation,
             const double               level);

    struct Result
    {
      /// Of every record, in the order they were added.
      std::vector<RowNoise> records;
      /// Whether rows hang together beyond chance in any of them.
      bool is_correlated = false;
      /// How well the variance of means over the longest scale is known, as of
      /// so many squares.
      double freedom = 0.;
    };

    /// The noise that explains the scatter on all scales: its way of hanging
    /// together in common, but for records that clearly have their own.
    Result solve() const;

  private:
    struct Record
    {
      std::vector<ScaleScatter> scatter;
      double                    level = 1.;
    };

    struct Shape
    {
      double      share = 0., decay = 0.;
      double      drift      = 0.; ///< standard deviation, a share
      std::size_t drift_time = 0;  ///< which
    };

    double misfit(const Record &record,
                  const Shape  &shape,
                  double       *deviation = nullptr) const;

    double misfit(const Shape &shape) const;

    const double              believed_drift;
    const std::vector<double> drift_times;
    std::vector<Record>       records;
  };
} // namespace SlipStep

#endif
