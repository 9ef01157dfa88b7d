// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/least_squares.h>

#include <Eigen/Dense>

#include <algorithm>
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



    // By Broyden's rule: what a step has shown of the derivatives.
    void update(Eigen::MatrixXd       &derivatives,
                const Eigen::VectorXd &step,
                const Eigen::VectorXd &change)
    {
      const double square = step.squaredNorm();
      if (square > 0.)
        derivatives +=
          (change - derivatives * step) * step.transpose() / square;
    }



    // Whether steps as good as the best of the last ones would lead from a sum
    // to a goal.
    bool is_in_reach(const double               sum,
                     const double               goal,
                     const std::vector<double> &gains,
                     const unsigned int         n_left)
    {
      constexpr std::size_t n_last = 3;
      if (gains.size() < n_last)
        return true;
      return sum -
               n_left * *std::max_element(gains.end() - n_last, gains.end()) <=
             goal;
    }



    /// One step after the other.
    class Descent
    {
    public:
      Descent(const SquaresProblem    &problem,
              const Eigen::VectorXd   &start,
              const double             precision,
              const std::vector<bool> &held)
        : problem(problem)
        , precision(precision)
        , is_free(start.size(), true)
      {
        for (std::size_t i = 0; i < held.size(); ++i)
          is_free[i] = !held[i];
        best.x     = start;
        best.found = problem.residuals(best.x, best.residuals) && renew();
        best.sum   = best.residuals.squaredNorm();
      }

      void run(const unsigned int most_iterations);

      SquaresMinimum best;

    private:
      /// To where the sum is less, if there is such a place.
      /// @return by how much
      double step();

      bool renew()
      {
        is_exact = true;
        return problem.derivatives(best.x, best.derivatives);
      }

      // One per residual is noise; of sums far above that, tenths decide
      // nothing.
      double enough() const
      {
        return precision * std::max(1., best.sum / best.residuals.size());
      }

      bool is_late() const
      {
        return std::chrono::steady_clock::now() > problem.deadline;
      }

      const SquaresProblem &problem;
      const double          precision;
      std::vector<bool>     is_free;
      double                damping      = 1e-4;
      bool                  is_exact     = true; ///< of the derivatives
      bool                  was_foreseen = true; ///< what a step has gained
    };



    double Descent::step()
    {
      const Eigen::MatrixXd curvature =
        best.derivatives.transpose() * best.derivatives;
      const Eigen::VectorXd slope =
        best.derivatives.transpose() * best.residuals;
      const double usual_damping = damping;
      // Shorter steps do not help where it is the derivatives that are old.
      const unsigned int most_attempts = is_exact ? 12 : 1;
      for (unsigned int attempt = 0; attempt < most_attempts && !is_late();
           ++attempt)
        {
          const Eigen::VectorXd step =
            bounded_step(curvature, slope, best.x, damping, is_free);
          // What the linear problem promises: with a parameter stopped by its
          // bound perhaps nothing, unless the step is shorter.
          const double promised =
            -2. * slope.dot(step) - step.dot(curvature * step);
          const Eigen::VectorXd x = (best.x + step).cwiseMax(0.).cwiseMin(1.);
          Eigen::VectorXd       residuals;
          if (promised > 0.1 * enough() && problem.residuals(x, residuals) &&
              residuals.squaredNorm() < best.sum)
            {
              const double gain = best.sum - residuals.squaredNorm();
              was_foreseen      = gain > 0.7 * promised;
              damping = std::max(1e-9, damping * (was_foreseen ? 0.1 : 0.5));
              update(best.derivatives, x - best.x, residuals - best.residuals);
              is_exact       = false;
              best.x         = x;
              best.residuals = residuals;
              best.sum       = residuals.squaredNorm();
              return gain;
            }
          damping = std::max(1e-4, 8. * damping);
        }
      if (!is_exact)
        damping = usual_damping;
      was_foreseen = false;
      return 0.;
    }



    void Descent::run(const unsigned int most_iterations)
    {
      std::vector<double> gains;
      for (unsigned int n = 0; n < most_iterations; ++n)
        {
          const bool was_exact = is_exact;
          gains.push_back(step());
          const bool is_over =
            gains.back() < enough() || is_late() ||
            !is_in_reach(best.sum, problem.goal, gains, most_iterations - n);
          if (!is_exact && (is_over || !was_foreseen) && !renew())
            return;
          // By derivatives that were carried on no step says that it is the
          // last.
          if (is_over && (was_exact || is_late()))
            return;
        }
      if (!is_exact)
        renew();
    }
  } // namespace



  SquaresMinimum least_squares(const SquaresProblem    &problem,
                               const Eigen::VectorXd   &start,
                               const double             precision,
                               const std::vector<bool> &held,
                               const unsigned int       most_iterations)
  {
    Descent descent(problem, start, precision, held);
    if (descent.best.found)
      descent.run(most_iterations);
    return descent.best;
  }
} // namespace SlipStep
