// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/block.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/text.h>

#include <malloc.h>

namespace SlipStep
{
  using namespace dealii;

  // @sect3{The linear solver, and what if it fails}

  template <int dim>
  void Block<dim>::choose_solver()
  {
    is_linearised = false;
    if (solver_in_use == SolverType::automatic)
      solver_in_use = parameters.solver_for(dof_handler.n_dofs());
    if (solver_in_use == SolverType::multigrid)
      system = make_multigrid_system<dim>(parameters,
                                          dof_handler,
                                          homogeneous_constraints);
    else
      system = make_assembled_system<dim>(solver_in_use,
                                          parameters,
                                          dof_handler,
                                          homogeneous_constraints,
                                          relevant,
                                          contact.quadrature());
    // What setting up needed is a tenth of all memory, in pieces too small for
    // the vectors of the solver: the system may have it back.
    malloc_trim(0);
  }



  // Whoever asks for a solver gets that one. 'automatic' goes on with the next
  // one where one fails: geometric multigrid, algebraic multigrid, and a
  // factorisation, if that may fit into memory.
  template <int dim>
  unsigned int Block<dim>::solve_linear_system(Vector      &update,
                                               const double tolerance)
  {
    std::string failures;
    while (true)
      {
        try
          {
            if (!is_linearised)
              system->linearise(contact.tangent(), inertia.factors(stage_time));
            is_linearised = true;
            return system->solve(update, right_hand_side, tolerance);
          }
        catch (const RunError &error)
          {
            failures +=
              (failures.empty() ? "" : "; ") + std::string(error.what());
          }
        if (parameters.solver != SolverType::automatic ||
            !take_next_solver(failures))
          break;
      }
    if (solver_in_use != SolverType::direct &&
        parameters.solver != SolverType::automatic)
      {
        failures += "; 'set Solver = automatic' in section Block goes on with "
                    "another solver where one fails";
        note_failure_of_solver();
      }
    // The tangent may be to blame: the next one begins anew.
    begin_with_first_solver();
    throw RunError(failures);
  }



  template <int dim>
  void Block<dim>::count_linear_iterations(const unsigned int n)
  {
    newton.n_linear += n;
    n_linear_total += n;
  }



  template <int dim>
  void Block<dim>::note_failure_of_solver()
  {
    if (n_solver_failures[0] + n_solver_failures[1] == 0)
      first_solver_failure = control.time();
    ++n_solver_failures[solver_in_use == SolverType::multigrid ? 0 : 1];
  }



  // Matrix and factors: what counts is the memory of one process.
  template <int dim>
  bool Block<dim>::take_next_solver(std::string &failures)
  {
    if (solver_in_use == SolverType::direct)
      return false;
    const bool was_multigrid = solver_in_use == SolverType::multigrid;
    note_failure_of_solver();
    if (!was_multigrid && parameters.memory_of_factors(dof_handler.n_dofs()) >
                            parameters.refinement.most_memory)
      {
        failures += "; a factorisation may not fit into memory";
        return false;
      }
    solver_in_use = was_multigrid ? SolverType::amg : SolverType::direct;
    system.reset();
    choose_solver();
    return true;
  }



  // A solver that had to help stays for the rest of the statement, as what is
  // hard for the first one usually lasts, but not for the rest of the run.
  template <int dim>
  void Block<dim>::begin_with_first_solver()
  {
    if (solver_in_use == parameters.solver_for(dof_handler.n_dofs()))
      return;
    solver_in_use = SolverType::automatic;
    system.reset();
    choose_solver();
  }



  template <int dim>
  std::string Block<dim>::warning_of_solver() const
  {
    if (n_solver_failures[0] + n_solver_failures[1] == 0)
      return "";
    const auto times = [](const unsigned long long n) {
      return n == 1 ? std::string("once") : std::to_string(n) + " times";
    };
    const std::string first = short_text(first_solver_failure, 6);
    if (parameters.solver != SolverType::automatic)
      return "the linear solver did not converge, " +
             times(n_solver_failures[0] + n_solver_failures[1]) +
             " and first at t = " + first +
             " s; each time a step was cut, which may make a run endless: "
             "'set Solver = automatic' in section Block goes on with another "
             "solver";
    return "the first choice of linear solver did not converge, first at t = " +
           first + " s: geometric multigrid failed " +
           times(n_solver_failures[0]) +
           ", where algebraic multigrid took over for the rest of the "
           "statement" +
           (n_solver_failures[1] > 0 ? ", and algebraic multigrid failed " +
                                         times(n_solver_failures[1]) +
                                         ", where a factorisation took over" :
                                       "") +
           "; this takes longer, but the results are as accurate";
  }
} // namespace SlipStep
