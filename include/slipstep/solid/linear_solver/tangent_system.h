// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_linear_solver_tangent_system_h
#define slipstep_solid_linear_solver_tangent_system_h

#include <deal.II/lac/affine_constraints.h>

#include <slipstep/solid/contact_face.h>
#include <slipstep/solid/linear_solver/lumped_mass.h>

#include <memory>

namespace SlipStep
{
  /// What a preconditioner that outlives its Newton step was made of, so that
  /// the very same can be made again.
  template <int dim>
  struct PreconditionerOrigin
  {
    ContactTangent<dim> tangent;
    BodyFactors         body;
    /// Iterations that it took with its own tangent.
    unsigned int n_iterations = 0;
    bool         exists       = false;
  };

  /// The linear algebra of a Newton step: all that the time stepping needs to
  /// know of matrices and preconditioners.
  ///
  /// The bulk is linear elastic, so its stiffness K never changes on a mesh,
  /// nor does its mass M; the tangent of the contact face is added anew in
  /// every Newton step and makes the system unsymmetric.
  template <int dim>
  class TangentSystem
  {
  public:
    virtual ~TangentSystem() = default;

    /// Add K u to a vector which is then to be compressed. Constraints are not
    /// applied, so that the sum shows the reactions of the supports.
    /// @param displacement ghosted [mm]
    virtual void add_elastic_forces(const Vector &displacement,
                                    Vector       &forces) const = 0;

    /// Take over the tangent of the contact face, and what multiplies K and M.
    virtual void linearise(const ContactTangent<dim> &tangent,
                           const BodyFactors         &body = BodyFactors()) = 0;

    /// Solve (K + M + contact tangent) x = b, K and M times their factors, with
    /// homogeneous constraints, until
    /// the residual norm is below @p tolerance.
    /// @return number of iterations
    /// @throws RunError if that is not reached
    virtual unsigned int
    solve(Vector &x, const Vector &b, const double tolerance) = 0;

    /// Of operator and preconditioner on this rank [bytes]; 0 if not known.
    virtual std::size_t memory_consumption() const
    {
      return 0;
    }

    /// What later solutions owe to earlier ones: nothing, in a system that
    /// depends on the last tangent only.
    virtual PreconditionerOrigin<dim> preconditioner_origin() const
    {
      return {};
    }

    /// Make the preconditioner again that preconditioner_origin() told of.
    virtual void make_preconditioner(const PreconditionerOrigin<dim> &)
    {}
  };

  /// Assembled matrices of Trilinos and GMRES.
  /// @param type direct or amg
  /// @param constraints homogeneous
  template <int dim>
  std::unique_ptr<TangentSystem<dim>>
  make_assembled_system(const SolverType                         type,
                        const BlockParameters                   &parameters,
                        const dealii::DoFHandler<dim>           &dof_handler,
                        const dealii::AffineConstraints<double> &constraints,
                        const dealii::IndexSet                  &relevant,
                        const dealii::Quadrature<dim - 1> &face_quadrature);

  /// Matrix-free products, geometric multigrid and conjugate residuals.
  /// @param constraints homogeneous
  template <int dim>
  std::unique_ptr<TangentSystem<dim>>
  make_multigrid_system(const BlockParameters                   &parameters,
                        const dealii::DoFHandler<dim>           &dof_handler,
                        const dealii::AffineConstraints<double> &constraints);
} // namespace SlipStep

#endif
