// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/least_squares.h>

#include <gtest/gtest.h>

#include <cmath>

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
            [](const Eigen::VectorXd &x,
               const Eigen::VectorXd &,
               Eigen::MatrixXd &derivatives) {
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
