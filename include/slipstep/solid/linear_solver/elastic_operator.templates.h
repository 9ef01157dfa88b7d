// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_linear_solver_elastic_operator_templates_h
#define slipstep_solid_linear_solver_elastic_operator_templates_h

#include <slipstep/solid/linear_solver/elastic_operator.h>

namespace SlipStep
{
  template <int dim, int degree, typename Number, typename Simd>
  ElasticOperator<dim, degree, Number, Simd>::ElasticOperator(
    const BlockParameters                   &parameters,
    const dealii::DoFHandler<dim>           &dof_handler,
    const dealii::AffineConstraints<Number> &constraints,
    const bool                               with_plain_product)
    : parameters(parameters)
    , n_unknowns(dof_handler.n_dofs())
    , with_plain_product(with_plain_product)
    , lambda(parameters.lame_lambda())
    , mu(parameters.shear_modulus())
    , density(parameters.density)
  {
    const auto                   &mesh = dof_handler.get_triangulation();
    typename Data::AdditionalData settings;
    settings.tasks_parallel_scheme = Data::AdditionalData::none;
    settings.mapping_update_flags =
      dealii::update_gradients | dealii::update_JxW_values;
    settings.cell_vectorization_category.resize(mesh.n_active_cells());
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        settings.cell_vectorization_category[cell->active_cell_index()] =
          cell->at_boundary(parameters.contact_face);

    const dealii::AffineConstraints<Number>      none;
    std::vector<const dealii::DoFHandler<dim> *> dof_handlers{&dof_handler};
    std::vector<const dealii::AffineConstraints<Number> *> all_constraints{
      &constraints};
    if (with_plain_product)
      {
        dof_handlers.push_back(&dof_handler);
        all_constraints.push_back(&none);
      }
    matrix_free.reinit(dealii::MappingQ1<dim>(),
                       dof_handlers,
                       all_constraints,
                       std::vector<dealii::QGauss<1>>{dealii::QGauss<1>(n_1d)},
                       settings);
    forget_categories(dof_handlers.size());
    nodes = find_nodes(constraints, 0);
    if (with_plain_product)
      plain_nodes = find_nodes(none, 1);
    if (plain_nodes == nodes)
      plain_nodes = NodeTable();
    find_contact_cells();
    find_face_nodes();

    const auto &fe     = dof_handler.get_fe();
    const auto  shares = shares_of_mass(fe);
    const auto  hierarchic =
      dealii::FETools::lexicographic_to_hierarchic_numbering<dim>(degree);
    for (const unsigned int node : hierarchic)
      mass_shares.push_back(shares[fe.component_to_system_index(0, node)]);
  }



  template <int dim, int degree, typename Number, typename Simd>
  typename ElasticOperator<dim, degree, Number, Simd>::NodeTable
  ElasticOperator<dim, degree, Number, Simd>::find_nodes(
    const dealii::AffineConstraints<Number> &constraints,
    const unsigned int                       index) const
  {
    NodeTable table;
    table.start_of_batch.assign(matrix_free.n_cell_batches(),
                                dealii::numbers::invalid_unsigned_int);
    if (dim != 3)
      return table;
    for (unsigned int batch = 0; batch < table.start_of_batch.size(); ++batch)
      {
        const unsigned int start = table.offsets.size();
        if (append_nodes(batch, constraints, index, table.offsets))
          table.start_of_batch[batch] = start;
        else
          table.offsets.resize(start);
      }
    return table;
  }



