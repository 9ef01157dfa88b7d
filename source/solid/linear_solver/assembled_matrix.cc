// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/linear_solver/assembled_matrix.h>

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_values.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

namespace SlipStep
{
  using namespace dealii;



  template <int dim>
  AssembledMatrix<dim>::AssembledMatrix(
    const BlockParameters           &parameters,
    const DoFHandler<dim>           &dof_handler,
    const AffineConstraints<double> &constraints,
    const IndexSet                  &relevant,
    const Quadrature<dim - 1>       &face_quadrature)
    : parameters(parameters)
    , dof_handler(dof_handler)
    , constraints(constraints)
    , face_quadrature(face_quadrature)
  {
    compute_cell_matrices();
    make_sparsity(relevant);
    assemble_elastic_matrix();
    if (parameters.is_dynamic())
      assemble_mass();
  }



  // K_ij = int lambda div(phi_i) div(phi_j) + 2 mu eps(phi_i) : eps(phi_j),
  // in 2-D plane strain.
  template <int dim>
  void AssembledMatrix<dim>::compute_cell_matrices()
  {
    const double lambda = parameters.lame_lambda();
    const double mu     = parameters.shear_modulus();

    const FiniteElement<dim>        &fe = dof_handler.get_fe();
    const QGauss<dim>                quadrature(fe.degree + 1);
    const FEValuesExtractors::Vector displacements(0);
    FEValues<dim>                    fe_values(fe,
                            quadrature,
                            update_gradients | update_JxW_values);
    const unsigned int               n = fe.dofs_per_cell;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() &&
          cell_matrix_of_level.count(cell->level()) == 0)
        {
          fe_values.reinit(cell);
          FullMatrix<double> cell_matrix(n, n);
          for (const unsigned int q : fe_values.quadrature_point_indices())
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int j = 0; j < n; ++j)
                cell_matrix(i, j) +=
                  (lambda * fe_values[displacements].divergence(i, q) *
                     fe_values[displacements].divergence(j, q) +
                   2. * mu *
                     (fe_values[displacements].symmetric_gradient(i, q) *
                      fe_values[displacements].symmetric_gradient(j, q))) *
                  fe_values.JxW(q);
          cell_matrix_of_level[cell->level()] = cell_matrix;
        }
  }



  template <int dim>
  void AssembledMatrix<dim>::make_sparsity(const IndexSet &relevant)
  {
    const MPI_Comm         communicator = dof_handler.get_communicator();
    const IndexSet        &owned        = dof_handler.locally_owned_dofs();
    DynamicSparsityPattern sparsity(relevant);
    DoFTools::make_sparsity_pattern(dof_handler, sparsity, constraints, false);
    SparsityTools::distribute_sparsity_pattern(sparsity,
                                               owned,
                                               communicator,
                                               relevant);
    elastic.reinit(owned, owned, sparsity, communicator);
  }



  template <int dim>
  void AssembledMatrix<dim>::assemble_elastic_matrix()
  {
    std::vector<types::global_dof_index> dofs(
      dof_handler.get_fe().dofs_per_cell);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell->get_dof_indices(dofs);
          constraints.distribute_local_to_global(
            cell_matrix_of_level.at(cell->level()), dofs, elastic);
        }
    elastic.compress(VectorOperation::add);
    sum.reinit(elastic);
  }



  // Where nodes hang it is not diagonal.
  template <int dim>
  void AssembledMatrix<dim>::assemble_mass()
  {
    mass.reinit(elastic);
    const auto         shares = shares_of_mass(dof_handler.get_fe());
    const unsigned int n      = shares.size();
    FullMatrix<double> cell_mass(n, n);
    std::vector<types::global_dof_index> dofs(n);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          for (unsigned int i = 0; i < n; ++i)
            cell_mass(i, i) = parameters.density * cell->measure() * shares[i];
          cell->get_dof_indices(dofs);
          constraints.distribute_local_to_global(cell_mass, dofs, mass);
        }
    mass.compress(VectorOperation::add);
  }



  template <int dim>
  void AssembledMatrix<dim>::set_tangent(const ContactTangent<dim> &tangent,
                                         const BodyFactors         &body)
  {
    sum.copy_from(elastic);
    if (body.stiffness != 1.)
      sum *= body.stiffness;
    if (body.inertia > 0.)
      sum.add(body.inertia, mass);
    add_contact(tangent);
    sum.compress(VectorOperation::add);
  }



  template <int dim>
  void AssembledMatrix<dim>::add_contact(const ContactTangent<dim> &tangent)
  {
    const FiniteElement<dim>            &fe = dof_handler.get_fe();
    FEFaceValues<dim>                    fe_values(fe,
                                face_quadrature,
                                update_values | update_JxW_values);
    const unsigned int                   n = fe.dofs_per_cell;
    FullMatrix<double>                   local(n, n);
    std::vector<types::global_dof_index> dofs(n);
    for (const FaceTangent<dim> &face : tangent)
      {
        const typename DoFHandler<dim>::active_cell_iterator cell(
          &dof_handler.get_triangulation(),
          face.cell->level(),
          face.cell->index(),
          &dof_handler);
        fe_values.reinit(cell, parameters.contact_face);
        local = 0.;
        for (unsigned int q = 0; q < face.values.size(); ++q)
          for (unsigned int i = 0; i < n; ++i)
            if (const double phi_i = fe_values.shape_value(i, q))
              for (unsigned int j = 0; j < n; ++j)
                local(i, j) +=
                  phi_i *
                  face.values[q][fe.system_to_component_index(i).first]
                             [fe.system_to_component_index(j).first] *
                  fe_values.shape_value(j, q) * fe_values.JxW(q);
        cell->get_dof_indices(dofs);
        constraints.distribute_local_to_global(local, dofs, sum);
      }
  }



  template class AssembledMatrix<2>;
  template class AssembledMatrix<3>;
} // namespace SlipStep
