// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_linear_solver_preconditioner_h
#define slipstep_solid_linear_solver_preconditioner_h

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <memory>

namespace SlipStep
{
  /// An approximate inverse of an assembled matrix.
  class Preconditioner
  {
  public:
    using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

    virtual ~Preconditioner() = default;

    /// Prepare for the present values of a matrix.
    virtual void
    initialize(const dealii::TrilinosWrappers::SparseMatrix &matrix) = 0;

    virtual void vmult(Vector &x, const Vector &b) const = 0;
  };

  /// A sparse factorisation (MUMPS), exact for the matrix it was made of.
  std::unique_ptr<Preconditioner> make_direct_preconditioner();

  /// Algebraic multigrid (ML, smoothed aggregation) which knows the rigid-body
  /// modes of the displacement field.
  template <int dim>
  std::unique_ptr<Preconditioner>
  make_amg_preconditioner(const dealii::DoFHandler<dim> &dof_handler);
} // namespace SlipStep

#endif
