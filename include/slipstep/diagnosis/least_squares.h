// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_least_squares_h
#define slipstep_diagnosis_least_squares_h

#include <Eigen/Core>

#include <chrono>
#include <functional>
#include <limits>
#include <vector>

namespace SlipStep
{
  /// A sum of squares of the parameters x, each between 0 and 1.
  struct SquaresProblem
  {
    /// The residuals; false where there are none.
    std::function<bool(const Eigen::VectorXd &x, Eigen::VectorXd &residuals)>
      residuals;
    /// Their derivatives; false where there are none.
    std::function<bool(const Eigen::VectorXd &x, Eigen::MatrixXd &derivatives)>
      derivatives;
    /// The best that is known then has to do.
    std::chrono::steady_clock::time_point deadline =
      std::chrono::steady_clock::time_point::max();
    /// Sums above are of no use: a search whose pace will not bring it below
    /// ends.
    double goal = std::numeric_limits<double>::infinity();
  };

  struct SquaresMinimum
  {
    bool            found = false;
    Eigen::VectorXd x;
    double          sum = 0.; ///< of squares
    Eigen::VectorXd residuals;
    Eigen::MatrixXd derivatives;
  };

  /// The least sum of squares by the method of Levenberg and Marquardt with
  /// active bounds, until a step gains less than @p precision
  /// times the larger of one and the mean of the squares. While steps gain what
  /// they promise, the derivatives are carried on by Broyden's rule: each costs
  /// as many simulations as there are parameters. Those returned are asked for
  /// at the end.
  ///
  /// Beside fit(), which asks Ceres: a diagnosis makes hundreds of short fits
  /// from good starts, for which the trial steps that Ceres spends on bounds
  /// cost more than the rest.
  ///
  /// @param held parameters that stay; none if empty
  SquaresMinimum least_squares(const SquaresProblem    &problem,
                               const Eigen::VectorXd   &start,
                               const double             precision,
                               const std::vector<bool> &held            = {},
                               const unsigned int       most_iterations = 30);
} // namespace SlipStep

#endif
