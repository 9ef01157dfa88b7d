// SPDX-License-Identifier: LGPL-2.1-or-later

// Geometric multigrid: its levels, and the same answers as other solvers.

#include "solver_problem.h"

#include <slipstep/solid/linear_solver/multigrid_levels.h>

#include <gtest/gtest.h>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  const Settings pressed = {
    {"Loading/Programme", "press 5.8 MPa in 1 s; slide 1 mm/s for 0.1 mm"}};

  Settings elements(const unsigned int dim, const unsigned int degree)
  {
    return pressed +
           Settings{{"Block/Dimension", std::to_string(dim)},
                    {"Block/Size",
                     dim == 2 ? "10 mm, 5 mm" : "10 mm, 8 mm, 5 mm"},
                    {"Block/Subdivisions", dim == 2 ? "2, 1" : "2, 2, 1"},
                    {"Block/Degree", std::to_string(degree)}};
  }

  template <int dim>
  dealii::Tensor<2, dim> integral(const ContactTangent<dim>     &tangent,
                                  const dealii::QGauss<dim - 1> &quadrature,
                                  const unsigned int             face)
  {
    dealii::Tensor<2, dim> sum;
    for (const auto &entry : tangent)
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        sum += entry.values[q] * quadrature.weight(q) *
               entry.cell->face(face)->measure();
    return sum;
  }

  template <int dim>
  void check_levels(const unsigned int degree, const std::string &contact)
  {
    Settings faces;
    if (contact != "bottom")
      faces = {{"Block/Faces/bottom", "free"},
               {"Block/Faces/top", "free"},
               {"Block/Faces/back", "pressure programme; drive"},
               {"Block/Faces/" + contact, "contact"}};
    const SolverProblem<dim> problem(elements(dim, degree) + faces, 1, 2);
    MultigridLevels<dim>     levels(problem.parameters, problem.dof_handler);
    std::mt19937             generator(7);
    std::uniform_real_distribution<> number(0., 1.);

    // Products a a^T are positive semidefinite, and stay so in averages.
    ContactTangent<dim> tangent =
      problem.tangent(ContactPattern::stick, 1., 1.);
    for (auto &face : tangent)
      for (auto &value : face.values)
        {
          dealii::Tensor<1, dim> a;
          for (unsigned int d = 0; d < dim; ++d)
            a[d] = number(generator) - 0.3;
          value = outer_product(a, a);
        }
    levels.set_tangent(tangent);
    const auto total = integral<dim>(tangent,
                                     problem.quadrature,
                                     problem.parameters.contact_face);
    ASSERT_GE(levels.n_levels(), 4u);
    for (unsigned int l = 0; l < levels.n_levels(); ++l)
      {
        const auto difference = integral<dim>(levels[l].tangent,
                                              problem.quadrature,
                                              problem.parameters.contact_face) -
                                total;
        EXPECT_LT(difference.norm(), 1e-12 * total.norm()) << "level " << l;
        for (const auto &face : levels[l].tangent)
          for (const auto &value : face.values)
            {
              dealii::Tensor<1, dim> x;
              for (unsigned int d = 0; d < dim; ++d)
                x[d] = number(generator) - 0.5;
              EXPECT_GE(x * (value * x), -1e-15);
            }
      }

    // What varies in space stays where it is.
    tangent           = problem.tangent(ContactPattern::stick, 1., 1.);
    const auto t      = problem.parameters.tangential_axis(0);
    const auto middle = problem.parameters.size[t] / 2.;
    for (auto &face : tangent)
      if (face.cell->center()[t] > middle)
        for (auto &value : face.values)
          value *= 2.;
    levels.set_tangent(tangent);
    for (const auto &face : levels[1].tangent)
      if (std::abs(face.cell->center()[t] - middle) >
          0.5 * face.cell->extent_in_direction(t))
        {
          const double expected = face.cell->center()[t] > middle ? 2. : 1.;
          for (const auto &value : face.values)
            EXPECT_NEAR(value[0][0], expected, 1e-12);
        }
  }
} // namespace



TEST(MultigridLevels, conserve_the_contact_tangent)
{
  check_levels<2>(1, "bottom");
  check_levels<2>(3, "bottom");
  check_levels<3>(1, "bottom");
  check_levels<3>(2, "bottom");
  // deal.II counts the points of this face the other way round.
  check_levels<3>(2, "front");
}



