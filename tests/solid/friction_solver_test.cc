// SPDX-License-Identifier: LGPL-2.1-or-later

// The linear solver with much friction and stiff contact, and what happens when
// it does not converge.

#include "solver_problem.h"

#include <slipstep/solid/linear_solver/assembled_matrix.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  template <int dim>
  SolverProblem<dim> make_problem(const unsigned int degree,
                                  const unsigned int n_local,
                                  const std::string &poisson)
  {
    return SolverProblem<dim>(
      {{"Loading/Programme", "press 5.8 MPa in 1 s; slide 1 mm/s for 0.1 mm"},
       {"Block/Dimension", std::to_string(dim)},
       {"Block/Size", dim == 2 ? "10 mm, 5 mm" : "10 mm, 10 mm, 5 mm"},
       {"Block/Subdivisions", dim == 2 ? "2, 1" : "2, 2, 1"},
       {"Block/Degree", std::to_string(degree)},
       {"Block/Poisson ratio", poisson}},
      dim == 2 ? 5 - degree : 3 - degree,
      n_local);
  }

  // A block whose face slips all over: stiff, with much friction.
  Settings sliding(const std::string &coefficient, const std::string &stiffness)
  {
    return {{"Loading/Programme",
             "press 5.8 MPa in 1 s; slide 1 mm/s for 0.01 mm"},
            {"Friction/Effects", "subloading"},
            {"Friction/Static coefficient", coefficient},
            {"Friction/Normal stiffness", stiffness + " MPa/mm"},
            {"Friction/Tangential stiffness", stiffness + " MPa/mm"},
            {"Time stepping/Equal steps per statement", "4"},
            {"Block/Newton iterations", "40"}};
  }

  const Settings plane_strain = {{"Block/Dimension", "2"},
                                 {"Block/Size", "10 mm, 5 mm"},
                                 {"Block/Subdivisions", "16, 8"}};

  // On such cells, in nearly incompressible material, a point smoother is of
  // little use.
  const Settings hard = {{"Block/Dimension", "2"},
                         {"Block/Size", "10 mm, 1 mm"},
                         {"Block/Subdivisions", "8, 64"},
                         {"Block/Degree", "2"},
                         {"Block/Poisson ratio", "0.4999"},
                         {"Block/Newton tolerance", "1e-8"}};

  void expect_equal(const BlockResult &result,
                    const BlockResult &expected,
                    const double       tolerance)
  {
    EXPECT_EQ(result.failure, "");
    EXPECT_EQ(expected.failure, "");
    ASSERT_EQ(result.history.size(), expected.history.size());
    for (unsigned int i = 0; i < result.history.size(); ++i)
      {
        const HistoryRow &a = result.history[i], &b = expected.history[i];
        ASSERT_NEAR(a.friction, b.friction, tolerance);
        ASSERT_NEAR(a.normal_load, b.normal_load, tolerance * b.normal_load);
      }
  }
} // namespace



TEST(DefinitePart, is_symmetric_and_positive_semidefinite)
{
  std::mt19937                     generator(3);
  std::uniform_real_distribution<> number(-1., 1.);
  const auto                       random = [&](auto &tensor) {
    for (unsigned int i = 0; i < tensor.dimension; ++i)
      for (unsigned int j = 0; j < tensor.dimension; ++j)
        tensor[i][j] = number(generator);
  };
  for (unsigned int n = 0; n < 1000; ++n)
    for (const unsigned int normal : {0, 1, 2})
      {
        dealii::Tensor<2, 3> tangent;
        random(tangent);
        const auto part = definite_part(tangent, normal);
        EXPECT_EQ(part, transpose(part));
        dealii::Tensor<1, 3> x;
        for (unsigned int d = 0; d < 3; ++d)
          x[d] = number(generator);
        EXPECT_GE(x * (part * x), -1e-14);
        // As stiff as the tangent in the contact plane.
        x[normal]      = 0.;
        auto forces    = tangent * x;
        forces[normal] = 0.;
        EXPECT_NEAR((part * x).norm(), forces.norm(), 1e-13);
        EXPECT_EQ(part[normal][normal], std::max(0., tangent[normal][normal]));
        // A part has itself as its part.
        EXPECT_LT((definite_part(part, normal) - part).norm(), 1e-14);
        for (unsigned int d = 0; d < 3; ++d)
          if (d != normal)
            {
              EXPECT_EQ(part[normal][d], 0.);
            }
      }
  for (const double along : {-1., 0.3})
    {
      dealii::Tensor<2, 2> tangent;
      tangent[0][0]   = along;
      tangent[0][1]   = 2.;
      tangent[1][1]   = 1.;
      const auto part = definite_part(tangent, 1);
      EXPECT_EQ(part[0][0], std::abs(along));
      EXPECT_EQ(part[0][1], 0.);
      EXPECT_EQ(part[1][1], 1.);
    }
}



