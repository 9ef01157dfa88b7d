// SPDX-License-Identifier: LGPL-2.1-or-later

// Iterations of the linear solver over friction coefficient, stiffness of the
// contact, Poisson's ratio, dimension and elements, as a table in Markdown.
//   solver_robustness [multigrid|amg [<k in MPa/mm>...]]
// Iterations until the residual has fallen by 1e8, - for more than allowed. In
// brackets: the error against a factorisation after 1e11, if it is above 1e-8;
// ? if one of the two does not get there.

#include "../solid/solver_problem.h"

#include <slipstep/utilities/exceptions.h>

#include <deal.II/base/mpi.h>

#include <cstdio>
#include <iomanip>
#include <sstream>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  const std::vector<double> coefficients = {0.1, 0.3, 0.6, 1., 2.};

  std::string name(const ContactPattern pattern)
  {
    return pattern == ContactPattern::stick   ? "stick" :
           pattern == ContactPattern::mixed   ? "mixed" :
           pattern == ContactPattern::slip    ? "slip" :
           pattern == ContactPattern::turning ? "turning" :
                                                "weakening";
  }

  template <int dim>
  std::string solve(const SolverProblem<dim>  &problem,
                    TangentSystem<dim>        &system,
                    TangentSystem<dim>        &exact,
                    const ContactTangent<dim> &tangent)
  {
    const Vector b = problem.random();
    Vector       x = problem.zero(), expected = problem.zero();
    std::string  text;
    try
      {
        system.linearise(tangent);
        text = std::to_string(system.solve(x, b, 1e-8 * b.l2_norm()));
      }
    catch (const RunError &)
      {
        return "-";
      }
    try
      {
        exact.linearise(tangent);
        exact.solve(expected, b, 1e-11 * b.l2_norm());
        system.solve(x, b, 1e-11 * b.l2_norm());
        x -= expected;
        const double error = x.l2_norm() / expected.l2_norm();
        if (error > 1e-8)
          {
            std::ostringstream number;
            number << std::setprecision(1) << error;
            text += " (" + number.str() + ")";
          }
      }
    catch (const RunError &)
      {
        text += " (?)";
      }
    return text;
  }



  template <int dim>
  void rows(const SolverType           type,
            const std::vector<double> &stiffnesses,
            const unsigned int         degree,
            const unsigned int         n_local,
            const double               poisson)
  {
    std::ostringstream nu;
    nu << poisson;
    const SolverProblem<dim> problem(
      {{"Loading/Programme", "press 5.8 MPa in 1 s; slide 1 mm/s for 0.1 mm"},
       {"Block/Dimension", std::to_string(dim)},
       {"Block/Size", dim == 2 ? "10 mm, 5 mm" : "10 mm, 10 mm, 5 mm"},
       {"Block/Subdivisions", dim == 2 ? "2, 1" : "2, 2, 1"},
       {"Block/Degree", std::to_string(degree)},
       {"Block/Poisson ratio", nu.str()}},
      dim == 2    ? 5 - degree :
      degree == 1 ? 3 :
                    2,
      n_local);
    const auto system = problem.system(type);
    const auto exact  = problem.system(SolverType::direct);
    for (const auto pattern : {ContactPattern::stick,
                               ContactPattern::mixed,
                               ContactPattern::slip,
                               ContactPattern::turning,
                               ContactPattern::weakening})
      for (const double stiffness : stiffnesses)
        {
          std::printf("| %d-D | Q%u | %u | %g | %s | %.0e |",
                      dim,
                      degree,
                      n_local,
                      poisson,
                      name(pattern).c_str(),
                      stiffness);
          for (const double mu : coefficients)
            {
              std::printf(
                " %s |",
                solve(problem,
                      *system,
                      *exact,
                      problem.tangent(pattern, stiffness, stiffness, mu))
                  .c_str());
              if (pattern == ContactPattern::stick)
                break;
            }
          std::printf("\n");
          std::fflush(stdout);
        }
  }
} // namespace



int main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const SolverType    type = argc > 1 && std::string(argv[1]) == "amg" ?
                               SolverType::amg :
                               SolverType::multigrid;
  std::vector<double> stiffnesses;
  for (int i = 2; i < argc; ++i)
    stiffnesses.push_back(std::stod(argv[i]));
  if (stiffnesses.empty())
    stiffnesses = {1e3, 1e5, 1e6, 1e8};
  std::printf("| dimension | elements | local | nu | contact | k |");
  for (const double mu : coefficients)
    std::printf(" mu = %g |", mu);
  std::printf("\n");
  for (const double poisson : {0.3, 0.499})
    for (const unsigned int degree : {1, 2})
      for (const unsigned int n_local : {0, 2})
        {
          rows<2>(type, stiffnesses, degree, n_local, poisson);
          rows<3>(type, stiffnesses, degree, n_local, poisson);
        }
}
