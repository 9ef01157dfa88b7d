// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/least_squares.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

using namespace SlipStep;

namespace
{
  // Rosenbrock's valley, its minimum at (a, a^2).
  SquaresProblem valley(const double a)
  {
    return {[=](const Eigen::VectorXd &x, Eigen::VectorXd &residuals) {
              residuals.resize(2);
              residuals << 10. * (x(1) - x(0) * x(0)), a - x(0);
              return true;
            },
            [](const Eigen::VectorXd &x, Eigen::MatrixXd &derivatives) {
              derivatives.resize(2, 2);
              derivatives << -20. * x(0), 10., -1., 0.;
              return true;
            }};
  }

  Eigen::VectorXd point(const double x, const double y)
  {
    return Eigen::Vector2d(x, y);
  }
} // namespace



TEST(LeastSquares, FollowsAValley)
{
  const SquaresMinimum found =
    least_squares(valley(0.8), point(0.1, 0.9), 1e-14);
  ASSERT_TRUE(found.found);
  EXPECT_NEAR(found.x(0), 0.8, 1e-6);
  EXPECT_NEAR(found.x(1), 0.64, 1e-6);
  EXPECT_LT(found.sum, 1e-10);
}



// Outside of the bounds the minimum is on them, and the other parameter is the
// best one there.
TEST(LeastSquares, StopsAtABound)
{
  const SquaresMinimum found =
    least_squares(valley(1.5), point(0.2, 0.2), 1e-14, {}, 300);
  ASSERT_TRUE(found.found);
  EXPECT_NEAR(found.x(0), 1., 1e-5);
  EXPECT_NEAR(found.x(1), 1., 1e-5);
}



TEST(LeastSquares, StaysWhereItIsWhenItsTimeIsOver)
{
  SquaresProblem late        = valley(0.8);
  late.deadline              = std::chrono::steady_clock::now();
  const SquaresMinimum found = least_squares(late, point(0.1, 0.9), 1e-14);
  ASSERT_TRUE(found.found);
  EXPECT_EQ(found.x, point(0.1, 0.9));
  EXPECT_EQ(found.derivatives.rows(), 2);
}



TEST(LeastSquares, LeavesWhatIsHeld)
{
  const SquaresMinimum found =
    least_squares(valley(0.8), point(0.5, 0.9), 1e-14, {true, false});
  ASSERT_TRUE(found.found);
  EXPECT_EQ(found.x(0), 0.5);
  EXPECT_NEAR(found.x(1), 0.25, 1e-6);
}



// Where there are no residuals, smaller steps are tried.
TEST(LeastSquares, AvoidsWhatCannotBeSimulated)
{
  SquaresProblem problem = valley(0.8);
  const auto     whole   = problem.residuals;
  problem.residuals      = [=](const Eigen::VectorXd &x,
                          Eigen::VectorXd       &residuals) {
    return x(1) < 0.7 && whole(x, residuals);
  };
  const SquaresMinimum found = least_squares(problem, point(0.1, 0.5), 1e-14);
  ASSERT_TRUE(found.found);
  EXPECT_NEAR(found.x(0), 0.8, 1e-5);
  EXPECT_FALSE(least_squares(problem, point(0.1, 0.9), 1e-14).found);
}



namespace
{
  // Decays a exp(-b t) of other a and b, with errors.
  struct Decays
  {
    explicit Decays(const unsigned int seed)
    {
      std::mt19937                           random(seed);
      std::uniform_real_distribution<double> between(0.2, 0.8);
      std::normal_distribution<double>       error(0., 0.02);
      const double                           a = between(random);
      const double                           b = between(random);
      for (unsigned int i = 0; i < 40; ++i)
        {
          t.push_back(0.1 * i);
          y.push_back(a * std::exp(-b * t.back()) + error(random));
        }
    }

    Eigen::VectorXd residuals(const Eigen::VectorXd &x) const
    {
      Eigen::VectorXd result(t.size());
      for (std::size_t i = 0; i < t.size(); ++i)
        result(i) = x(0) * std::exp(-x(1) * t[i]) - y[i];
      return result;
    }

    Eigen::MatrixXd derivatives(const Eigen::VectorXd &x) const
    {
      Eigen::MatrixXd result(t.size(), 2);
      for (std::size_t i = 0; i < t.size(); ++i)
        result.row(i) << std::exp(-x(1) * t[i]),
          -t[i] * x(0) * std::exp(-x(1) * t[i]);
      return result;
    }

    SquaresProblem problem()
    {
      return {[this](const Eigen::VectorXd &x, Eigen::VectorXd &found) {
                ++n_residuals;
                found = residuals(x);
                return true;
              },
              [this](const Eigen::VectorXd &x, Eigen::MatrixXd &found) {
                ++n_derivatives;
                found = derivatives(x);
                return true;
              }};
    }

    std::vector<double> t, y;
    unsigned int        n_residuals = 0, n_derivatives = 0;
  };
} // namespace



// Derivatives are carried on from step to step where that does; those of the
// end are its own, and the slope is nothing there.
TEST(LeastSquares, CarriesDerivativesOn)
{
  unsigned int n_residuals = 0, n_derivatives = 0;
  for (unsigned int seed = 1; seed <= 20; ++seed)
    {
      Decays               decays(seed);
      const SquaresMinimum found =
        least_squares(decays.problem(), point(0.5, 0.5), 1e-12);
      ASSERT_TRUE(found.found);
      EXPECT_EQ(found.derivatives, decays.derivatives(found.x)) << seed;
      EXPECT_EQ(found.residuals, decays.residuals(found.x)) << seed;
      EXPECT_LT((found.derivatives.transpose() * found.residuals).norm(), 1e-5)
        << seed;
      n_residuals += decays.n_residuals;
      n_derivatives += decays.n_derivatives;
    }
  EXPECT_LT(2 * n_derivatives, n_residuals);
}



// What will not come below the goal is not followed to its end; what does is.
TEST(LeastSquares, GivesUpWhatIsOutOfReach)
{
  for (unsigned int seed = 1; seed <= 20; ++seed)
    {
      Decays               whole(seed), hopeless(seed), hopeful(seed);
      const auto           start = point(1., 0.);
      const SquaresMinimum found = least_squares(whole.problem(), start, 1e-12);
      SquaresProblem       problem = hopeless.problem();
      problem.goal                 = 0.5 * found.sum;
      least_squares(problem, start, 1e-12);
      EXPECT_LE(hopeless.n_residuals, whole.n_residuals) << seed;
      problem      = hopeful.problem();
      problem.goal = 1.01 * found.sum;
      EXPECT_NEAR(least_squares(problem, start, 1e-12).sum,
                  found.sum,
                  1e-6 * found.sum)
        << seed;
    }
}