  // Four numbers are loaded and stored per node, for which there must be room.
  // Supported unknowns need no care: they are zero when read, and what is added
  // to them is not used. At hanging nodes the library reads and writes other
  // unknowns, those of the coarse side, even without constraints; its loops
  // set entries to zero and communicate accordingly.
  template <int dim, int degree, typename Number, typename Simd>
  bool ElasticOperator<dim, degree, Number, Simd>::append_nodes(
    const unsigned int                       batch,
    const dealii::AffineConstraints<Number> &constraints,
    const unsigned int                       index,
    std::vector<unsigned int>               &offsets) const
  {
    const unsigned int n_lanes = Simd::size();
    if (matrix_free.n_active_entries_per_cell_batch(batch) < n_lanes)
      return false;
    const auto &masks =
      matrix_free.get_dof_info(index).hanging_node_constraint_masks;
    for (unsigned int lane = 0; lane < n_lanes && !masks.empty(); ++lane)
      if (masks[batch * n_lanes + lane] !=
          dealii::internal::MatrixFreeFunctions::
            unconstrained_compressed_constraint_kind)
        return false;

    const auto &partitioner = *matrix_free.get_vector_partitioner(index);
    const auto &fe          = matrix_free.get_dof_handler().get_fe();
    const auto  hierarchic =
      dealii::FETools::lexicographic_to_hierarchic_numbering<dim>(degree);
    const unsigned int n_owned  = partitioner.locally_owned_size();
    const unsigned int n_stored = n_owned + partitioner.n_ghost_indices();
    std::vector<dealii::types::global_dof_index> dofs(fe.dofs_per_cell);

    const unsigned int start = offsets.size();
    offsets.resize(start + hierarchic.size() * n_lanes);
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      {
        matrix_free.get_cell_iterator(batch, lane)->get_dof_indices(dofs);
        for (unsigned int i = 0; i < hierarchic.size(); ++i)
          {
            unsigned int first = 0;
            for (unsigned int d = 0; d < dim; ++d)
              {
                const auto dof =
                  dofs[fe.component_to_system_index(d, hierarchic[i])];
                if (!(partitioner.in_local_range(dof) ||
                      partitioner.is_ghost_entry(dof)))
                  return false;
                const unsigned int place = partitioner.global_to_local(dof);
                if (d == 0)
                  first = place;
                const auto *entries = constraints.get_constraint_entries(dof);
                if (place != first + d ||
                    (entries != nullptr && !entries->empty()))
                  return false;
              }
            if (first + 4 > (first < n_owned ? n_owned : n_stored))
              return false;
            offsets[start + i * n_lanes + lane] = first;
          }
      }
    return true;
  }



  template <int dim, int degree, typename Number, typename Simd>
  void
  ElasticOperator<dim, degree, Number, Simd>::read(Evaluator        &cell,
                                                   const VectorType &src,
                                                   const NodeTable &table) const
  {
    constexpr unsigned int n = Evaluator::static_dofs_per_component;
    const unsigned int     start =
      table.start_of_batch[cell.get_current_cell_index()];
    if (start == dealii::numbers::invalid_unsigned_int)
      return cell.read_dof_values(src);
    Simd                entries[4];
    Simd               *values  = cell.begin_dof_values();
    const unsigned int *offsets = &table.offsets[start];
    for (unsigned int i = 0; i < n; ++i, offsets += Simd::size())
      {
        dealii::vectorized_load_and_transpose(4, src.begin(), offsets, entries);
        for (unsigned int d = 0; d < dim; ++d)
          values[d * n + i] = entries[d];
      }
  }



  template <int dim, int degree, typename Number, typename Simd>
  void ElasticOperator<dim, degree, Number, Simd>::add_to(
    VectorType      &dst,
    Evaluator       &cell,
    const NodeTable &table) const
  {
    constexpr unsigned int n = Evaluator::static_dofs_per_component;
    const unsigned int     start =
      table.start_of_batch[cell.get_current_cell_index()];
    if (start == dealii::numbers::invalid_unsigned_int)
      return cell.distribute_local_to_global(dst);
    Simd                entries[4];
    const Simd         *values  = cell.begin_dof_values();
    const unsigned int *offsets = &table.offsets[start];
    entries[3]                  = Simd();
    for (unsigned int i = 0; i < n; ++i, offsets += Simd::size())
      {
        for (unsigned int d = 0; d < dim; ++d)
          entries[d] = values[d * n + i];
        dealii::vectorized_transpose_and_store(
          true, 4, entries, offsets, dst.begin());
      }
  }



  template <int dim, int degree, typename Number, typename Simd>
  void ElasticOperator<dim, degree, Number, Simd>::find_contact_cells()
  {
    const unsigned int        face = parameters.contact_face;
    std::vector<unsigned int> face_of_cell(
      matrix_free.get_dof_handler().get_triangulation().n_active_cells());
    unsigned int n_faces = 0;
    for (const auto &cell :
         matrix_free.get_dof_handler().active_cell_iterators())
      if (cell->is_locally_owned() && cell->at_boundary(face))
        face_of_cell[cell->active_cell_index()] = n_faces++;

    slot_of_batch.assign(matrix_free.n_cell_batches(),
                         dealii::numbers::invalid_unsigned_int);
    place_of_face.resize(n_faces);
    for (unsigned int batch = 0; batch < slot_of_batch.size(); ++batch)
      for (unsigned int lane = 0;
           lane < matrix_free.n_active_entries_per_cell_batch(batch);
           ++lane)
        {
          const auto cell = matrix_free.get_cell_iterator(batch, lane);
          if (!cell->at_boundary(face))
            continue;
          if (slot_of_batch[batch] == dealii::numbers::invalid_unsigned_int)
            slot_of_batch[batch] = n_slots++;
          place_of_face[face_of_cell[cell->active_cell_index()]] = {
            slot_of_batch[batch], lane, cell->face(face)->measure()};
        }
    tangents.resize(n_slots * n_face);
  }



