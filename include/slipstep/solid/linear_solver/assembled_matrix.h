// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_linear_solver_assembled_matrix_h
#define slipstep_solid_linear_solver_assembled_matrix_h

#include <deal.II/base/quadrature.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <slipstep/solid/block_parameters.h>
#include <slipstep/solid/contact_tangent.h>
#include <slipstep/solid/linear_solver/lumped_mass.h>

#include <map>

namespace SlipStep
{
  /// Stiffness and mass of the block plus tangent of the contact face,
  /// assembled.
  ///
  /// The bulk is linear elastic, so its parts are assembled once per mesh.
  template <int dim>
  class AssembledMatrix
  {
  public:
    /// @param constraints homogeneous
    /// @param relevant unknowns that this rank must know
    /// @param face_quadrature at whose points contact tangents are given
    AssembledMatrix(const BlockParameters                   &parameters,
                    const dealii::DoFHandler<dim>           &dof_handler,
                    const dealii::AffineConstraints<double> &constraints,
                    const dealii::IndexSet                  &relevant,
                    const dealii::Quadrature<dim - 1>       &face_quadrature);

    /// Replace the contact part and what multiplies the others.
    void set_tangent(const ContactTangent<dim> &tangent,
                     const BodyFactors         &body = BodyFactors());

    const dealii::TrilinosWrappers::SparseMatrix &matrix() const
    {
      return sum;
    }

    /// Stiffness of a cell without constraints; cells of a box are copies of
    /// each other up to their level.
    const dealii::FullMatrix<double> &cell_matrix(const int level) const
    {
      return cell_matrix_of_level.at(level);
    }

  private:
    void compute_cell_matrices();
    void make_sparsity(const dealii::IndexSet &relevant);
    void assemble_elastic_matrix();
    void assemble_mass();
    void add_contact(const ContactTangent<dim> &tangent);

    const BlockParameters                     parameters;
    const dealii::DoFHandler<dim>            &dof_handler;
    const dealii::AffineConstraints<double>  &constraints;
    const dealii::Quadrature<dim - 1>         face_quadrature;
    std::map<int, dealii::FullMatrix<double>> cell_matrix_of_level;
    dealii::TrilinosWrappers::SparseMatrix    elastic, mass, sum;
  };
} // namespace SlipStep

#endif
