// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/least_squares.h>

#include <Eigen/Dense>

#include <vector>

namespace SlipStep
{
  namespace
  {
    // The damped step of those parameters that it does not push over a bound.
    Eigen::VectorXd bounded_step(const Eigen::MatrixXd &curvature,
                                 const Eigen::VectorXd &slope,
                                 const Eigen::VectorXd &x,
                                 const double           damping,
                                 std::vector<bool>      is_free)
    {
      const Eigen::Index n    = x.size();
      Eigen::VectorXd    step = Eigen::VectorXd::Zero(n);
      for (Eigen::Index pass = 0; pass <= n; ++pass)
        {
          Eigen::MatrixXd matrix = curvature;
          Eigen::VectorXd right  = -slope;
          for (Eigen::Index i = 0; i < n; ++i)
            if (is_free[i])
              for (Eigen::Index j = 0; j < n; ++j)
                right(i) -= is_free[j] ? 0. : curvature(i, j) * step(j);
          matrix.diagonal() *= 1. + damping;
          matrix.diagonal().array() += 1e-12 * curvature.trace() + 1e-300;
          for (Eigen::Index i = 0; i < n; ++i)
            if (!is_free[i])
              {
                matrix.row(i).setZero();
                matrix.col(i).setZero();
                matrix(i, i) = 1.;
                right(i)     = step(i);
              }
          step         = matrix.ldlt().solve(right);
          bool changed = false;
          for (Eigen::Index i = 0; i < n; ++i)
            if (is_free[i] && (x(i) + step(i) < 0. || x(i) + step(i) > 1.))
              {
                is_free[i] = false;
                step(i)    = x(i) + step(i) < 0. ? -x(i) : 1. - x(i);
                changed    = true;
              }
          if (!changed)
            break;
        }
      return step;
    }
  } // namespace



  SquaresMinimum least_squares(const SquaresProblem    &problem,
                               const Eigen::VectorXd   &start,
                               const double             precision,
                               const std::vector<bool> &held,
                               const unsigned int       most_iterations)
  {
    std::vector<bool> is_free(start.size(), true);
    for (std::size_t i = 0; i < held.size(); ++i)
      is_free[i] = !held[i];
    SquaresMinimum best;
    best.x = start;
    if (!problem.residuals(best.x, best.residuals) ||
        !problem.derivatives(best.x, best.residuals, best.derivatives))
      return best;
    best.found     = true;
    best.sum       = best.residuals.squaredNorm();
    double damping = 1e-4;
    // One per residual is noise; of sums far above that, tenths decide nothing.
    const auto enough = [&]() {
      return precision * std::max(1., best.sum / best.residuals.size());
    };
    for (unsigned int n = 0; n < most_iterations; ++n)
      {
        const Eigen::MatrixXd curvature =
          best.derivatives.transpose() * best.derivatives;
        const Eigen::VectorXd slope =
          best.derivatives.transpose() * best.residuals;
        bool   is_better = false;
        double gain      = 0.;
        for (unsigned int attempt = 0; attempt < 12 && !is_better; ++attempt)
          {
            const Eigen::VectorXd step =
              bounded_step(curvature, slope, best.x, damping, is_free);
            // What the linear problem promises: with a parameter stopped by
            // its bound perhaps nothing, unless the step is shorter.
            const double promised =
              -2. * slope.dot(step) - step.dot(curvature * step);
            const Eigen::VectorXd x = (best.x + step).cwiseMax(0.).cwiseMin(1.);
            Eigen::VectorXd       residuals;
            if (std::chrono::steady_clock::now() > problem.deadline)
              return best;
            if (promised > 0.1 * enough() && problem.residuals(x, residuals) &&
                residuals.squaredNorm() < best.sum)
              {
                is_better      = true;
                gain           = best.sum - residuals.squaredNorm();
                best.x         = x;
                best.residuals = residuals;
                best.sum       = residuals.squaredNorm();
                damping =
                  std::max(1e-9, damping * (gain > 0.7 * promised ? 0.1 : 0.5));
              }
            else
              damping = std::max(1e-4, 8. * damping);
          }
        if (!is_better ||
            !problem.derivatives(best.x, best.residuals, best.derivatives) ||
            gain < enough())
          return best;
      }
    return best;
  }
} // namespace SlipStep