  template <int dim, int degree, typename Number, typename Simd>
  void ElasticOperator<dim, degree, Number, Simd>::find_face_nodes()
  {
    const auto basis = dealii::Polynomials::generate_complete_Lagrange_basis(
      dealii::QGaussLobatto<1>(n_1d).get_points());
    const dealii::QGauss<1> points(n_1d);
    for (unsigned int q = 0; q < n_1d; ++q)
      for (unsigned int i = 0; i < n_1d; ++i)
        shape[q][i] = basis[i].value(points.point(q)[0]);

    const unsigned int normal = parameters.normal_axis();
    for (unsigned int i = 0; i < n_face; ++i)
      {
        unsigned int node = parameters.outward_sign() > 0. ?
                              degree * dealii::Utilities::pow(n_1d, normal) :
                              0;
        for (unsigned int d = 0, rest = i; d < dim - 1; ++d, rest /= n_1d)
          node += rest % n_1d *
                  dealii::Utilities::pow(n_1d, parameters.tangential_axis(d));
        face_nodes[i] = node;
      }
    lexicographic = lexicographic_face_points<dim>(n_1d, parameters);
  }



  template <int dim, int degree, typename Number, typename Simd>
  void ElasticOperator<dim, degree, Number, Simd>::set_contact(
    const ContactTangent<dim> &tangent,
    const bool                 for_smoother)
  {
    tangents.clear();
    tangents.resize(n_slots * n_face);
    definite_tangents.clear();
    definite_tangents.resize(for_smoother ? tangents.size() : 0);
    const dealii::QGauss<dim - 1> quadrature(n_1d);
    const auto                    set = [](Matrix                       &matrix,
                        const unsigned int            lane,
                        const dealii::Tensor<2, dim> &value) {
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          matrix[i][j][lane] = value[i][j];
    };
    for (unsigned int f = 0; f < tangent.size(); ++f)
      {
        const Place &place = place_of_face[f];
        for (unsigned int q = 0; q < n_face; ++q)
          {
            const auto value =
              tangent[f].values[q] * (quadrature.weight(q) * place.area);
            const unsigned int i = place.slot * n_face + lexicographic[q];
            set(tangents[i], place.lane, value);
            if (for_smoother)
              set(definite_tangents[i],
                  place.lane,
                  definite_part(value, parameters.normal_axis()));
          }
      }
  }



  template <int dim, int degree, typename Number, typename Simd>
  typename ElasticOperator<dim, degree, Number, Simd>::LoopOverCells
  ElasticOperator<dim, degree, Number, Simd>::product_with(
    const Tangents &contact) const
  {
    return [this, &contact](const Data &,
                            VectorType       &dst,
                            const VectorType &src,
                            const Range      &range) {
      apply_to_cells(dst, src, range, contact);
    };
  }



  template <int dim, int degree, typename Number, typename Simd>
  void
  ElasticOperator<dim, degree, Number, Simd>::vmult(VectorType       &dst,
                                                    const VectorType &src) const
  {
    matrix_free.cell_loop(product_with(tangents_of_products()), dst, src, true);
    for (const unsigned int i : matrix_free.get_constrained_dofs())
      dst.local_element(i) = src.local_element(i);
  }



  template <int dim, int degree, typename Number, typename Simd>
  void ElasticOperator<dim, degree, Number, Simd>::vmult(
    VectorType            &dst,
    const VectorType      &src,
    const LoopOverEntries &before,
    const LoopOverEntries &after) const
  {
    matrix_free.cell_loop(
      product_with(tangents_of_products()), dst, src, before, after);
  }



  template <int dim, int degree, typename Number, typename Simd>
  void ElasticOperator<dim, degree, Number, Simd>::residual(
    VectorType       &dst,
    const VectorType &src,
    const VectorType &b) const
  {
    const auto set_zero = [&](const unsigned int begin,
                              const unsigned int end) {
      std::fill(dst.begin() + begin, dst.begin() + end, Number());
    };
    const auto subtract_from_b = [&](const unsigned int begin,
                                     const unsigned int end) {
      for (unsigned int i = begin; i < end; ++i)
        dst.local_element(i) = b.local_element(i) - dst.local_element(i);
    };
    matrix_free.cell_loop(
      product_with(tangents), dst, src, set_zero, subtract_from_b);
    for (const unsigned int i : matrix_free.get_constrained_dofs())
      dst.local_element(i) = 0.;
  }



