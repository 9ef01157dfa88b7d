// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/block.h>

#include <slipstep/solid/supports.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_values.h>

#include <deal.II/grid/grid_generator.h>

#include <algorithm>

namespace SlipStep
{
  using namespace dealii;

  // @sect3{Mesh and unknowns}

  // Geometric multigrid needs coarser meshes: so the subdivisions asked for are
  // halved as often as all of them are even, and the mesh is refined as often.
  // Faces are numbered as deal.II does (left, right, ...), which is also how
  // the case file's conditions are stored.
  template <int dim>
  void Block<dim>::make_grid()
  {
    Point<dim>                upper;
    std::vector<unsigned int> subdivisions(dim);
    for (unsigned int d = 0; d < dim; ++d)
      {
        upper[d]        = parameters.size[d];
        subdivisions[d] = parameters.subdivisions[d];
      }
    const auto is_even = [](const unsigned int n) { return n % 2 == 0; };
    for (; all_of(subdivisions, is_even); ++least_level)
      for (unsigned int &n : subdivisions)
        n /= 2;
    GridGenerator::subdivided_hyper_rectangle(
      triangulation, subdivisions, Point<dim>(), upper, true);
    triangulation.refine_global(
      least_level + (parameters.refinement.type == RefinementType::uniform ?
                       parameters.refinement.levels :
                       0));
  }



  // All that depends on the mesh. Contact points are fresh and displacements
  // zero afterwards.
  template <int dim>
  void Block<dim>::setup_system()
  {
    system.reset();
    setup_unknowns();
    find_supports();
    find_groups_of_unknowns();
    find_driven_unknowns();
    contact.reinit(dof_handler);
    check_map_of_strength();
    assemble_loads();
    choose_solver();
  }



  // What is narrower than their distance may lie between contact points.
  template <int dim>
  void Block<dim>::check_map_of_strength()
  {
    if (!parameters.surface.has_map_of_strength())
      return;
    double sum = 0.;
    for (const auto &cell_face : contact.cell_faces())
      for (const auto &point : cell_face.points)
        sum += point.JxW * point.point.committed().strength_factor;
    const double mean = Utilities::MPI::sum(sum, communicator) /
                        parameters.nominal_contact_area();
    const GapAndStrength &surface = parameters.surface;
    strength_error                = mean / surface.mean_strength() - 1.;
    if (std::abs(strength_error) <
        2. * surface.error_of_mean_strength() / surface.mean_strength())
      strength_error = 0.;
  }



  // A rank stores the unknowns of its own cells and those on which they depend.
  template <int dim>
  void Block<dim>::setup_unknowns()
  {
    dof_handler.distribute_dofs(fe);
    relevant = relevant_dofs(parameters, dof_handler);
    constrain_hanging_nodes(dof_handler, relevant, hanging_constraints);
    solution.reinit(dof_handler.locally_owned_dofs(), relevant, communicator);
    for (Vector *vector : {&old_solution,
                           &older_solution,
                           &unbalanced,
                           &stage_solution,
                           &right_hand_side})
      vector->reinit(solution);
    inertia.reinit(dof_handler, solution);
  }



  // @sect3{Supports}

  // Prescribed displacements are linear in the parts of the loading: fields
  // that are zero wherever nothing is constrained, and the homogeneous
  // constraints say it all.
  template <int dim>
  void Block<dim>::find_supports()
  {
    for (unsigned int k = 0; k < n_load_parts; ++k)
      {
        LoadFactors factors{};
        factors[k] = 1.;
        constrain_displacements(
          parameters, dof_handler, relevant, factors, homogeneous_constraints);
        Vector &field = right_hand_side;
        field         = 0.;
        homogeneous_constraints.distribute(field);
        field.zero_out_ghost_values();
        load_cases[k].displacement = FaceVector(field);
      }
    make_homogeneous(homogeneous_constraints);
  }



  // Overwrite what is constrained, for the homogeneous constraints.
  template <int dim>
  void Block<dim>::constrain(Vector &displacement) const
  {
    displacement.update_ghost_values();
    const IndexSet &owned = dof_handler.locally_owned_dofs();
    std::vector<std::pair<types::global_dof_index, double>> values;
    for (const auto &line : homogeneous_constraints.get_lines())
      if (owned.is_element(line.index))
        {
          double value = 0.;
          for (const auto &entry : line.entries)
            value += entry.second * displacement(entry.first);
          values.emplace_back(line.index, value);
        }
    displacement.zero_out_ghost_values();
    for (const auto &entry : values)
      displacement(entry.first) = entry.second;
  }



  // Forces at supported unknowns are reactions; sums over all unknowns of a
  // component are resultants.
  template <int dim>
  void Block<dim>::find_groups_of_unknowns()
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        dofs_of_component[d].clear();
        supported_dofs[d].clear();
        DoFTools::extract_dofs(dof_handler,
                               fe.component_mask(FEValuesExtractors::Scalar(d)))
          .fill_index_vector(dofs_of_component[d]);
      }
    for (unsigned int d = 0; d < dim; ++d)
      for (const auto dof : dofs_of_component[d])
        if (const auto *entries =
              homogeneous_constraints.get_constraint_entries(dof))
          if (entries->empty())
            supported_dofs[d].push_back(dof);
  }



  // @sect3{Loads}

  // Tractions are dead loads on the undeformed faces, as small strains allow.
  template <int dim>
  void Block<dim>::assemble_tractions(
    const std::function<Tensor<1, 3>(const types::boundary_id)> &traction_on,
    Vector                                                      &load) const
  {
    load = 0.;
    FEFaceValues<dim>                    fe_values(fe,
                                contact.quadrature(),
                                update_values | update_JxW_values);
    dealii::Vector<double>               cell_load(fe.dofs_per_cell);
    std::vector<types::global_dof_index> dofs(fe.dofs_per_cell);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
            {
              const Tensor<1, 3> traction =
                traction_on(cell->face(f)->boundary_id());
              if (traction == Tensor<1, 3>())
                continue;
              fe_values.reinit(cell, f);
              cell_load = 0.;
              for (const unsigned int q : fe_values.quadrature_point_indices())
                for (const unsigned int i : fe_values.dof_indices())
                  cell_load(i) +=
                    traction[fe.system_to_component_index(i).first] *
                    fe_values.shape_value(i, q) * fe_values.JxW(q);
              cell->get_dof_indices(dofs);
              load.add(dofs, cell_load);
            }
    load.compress(VectorOperation::add);
  }



  template <int dim>
  void Block<dim>::assemble_loads()
  {
    Vector &load = right_hand_side;
    for (const LoadPart part : {programme_pressure, gradual, at_once})
      {
        assemble_tractions(
          [&](const types::boundary_id face) {
            return parameters.faces[face].tractions[part];
          },
          load);
        load_cases[part].force = FaceVector(load);
      }
    // Their dot product with displacements is the difference of two means.
    const double area = parameters.nominal_contact_area();
    for (unsigned int i = 0; i < dim - 1; ++i)
      {
        assemble_tractions(
          [&](const types::boundary_id face) {
            Tensor<1, 3> traction;
            if (face / 2 == parameters.normal_axis())
              traction[parameters.tangential_axis(i)] =
                (face == parameters.contact_face ? -1. : 1.) / area;
            return traction;
          },
          load);
        head_against_foot[i] = FaceVector(load);
      }
  }
} // namespace SlipStep
