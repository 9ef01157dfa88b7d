// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_noise_h
#define slipstep_diagnosis_noise_h

#include <slipstep/calibration/row_matrix.h>

#include <Eigen/Core>

#include <cstddef>
#include <random>
#include <vector>

namespace SlipStep
{
  /// What makes measured friction differ from the friction of the contact:
  /// noise of every row, a drift within a test (a process of Ornstein and
  /// Uhlenbeck), and what is the same throughout a test but not in the next
  /// one: gain, offset and slope.
  ///
  /// Standard deviations; all but the first as shares of the test's friction.
  struct Noise
  {
    double white = 1.; ///< in units of the rows' own noise
    double drift = 0.;
    /// Over which the drift forgets, as a share of the duration of a test of
    /// usual length.
    double drift_time = 0.1;
    double gain       = 0.;
    double offset     = 0.;
    double slope      = 0.; ///< of a straight line, from first to last row
    /// Over so many times the rows that the series say, rows that hang together
    /// forget each other.
    double row_memory = 1.;
    /// Of a longer test the share is less by this power of its duration: 0 if
    /// the drift goes with the test, 1 if it forgets within the same seconds.
    double by_seconds = 0.;
    /// Of a sensor whose rows scatter less than those of the other axis the
    /// drift, the offset and the slope are less by this power of that: 0 if
    /// they are the same, 1 if all of its noise is less.
    double by_sensor = 0.;

    static constexpr std::size_t n_components = 9;

    /// The last two of them are no logarithms, but the powers themselves.
    using Logarithms = Eigen::Matrix<double, n_components, 1>;

    Logarithms logarithms() const;

    static Noise from_logarithms(const Logarithms &logarithms);
  };

  /// One time series of friction, on which noise acts.
  struct Series
  {
    std::vector<double> time; ///< from 0 to 1
    /// Standard deviation of the rows by themselves.
    std::vector<double> row_noise;
    /// Friction without noise: what a gain multiplies.
    std::vector<double> friction;
    /// @name How rows hang together, see RowNoise: of their variance the share
    ///   of an autoregressive process, and what is left of it in the next row.
    ///@{
    double row_share = 0., row_decay = 0.;
    ///@}
    double duration = 1.; ///< of the test, over the usual one
    /// Noise of the rows over that of the axis that has more of it.
    double noise_share = 1.;
    /// Cosine and sine of the hum of the mains, as large as one believes it to
    /// be, at these times; empty without any.
    std::vector<std::vector<double>> hum;

    /// Of what drift, offset and slope are a share.
    double level(const double friction, const Noise &noise) const;

    /// Over which drift forgets, a share of the test's own duration.
    double drift_time(const Noise &noise) const;

    /// What is left in the next row of what rows have in common.
    double row_kept(const Noise &noise) const;
  };

  /// Turns noise into independent numbers of variance one, and back, for one
  /// test: one series, or one per axis with the gain in common.
  ///
  /// A hum of unknown phase is common to the rows of a series like an offset.
  /// Drift and rows are whitened by the innovations of a Kalman filter, the
  /// rest by an update of low rank: the work is proportional to the rows.
  class Whitener
  {
  public:
    Whitener(const std::vector<Series> &series,
             const double               level,
             const Noise               &noise);

    /// Whiten every column; rows are those of the first series, then of the
    /// second.
    void apply(Eigen::Ref<RowMatrix> columns) const;

    /// Logarithm of the determinant of the covariance.
    double log_determinant() const
    {
      return log_det;
    }

  private:
    /// One row of the Kalman filter, whose states are the drift and, of
    /// variance 1, what rows have in common with their neighbours.
    struct Step
    {
      bool   begins     = false; ///< a series
      double drift_kept = 0., row_kept = 0.;
      double row_weight = 0.; ///< of the second state in the row
      double drift_gain = 0., row_gain = 0.;
      double inverse_deviation = 1.;
    };

    void
    add_steps(const Series &series, const double level, const Noise &noise);

    void filter(Eigen::Ref<RowMatrix> columns) const;

    std::vector<Step> steps;
    /// Orthonormal columns of what is common to a test, filtered, and what is
    /// left of each (less 1).
    RowMatrix       common;
    Eigen::VectorXd shrinkage;
    double          log_det = 0.;
  };

  /// A sample of noise for the rows of a test.
  Eigen::VectorXd sample_noise(const std::vector<Series> &series,
                               const double               level,
                               const Noise               &noise,
                               std::mt19937_64           &random);

  /// The difference of replicates: one of n - 1 independent ones of n tests,
  /// scaled such that it has the covariance of one test.
  struct Contrast
  {
    std::vector<Series> series;
    double              level = 1.;
    Eigen::VectorXd     values;
    /// The tests it is made of, first the one that gives the times.
    std::vector<std::size_t> tests;
  };

  /// Noise with its uncertainty.
  struct NoiseEstimate
  {
    Noise noise;
    /// Of the logarithms of its components.
    Eigen::Matrix<double, Noise::n_components, Noise::n_components> covariance;
    std::size_t n_contrasts = 0;
    /// How well the noise of rows is known where they hang together, as of so
    /// many squares; 0: as well as the covariance says.
    double row_freedom = 0.;

    /// One that is as plausible.
    Noise draw(std::mt19937_64 &random) const;
  };

  /// Standard deviations, in logarithms, of what is thought of the noise before
  /// any replicates are seen.
  Noise::Logarithms prior_deviations();

  /// The most plausible noise, given replicates and what was thought of it
  /// before, with the uncertainty from the curvature there.
  NoiseEstimate estimate_noise(const std::vector<Contrast> &contrasts,
                               const Noise                 &prior);
} // namespace SlipStep

#endif
