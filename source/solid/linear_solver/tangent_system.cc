// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/linear_solver/tangent_system.h>

#include <slipstep/solid/linear_solver/assembled_matrix.h>
#include <slipstep/solid/linear_solver/preconditioner.h>
#include <slipstep/utilities/exceptions.h>

#include <deal.II/lac/solver_gmres.h>

#include <iomanip>
#include <sstream>

namespace SlipStep
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    class AssembledSystem : public TangentSystem<dim>
    {
    public:
      AssembledSystem(const SolverType                 type,
                      const BlockParameters           &parameters,
                      const DoFHandler<dim>           &dof_handler,
                      const AffineConstraints<double> &constraints,
                      const IndexSet                  &relevant,
                      const Quadrature<dim - 1>       &face_quadrature)
        : type(type)
        , dof_handler(dof_handler)
        , matrix(parameters,
                 dof_handler,
                 constraints,
                 relevant,
                 face_quadrature)
        , preconditioner(type == SolverType::direct ?
                           make_direct_preconditioner() :
                           make_amg_preconditioner<dim>(dof_handler))
      {}

      virtual void add_elastic_forces(const Vector &displacement,
                                      Vector       &forces) const override
      {
        const unsigned int     n = dof_handler.get_fe().dofs_per_cell;
        dealii::Vector<double> local(n), local_forces(n);
        std::vector<types::global_dof_index> dofs(n);
        for (const auto &cell : dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              cell->get_dof_values(displacement, local);
              matrix.cell_matrix(cell->level()).vmult(local_forces, local);
              cell->get_dof_indices(dofs);
              forces.add(dofs, local_forces);
            }
      }

      virtual void linearise(const ContactTangent<dim> &tangent,
                             const BodyFactors         &body) override
      {
        present      = tangent;
        present_body = body;
        matrix.set_tangent(tangent, body);
      }

      // The preconditioner of an earlier tangent serves as long as it is nearly
      // as good as it was for its own: making a new one costs many iterations.
      virtual unsigned int
      solve(Vector &x, const Vector &b, const double tolerance) override
      {
        Vector     residual(b);
        const auto iterate = [&]() {
          SolverControl control(preconditioner_is_usable ?
                                  origin.n_iterations + 10 :
                                  200,
                                tolerance);
          SolverGMRES<Vector> solver(
            control, typename SolverGMRES<Vector>::AdditionalData(50, true));
          x = 0.;
          solver.solve(matrix.matrix(), x, b, *preconditioner);

          // The factors of a singular tangent can deceive GMRES: ask the
          // matrix.
          matrix.matrix().vmult(residual, x);
          residual.sadd(-1., 1., b);
          const double norm = residual.l2_norm();
          if (!(norm <= 10. * tolerance))
            throw SolverControl::NoConvergence(control.last_step(), norm);
          return control.last_step();
        };

        if (preconditioner_is_usable)
          try
            {
              return iterate();
            }
          catch (const SolverControl::NoConvergence &)
            {
              preconditioner_is_usable = false;
            }

        try
          {
            preconditioner->initialize(matrix.matrix());
            origin                   = {present, present_body, iterate(), true};
            preconditioner_is_usable = true;
            return origin.n_iterations;
          }
        catch (const SolverControl::NoConvergence &failure)
          {
            std::ostringstream message;
            message << std::setprecision(2)
                    << (type == SolverType::direct ?
                          "the factors of the tangent do not solve with it" :
                          "algebraic multigrid did not converge")
                    << ": after " << failure.last_step
                    << " iterations the residual is "
                    << failure.last_residual / b.l2_norm()
                    << " of what it was first, " << tolerance / b.l2_norm()
                    << " were asked for";
            if (type == SolverType::direct)
              message << "; it is singular or nearly so";
            throw RunError(message.str());
          }
      }

      virtual PreconditionerOrigin<dim> preconditioner_origin() const override
      {
        return preconditioner_is_usable ? origin : PreconditionerOrigin<dim>();
      }

      virtual void
      make_preconditioner(const PreconditionerOrigin<dim> &earlier) override
      {
        matrix.set_tangent(earlier.tangent, earlier.body);
        preconditioner->initialize(matrix.matrix());
        origin                   = earlier;
        preconditioner_is_usable = true;
      }

    private:
      const SolverType       type;
      const DoFHandler<dim> &dof_handler;
      AssembledMatrix<dim>   matrix;

      std::unique_ptr<Preconditioner> preconditioner;
      bool                            preconditioner_is_usable = false;
      PreconditionerOrigin<dim>       origin;
      ContactTangent<dim>             present; // in the matrix
      BodyFactors                     present_body;
    };
  } // namespace



  template <int dim>
  std::unique_ptr<TangentSystem<dim>>
  make_assembled_system(const SolverType                 type,
                        const BlockParameters           &parameters,
                        const DoFHandler<dim>           &dof_handler,
                        const AffineConstraints<double> &constraints,
                        const IndexSet                  &relevant,
                        const Quadrature<dim - 1>       &face_quadrature)
  {
    return std::make_unique<AssembledSystem<dim>>(
      type, parameters, dof_handler, constraints, relevant, face_quadrature);
  }



  template std::unique_ptr<TangentSystem<2>>
  make_assembled_system(const SolverType,
                        const BlockParameters &,
                        const DoFHandler<2> &,
                        const AffineConstraints<double> &,
                        const IndexSet &,
                        const Quadrature<1> &);
  template std::unique_ptr<TangentSystem<3>>
  make_assembled_system(const SolverType,
                        const BlockParameters &,
                        const DoFHandler<3> &,
                        const AffineConstraints<double> &,
                        const IndexSet &,
                        const Quadrature<2> &);
} // namespace SlipStep
