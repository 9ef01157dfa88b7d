// The matrix-free units with SIMD types as wide as the processor against the
// same units with those of the library, which this file is compiled with.

#include <slipstep/solid/multigrid_system.h>

#include "solver_problem.h"

#include <gtest/gtest.h>

using namespace SlipStep;
using namespace SlipStep::Testing;



TEST(SimdWidth, does_not_change_the_answers)
{
  const SolverProblem<3> problem({{"Loading/Programme", "press 5.8 MPa in 1 s"},
                                  {"Block/Subdivisions", "2, 2, 2"},
                                  {"Block/Degree", "2"}},
                                 1,
                                 1);
  const auto             wide = problem.system(SolverType::multigrid);
  MultigridSystem<3, 2>  plain(problem.parameters,
                              problem.dof_handler,
                              problem.constraints);

  Vector u = problem.random();
  problem.constraints.distribute(u);
  u.update_ghost_values();
  Vector forces = problem.zero(), expected = problem.zero();
  wide->add_elastic_forces(u, forces);
  plain.add_elastic_forces(u, expected);
  forces -= expected;
  EXPECT_GT(expected.l2_norm(), 1e3);
  EXPECT_LT(forces.l2_norm(), 1e-14 * expected.l2_norm());

  const auto   tangent = problem.tangent(ContactPattern::mixed, 1e5, 1e4);
  const Vector b       = problem.random();
  Vector       x = problem.zero(), expected_x = problem.zero();
  wide->linearise(tangent);
  plain.linearise(tangent);
  EXPECT_EQ(wide->solve(x, b, 1e-12 * b.l2_norm()),
            plain.solve(expected_x, b, 1e-12 * b.l2_norm()));
  x -= expected_x;
  EXPECT_LT(x.l2_norm(), 1e-10 * expected_x.l2_norm());
}