  template <int dim, int degree, typename Number, typename Simd>
  void ElasticOperator<dim, degree, Number, Simd>::apply_to_cells(
    VectorType       &dst,
    const VectorType &src,
    const Range      &range,
    const Tangents   &contact) const
  {
    constexpr unsigned int     n_values = Evaluator::static_dofs_per_cell;
    Evaluator                  cell(matrix_free);
    FaceField                  field;
    std::array<Simd, n_values> inertia;
    for (unsigned int batch = range.first; batch < range.second; ++batch)
      {
        cell.reinit(batch);
        read(cell, src, nodes);
        const unsigned int slot = slot_of_batch[batch];
        const bool touches      = slot != dealii::numbers::invalid_unsigned_int;
        if (touches)
          {
            read_face(cell, field);
            apply_contact(&contact[slot * n_face], field);
          }
        if (body.inertia > 0.)
          multiply_by_mass(cell,
                           cell.begin_dof_values(),
                           body.inertia,
                           inertia.data());
        add_elastic(cell, body.stiffness);
        if (body.inertia > 0.)
          for (unsigned int i = 0; i < n_values; ++i)
            cell.begin_dof_values()[i] += inertia[i];
        if (touches)
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int i = 0; i < n_face; ++i)
              cell.begin_dof_values()[d * Evaluator::static_dofs_per_component +
                                      face_nodes[i]] += field[i][d];
        add_to(dst, cell, nodes);
      }
  }



  // sigma = lambda tr(eps) 1 + 2 mu eps, in 2-D plane strain. All cells are
  // boxes along the axes, so gradients are scaled by a number per direction;
  // done here, that takes less than half of the time that it takes through the
  // tensors of the library, which go by way of memory.
  template <int dim, int degree, typename Number, typename Simd>
  void ElasticOperator<dim, degree, Number, Simd>::add_elastic(
    Evaluator   &cell,
    const Number factor) const
  {
    cell.evaluate(dealii::EvaluationFlags::gradients);
    constexpr unsigned int n         = Evaluator::static_n_q_points;
    const auto             jacobian  = cell.inverse_jacobian(0);
    Simd *const            gradients = cell.begin_gradients();
    for (unsigned int q = 0; q < n; ++q)
      {
        const auto gradient = [&](const unsigned int i,
                                  const unsigned int d) -> Simd & {
          return gradients[(i * dim + d) * n + q];
        };
        const Simd weight = (factor * mu) * cell.JxW(q);
        Simd       trace  = Simd();
        for (unsigned int d = 0; d < dim; ++d)
          trace += gradient(d, d) * jacobian[d][d];
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int e = d; e < dim; ++e)
            {
              Simd stress = gradient(d, e) * jacobian[e][e] +
                            gradient(e, d) * jacobian[d][d];
              if (d == e)
                stress += (lambda / mu) * trace;
              stress *= weight;
              gradient(d, e) = stress * jacobian[e][e];
              gradient(e, d) = stress * jacobian[d][d];
            }
      }
    cell.integrate(dealii::EvaluationFlags::gradients);
  }



  // Of a box the volume is the weight of a point over that in the unit cell.
  template <int dim, int degree, typename Number, typename Simd>
  void ElasticOperator<dim, degree, Number, Simd>::multiply_by_mass(
    const Evaluator &cell,
    const Simd      *values,
    const Number     factor,
    Simd            *products) const
  {
    const Number unit_weight =
      dealii::Utilities::fixed_power<dim>(dealii::QGauss<1>(n_1d).weight(0));
    const Simd mass = (factor * density / unit_weight) * cell.JxW(0);
    for (unsigned int d = 0, i = 0; d < dim; ++d)
      for (const Number share : mass_shares)
        {
          products[i] = share * mass * values[i];
          ++i;
        }
  }



  template <int dim, int degree, typename Number, typename Simd>
  void
  ElasticOperator<dim, degree, Number, Simd>::read_face(const Evaluator &cell,
                                                        FaceField &values) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int i = 0; i < n_face; ++i)
        values[i][d] =
          cell.begin_dof_values()[d * Evaluator::static_dofs_per_component +
                                  face_nodes[i]];
  }



  // From nodal displacements to nodal forces.
  template <int dim, int degree, typename Number, typename Simd>
  void ElasticOperator<dim, degree, Number, Simd>::apply_contact(
    const Matrix *tangents,
    FaceField    &field) const
  {
    interpolate<false>(field);
    for (unsigned int q = 0; q < n_face; ++q)
      field[q] = tangents[q] * field[q];
    interpolate<true>(field);
  }



  // Along one direction of the face after the other: from nodes to points, or
  // transposed.
  template <int dim, int degree, typename Number, typename Simd>
  template <bool transpose>
  void ElasticOperator<dim, degree, Number, Simd>::interpolate(
    FaceField &field) const
  {
    for (unsigned int direction = 0, stride = 1; direction < dim - 1;
         ++direction, stride *= n_1d)
      for (unsigned int line = 0; line < n_face / n_1d; ++line)
        {
          const unsigned int start = direction == 0 ? line * n_1d : line;
          std::array<dealii::Tensor<1, dim, Simd>, n_1d> in;
          for (unsigned int i = 0; i < n_1d; ++i)
            in[i] = field[start + i * stride];
          for (unsigned int j = 0; j < n_1d; ++j)
            {
              dealii::Tensor<1, dim, Simd> sum;
              for (unsigned int i = 0; i < n_1d; ++i)
                sum += Simd(transpose ? shape[i][j] : shape[j][i]) * in[i];
              field[start + j * stride] = sum;
            }
        }
  }



  template <int dim, int degree, typename Number, typename Simd>
  void ElasticOperator<dim, degree, Number, Simd>::plain_vmult(
    VectorType       &dst,
    const VectorType &src) const
  {
    const LoopOverCells apply = [this](const Data &,
                                       VectorType       &dst,
                                       const VectorType &src,
                                       const Range      &range) {
      Evaluator cell(matrix_free, 1);
      for (unsigned int batch = range.first; batch < range.second; ++batch)
        {
          cell.reinit(batch);
          read(cell, src, nodes_without_constraints());
          add_elastic(cell, 1.);
          add_to(dst, cell, nodes_without_constraints());
        }
    };
    matrix_free.cell_loop(apply, dst, src, true);
  }



  template <int dim, int degree, typename Number, typename Simd>
  void ElasticOperator<dim, degree, Number, Simd>::release_setup_data()
  {
    forget_unknowns(nodes, 0);
    if (with_plain_product)
      forget_unknowns(nodes_without_constraints(), 1);
  }



  // The library keeps categories where it keeps the elements of hp methods, and
  // its checks would take cells of two categories for cells of two elements.
  template <int dim, int degree, typename Number, typename Simd>
  void ElasticOperator<dim, degree, Number, Simd>::forget_categories(
    const unsigned int n_dof_handlers)
  {
    using DoFInfo = dealii::internal::MatrixFreeFunctions::DoFInfo;
    for (unsigned int i = 0; i < n_dof_handlers; ++i)
      const_cast<DoFInfo &>(matrix_free.get_dof_info(i))
        .cell_active_fe_index.clear();
  }



  // The library keeps the unknowns of all cells twice, in the order of cells
  // and of lanes. The second is not read for the batches that are left here.
  template <int dim, int degree, typename Number, typename Simd>
  void ElasticOperator<dim, degree, Number, Simd>::forget_unknowns(
    const NodeTable   &table,
    const unsigned int index)
  {
    using DoFInfo = dealii::internal::MatrixFreeFunctions::DoFInfo;
    auto &info    = const_cast<DoFInfo &>(matrix_free.get_dof_info(index));
    const unsigned int invalid = dealii::numbers::invalid_unsigned_int;
    const unsigned int rows_of_batch =
      Simd::size() * info.start_components.back();
    std::vector<unsigned int> kept;
    for (unsigned int batch = 0; batch < table.start_of_batch.size(); ++batch)
      if (table.start_of_batch[batch] == invalid &&
          info.index_storage_variants[DoFInfo::dof_access_cell][batch] !=
            DoFInfo::IndexStorageVariants::full)
        return;
    for (unsigned int row = 0; row + 1 < info.row_starts.size(); ++row)
      {
        const auto begin =
          info.dof_indices.begin() + info.row_starts[row].first;
        const auto end =
          info.dof_indices.begin() + info.row_starts[row + 1].first;
        info.row_starts[row].first = kept.size();
        const unsigned int batch   = row / rows_of_batch;
        if (batch >= table.start_of_batch.size() ||
            table.start_of_batch[batch] == invalid)
          kept.insert(kept.end(), begin, end);
      }
    info.row_starts.back().first = kept.size();
    kept.shrink_to_fit();
    info.dof_indices.swap(kept);
    std::vector<unsigned int>().swap(info.dof_indices_interleaved);
  }
} // namespace SlipStep

#include <slipstep/solid/linear_solver/operator_diagonal.templates.h>

#endif