TEST(Multigrid, solves_what_a_factorisation_solves)
{
  const auto compare = [](const auto &problem, const unsigned int most) {
    for (const auto pattern : {ContactPattern::stick, ContactPattern::mixed})
      for (const double stiffness : {1e4, 1e6})
        {
          const auto   tangent = problem.tangent(pattern, stiffness, 1e4);
          const Vector b       = problem.random();
          const auto   solve   = [&](const SolverType type, Vector &x) {
            const auto system = problem.system(type);
            system->linearise(tangent);
            return system->solve(x, b, 1e-8 * b.l2_norm());
          };
          Vector             expected = problem.zero(), x = problem.zero();
          const unsigned int iterations = solve(SolverType::multigrid, x);
          solve(SolverType::direct, expected);
          x -= expected;
          EXPECT_LT(x.l2_norm(), 1e-5 * expected.l2_norm());
          EXPECT_LE(iterations, most)
            << problem.dof_handler.n_dofs() << " unknowns of degree "
            << problem.parameters.degree << ", alpha_n = " << stiffness;
        }
  };
  for (const unsigned int n_local : {0, 2})
    {
      for (const unsigned int degree : {1, 2, 3})
        compare(SolverProblem<2>(elements(2, degree), 3, n_local), 14);
      for (const unsigned int degree : {1, 2})
        compare(SolverProblem<3>(elements(3, degree), 2, n_local), 14);
    }
}



// With reactions at the supports. Where nodes hang, one has moved the forces to
// their neighbours already.
TEST(Multigrid, elastic_forces_are_those_of_the_matrix)
{
  const auto compare = [](const auto &problem) {
    Vector u = problem.random();
    problem.constraints.distribute(u);
    u.update_ghost_values();
    Vector forces = problem.zero(), expected = problem.zero();
    problem.system(SolverType::multigrid)->add_elastic_forces(u, forces);
    problem.system(SolverType::direct)->add_elastic_forces(u, expected);
    forces.compress(dealii::VectorOperation::add);
    expected.compress(dealii::VectorOperation::add);
    for (const auto &line : problem.constraints.get_lines())
      for (Vector *vector : {&forces, &expected})
        if (!line.entries.empty())
          {
            for (const auto &entry : line.entries)
              (*vector)(entry.first) += entry.second * (*vector)(line.index);
            (*vector)(line.index) = 0.;
          }
    forces -= expected;
    EXPECT_LT(forces.l2_norm(), 1e-12 * expected.l2_norm())
      << problem.dof_handler.n_dofs() << " unknowns of degree "
      << problem.parameters.degree;
  };
  for (const unsigned int n_local : {0, 1, 2})
    {
      compare(SolverProblem<2>(elements(2, 2), 3, n_local));
      compare(SolverProblem<3>(elements(3, 1), 3, n_local));
      compare(SolverProblem<3>(elements(3, 2), 1, n_local));
      compare(SolverProblem<3>(elements(3, 2), 2, n_local));
    }
}



TEST(Solvers, agree_for_a_whole_run)
{
  const auto compare = [](const Settings &settings, const auto dimension) {
    constexpr int            dim = decltype(dimension)::value;
    std::vector<BlockResult> results;
    for (const std::string solver : {"direct", "amg", "multigrid"})
      results.push_back(run_block_case<dim>(make_parameters(
        settings +
        Settings{{"Block/Solver", solver},
                 {"Block/Newton tolerance", "1e-10"},
                 {"Time stepping/Tolerance", "1e-3"},
                 {"Time stepping/Least steps per statement", "3"}})));
    for (const BlockResult &result : results)
      {
        EXPECT_EQ(result.failure, "");
        ASSERT_EQ(result.history.size(), results[0].history.size());
        EXPECT_LT(result.force_imbalance, 1e-8);
        for (unsigned int i = 0; i < result.history.size(); ++i)
          {
            const HistoryRow &a = result.history[i];
            const HistoryRow &b = results[0].history[i];
            ASSERT_NEAR(a.friction, b.friction, 1e-9);
            ASSERT_NEAR(a.normal_load, b.normal_load, 1e-9 * b.normal_load);
            ASSERT_NEAR(a.stored_energy,
                        b.stored_energy,
                        1e-8 * b.stored_energy);
            ASSERT_NEAR(a.external_work,
                        b.external_work,
                        1e-8 * b.external_work);
          }
      }
  };
  using Two   = std::integral_constant<int, 2>;
  using Three = std::integral_constant<int, 3>;
  compare(elements(2, 2) + Settings{{"Block/Subdivisions", "8, 4"}}, Two());
  compare(elements(3, 1) +
            Settings{{"Block/Subdivisions", "4, 4, 4"},
                     {"Block/Faces/top", "pressure programme; drive; flat"}},
          Three());
  // Odd subdivisions leave one level, or the linear elements below it.
  compare(elements(3, 2) +
            Settings{{"Block/Subdivisions", "3, 3, 3"},
                     {"Block/Faces/front", "displacement y 0.0001 mm"}},
          Three());
}
