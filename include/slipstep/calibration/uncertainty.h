// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_calibration_uncertainty_h
#define slipstep_calibration_uncertainty_h

#include <slipstep/calibration/calibration.h>
#include <slipstep/calibration/simulator.h>

#include <Eigen/Core>

#include <vector>

namespace SlipStep
{
  /// The campaign around an optimum, to first order.
  ///
  /// Its parameters x are natural ones: the logarithm of a parameter on a
  /// logarithmic scale, else its value over its size (over the distance of the
  /// bounds if these have different signs), so that 0.1 is about ten per cent.
  struct Linearisation
  {
    std::vector<double> scaled; ///< the optimum
    double              misfit = 0.;

    /// The triangular factor of the residuals' derivatives: R^T R = J^T J.
    Eigen::MatrixXd R;

    /// Variances are the inverse of J^T J times this: the mean square of the
    /// residuals over the noise (1 if it is less), times the number of rows
    /// that are off together; of several tests without each one's own gain.
    double inflation = 1.;

    /// Number of residuals that count as independent; all of those of rounded
    /// friction, since how much rounding errs is known without them.
    double n_effective = 0.;

    /// dx / d scaled.
    std::vector<double> size;

    /// The right singular vectors as columns, with the standard deviation along
    /// each, largest first; infinite where the tests say nothing.
    Eigen::MatrixXd directions;
    Eigen::VectorXd direction_deviations;
    /// The same, but no longer than the way between the bounds.
    Eigen::VectorXd bounded_deviations;

    Eigen::MatrixXd correlation;

    /// Standard deviation of every x; infinite where a direction of which the
    /// tests say nothing has a part of it.
    Eigen::VectorXd deviations;

    /// Whether a direction has a part of x_i. Less is round-off and the error
    /// of differences, which a parameter without any influence makes large.
    bool has_part_in(const Eigen::Index i, const Eigen::Index direction) const
    {
      return std::abs(directions(i, direction)) >
             1e-3 * directions.col(direction).lpNorm<Eigen::Infinity>();
    }

    /// How many times as wide as by the scatter of rows within tests the
    /// deviation of every x is, which has it already: by gains that differ from
    /// test to test, or as far as tests, left out one at a time, move it.
    Eigen::VectorXd between_tests;
    /// Degrees of freedom of that variance.
    Eigen::VectorXd freedom;
    /// What a unit of gain of every test (columns) moves x by; 0 where a
    /// direction is unknown.
    Eigen::MatrixXd by_gains;
    /// The same of a drift, from nothing to a unit in its last row.
    Eigen::MatrixXd by_drifts;
    /// The standard deviation of gains from test to test, as found.
    double gain = 0.;

    /// Whether tests differ in x_i by more than chance makes of their rows.
    bool differ_in(const Eigen::Index i) const
    {
      return between_tests(i) > by_chance;
    }
    static constexpr double by_chance = 2.;

    /// The increase of the misfit at which an interval of x_i ends.
    double threshold(const double confidence, const std::size_t i) const;
  };

  /// @param simulator planned at the optimum
  /// @param[out] tests the part of every test, with its curves
  Linearisation linearise(Simulator                 &simulator,
                          const std::vector<double> &scaled,
                          std::vector<TestMisfit>   &tests);

  /// How many neighbouring values hang together: 1 + 2 sum of the
  /// autocorrelation as long as it is significantly positive.
  double correlation_length(const double *values, const std::size_t n);

  /// What a profile was followed to: scaled values, the increase over the
  /// threshold.
  struct Profile : ProfileInterval
  {
    /// All parameters where the misfit was less than at the optimum; empty if
    /// it was nowhere.
    std::vector<double> better;
  };

  /// Move one parameter away from the optimum while all others are fitted
  /// again, until the misfit has risen by the threshold, on both sides.
  /// @throws OutOfTime behind the deadline
  Profile profile(const Simulator                            &planned,
                  const Linearisation                        &optimum,
                  const unsigned int                          parameter,
                  const double                                confidence,
                  const std::chrono::steady_clock::time_point deadline =
                    std::chrono::steady_clock::time_point::max());

  /// The interval that the curvature at the optimum alone gives.
  Profile symmetric_profile(const Linearisation &optimum,
                            const unsigned int   parameter,
                            const double         confidence);
} // namespace SlipStep

#endif