// With the symmetric part of all of it in the smoothers, those with
// coefficients above 0.3 on stiff contact do not converge at all.
TEST(Multigrid, holds_for_all_coefficients_of_friction)
{
  const auto check = [](const auto &problem, const auto dimension) {
    constexpr int        dim    = decltype(dimension)::value;
    const auto           system = problem.system(SolverType::multigrid);
    const auto           direct = problem.system(SolverType::direct);
    const Vector         b      = problem.random();
    Vector               x = problem.zero(), expected = problem.zero();
    AssembledMatrix<dim> matrix(problem.parameters,
                                problem.dof_handler,
                                problem.constraints,
                                problem.relevant,
                                problem.quadrature);
    for (const auto pattern :
         {ContactPattern::mixed, ContactPattern::slip, ContactPattern::turning})
      for (const double stiffness : {1e3, 1e6, 1e8})
        {
          unsigned int least = 0;
          for (const double coefficient : {0.1, 0.6, 1., 2.})
            {
              // Here it does not: the fallback's business.
              if (problem.parameters.degree == 2 &&
                  problem.parameters.poisson_ratio > 0.4 &&
                  pattern == ContactPattern::slip && stiffness == 1e8 &&
                  coefficient == 2.)
                continue;
              const auto tangent =
                problem.tangent(pattern, stiffness, stiffness, coefficient);
              SCOPED_TRACE(std::to_string(problem.dof_handler.n_dofs()) +
                           " unknowns of degree " +
                           std::to_string(problem.parameters.degree) + ", nu " +
                           std::to_string(problem.parameters.poisson_ratio) +
                           ", pattern " +
                           std::to_string(static_cast<int>(pattern)) + ", k " +
                           std::to_string(stiffness) + ", mu " +
                           std::to_string(coefficient));
              system->linearise(tangent);
              unsigned int iterations = system->solve(x, b, 1e-8 * b.l2_norm());
              if (coefficient == 0.1)
                least = iterations;
              EXPECT_LE(iterations, 2 * least);
              direct->linearise(tangent);
              direct->solve(expected, b, 1e-8 * b.l2_norm());
              // Four digits more, of what is left.
              matrix.set_tangent(tangent);
              const auto correct = [&](auto &solver, Vector &solution) {
                Vector rest = problem.zero(), correction = problem.zero();
                matrix.matrix().vmult(rest, solution);
                rest.sadd(-1., 1., b);
                solver.solve(correction, rest, 1e-4 * rest.l2_norm());
                solution += correction;
              };
              correct(*system, x);
              correct(*direct, expected);
              x -= expected;
              EXPECT_LT(x.l2_norm(), 1e-8 * expected.l2_norm());
            }
        }
  };
  // Quadratic elements with 0.499 take more than a hundred iterations, whatever
  // the friction: see Fallback.
  for (const unsigned int degree : {1, 2})
    for (const std::string poisson : {"0.3", degree == 1 ? "0.499" : "0.48"})
      for (const unsigned int n_local : {0, 2})
        {
          check(make_problem<2>(degree, n_local, poisson),
                std::integral_constant<int, 2>());
          check(make_problem<3>(degree, n_local, poisson),
                std::integral_constant<int, 3>());
        }
}



// Runs that ended with exit code 1.
TEST(Multigrid, slides_a_block_with_much_friction_on_stiff_contact)
{
  for (const std::string stiffness : {"1e5", "1e6", "1e7"})
    {
      const auto run = [&](const std::string &coefficient,
                           const std::string &solver) {
        return run_block_case<2>(
          make_parameters(sliding(coefficient, stiffness) + plane_strain +
                          Settings{{"Block/Solver", solver}}));
      };
      const BlockResult result = run("1", "multigrid");
      expect_equal(result, run("1", "direct"), 1e-8);
      const BlockResult little = run("0.1", "multigrid");
      EXPECT_EQ(little.failure, "");
      const auto per_newton_step = [](const Summary &summary) {
        return static_cast<double>(summary.linear_iterations) /
               summary.newton_iterations;
      };
      EXPECT_LE(per_newton_step(result.summary),
                2. * per_newton_step(little.summary))
        << stiffness;
    }
}



TEST(Fallback, another_solver_takes_over_and_the_summary_says_so)
{
  const auto run = [](const std::string &solver) {
    return run_block_case<2>(make_parameters(
      sliding("0.3", "1e5") + hard + Settings{{"Block/Solver", solver}}));
  };
  const BlockResult result = run("automatic");
  EXPECT_GT(result.summary.dofs, 3000u);
  expect_equal(result, run("direct"), 1e-6);
  ASSERT_EQ(result.summary.warnings.size(), 1u);
  EXPECT_NE(result.summary.warnings[0].find("multigrid"), std::string::npos)
    << result.summary.warnings[0];

  // Who asks for one gets that one, and is told of the way out.
  const BlockResult failed = run("multigrid");
  EXPECT_NE(failed.failure.find("multigrid did not converge"),
            std::string::npos)
    << failed.failure;
  EXPECT_NE(failed.failure.find("'set Solver = automatic'"), std::string::npos)
    << failed.failure;
  ASSERT_EQ(failed.summary.warnings.size(), 1u);
  EXPECT_EQ(failed.summary.warnings[0].find("the linear solver did not"), 0u)
    << failed.summary.warnings[0];
}



// With memory for the matrix at most, nothing is left after multigrid.
TEST(Fallback, no_factorisation_that_does_not_fit)
{
  const Parameters parameters =
    make_parameters(sliding("0.3", "1e5") + hard +
                    Settings{{"Block/Refinement", "adaptive 1"},
                             {"Block/Adaptivity/Most memory", "4"},
                             {"Block/Adaptivity/Beyond the limit", "warn"}});
  const BlockParameters block(parameters, parse_programme(parameters));
  EXPECT_GT(block.memory_of_factors(block.n_unknowns()), 4.);
  EXPECT_LT(block.least_memory(), 4.);
}



TEST(Fallback, ordinary_runs_have_none)
{
  const BlockResult result = run_block_case<2>(make_parameters(
    sliding("0.1", "1e5") + Settings{{"Block/Dimension", "2"},
                                     {"Block/Size", "10 mm, 5 mm"},
                                     {"Block/Subdivisions", "64, 32"}}));
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.summary.dofs, 3000u);
  EXPECT_TRUE(result.summary.warnings.empty());
}
