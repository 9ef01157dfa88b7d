// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_linear_solver_operator_diagonal_templates_h
#define slipstep_solid_linear_solver_operator_diagonal_templates_h

#include <slipstep/solid/linear_solver/elastic_operator.h>

// What the smoothers of ElasticOperator need: its diagonal.
namespace SlipStep
{
  template <int dim, int degree, typename Number, typename Simd>
  void ElasticOperator<dim, degree, Number, Simd>::compute_diagonals()
  {
    initialize_dof_vector(elastic_diagonal);
    const std::function<void(Evaluator &)> apply = [this](Evaluator &cell) {
      add_elastic(cell, 1.);
    };
    dealii::MatrixFreeTools::compute_diagonal(matrix_free,
                                              elastic_diagonal,
                                              apply);
    if (!(density > 0.))
      return;
    initialize_dof_vector(mass_diagonal);
    const std::function<void(Evaluator &)> multiply = [this](Evaluator &cell) {
      multiply_by_mass(cell,
                       cell.begin_dof_values(),
                       1.,
                       cell.begin_dof_values());
    };
    dealii::MatrixFreeTools::compute_diagonal(matrix_free,
                                              mass_diagonal,
                                              multiply);
  }



  // Of node i of a face. The entries C_ii alone would not bound the eigenvalues
  // of D^-1 C: with one closed point in a face that is open otherwise they grow
  // to the number of nodes. With rows of sum_j |C_ij| <= lambda D_ii they are
  // at most lambda, as Gershgorin says, and so are those of D^-1 (K + C) if
  // lambda bounds those of the elastic part.
  template <int dim, int degree, typename Number, typename Simd>
  dealii::Tensor<1, dim, Simd>
  ElasticOperator<dim, degree, Number, Simd>::diagonal_of_contact(
    const Matrix      *tangents,
    const unsigned int i,
    const Number       lambda) const
  {
    dealii::Tensor<1, dim, Simd> diagonal, row;
    for (unsigned int q = 0; q < n_face; ++q)
      {
        Number own = 1., all = 1.; // phi_i and sum_j |phi_j|
        for (unsigned int d = 0, j = i, p = q; d < dim - 1;
             ++d, j /= n_1d, p /= n_1d)
          {
            own *= shape[p % n_1d][j % n_1d];
            Number sum = 0.;
            for (const Number value : shape[p % n_1d])
              sum += std::abs(value);
            all *= sum;
          }
        for (unsigned int d = 0; d < dim; ++d)
          {
            diagonal[d] += own * own * tangents[q][d][d];
            for (unsigned int e = 0; e < dim; ++e)
              row[d] += std::abs(own) * all * std::abs(tangents[q][d][e]);
          }
      }
    for (unsigned int d = 0; d < dim; ++d)
      diagonal[d] = std::max(diagonal[d], row[d] / lambda);
    return diagonal;
  }



  // Where nodes hang, the share of the contact part is not exact, which is good
  // enough for a smoother.
  template <int dim, int degree, typename Number, typename Simd>
  void ElasticOperator<dim, degree, Number, Simd>::get_inverse_diagonal(
    VectorType  &inverse,
    const Number largest_eigenvalue) const
  {
    inverse                         = 0.;
    const Tangents     &contact     = tangents_of_products();
    const LoopOverCells add_contact = [&](const Data &,
                                          VectorType &dst,
                                          const VectorType &,
                                          const Range &range) {
      Evaluator cell(matrix_free);
      for (unsigned int batch = range.first; batch < range.second; ++batch)
        {
          const unsigned int slot = slot_of_batch[batch];
          if (slot == dealii::numbers::invalid_unsigned_int)
            continue;
          cell.reinit(batch);
          for (unsigned int i = 0; i < Evaluator::static_dofs_per_cell; ++i)
            cell.begin_dof_values()[i] = Simd();
          for (unsigned int i = 0; i < n_face; ++i)
            {
              const auto entries = diagonal_of_contact(&contact[slot * n_face],
                                                       i,
                                                       largest_eigenvalue);
              for (unsigned int d = 0; d < dim; ++d)
                cell
                  .begin_dof_values()[d * Evaluator::static_dofs_per_component +
                                      face_nodes[i]] = entries[d];
            }
          add_to(dst, cell, nodes);
        }
    };
    matrix_free.cell_loop(add_contact, inverse, elastic_diagonal);
    inverse.add(body.stiffness, elastic_diagonal);
    if (body.inertia > 0.)
      inverse.add(body.inertia, mass_diagonal);
    for (unsigned int i = 0; i < inverse.locally_owned_size(); ++i)
      {
        Number &entry = inverse.local_element(i);
        entry         = entry > 0. ? 1. / entry : 1.;
      }
    for (const unsigned int i : matrix_free.get_constrained_dofs())
      inverse.local_element(i) = 0.;
  }
} // namespace SlipStep

#endif
