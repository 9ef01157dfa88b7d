// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/block.h>

#include <slipstep/solid/contact_transfer.h>
#include <slipstep/solid/error_indicator.h>
#include <slipstep/utilities/exceptions.h>

#include <deal.II/distributed/solution_transfer.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  using namespace dealii;

  // @sect3{Another mesh}

  // A solved step is looked at before it is accepted. If it asks for a finer
  // mesh, the state at its beginning is carried over and the same step is made
  // again: so the mesh is fine before the slip front gets there, not after.
  template <int dim>
  bool Block<dim>::adapt_to_trial(BlockOutput<dim> *output)
  {
    is_marked = false;
    if (parameters.refinement.type != RefinementType::adaptive ||
        contact_forces.l2_norm() == 0. || !is_time_to_check())
      return false;
    const MarkedCells marked = mark_cells();
    if (!mesh_changes.empty() && std::isnan(mesh_changes.back().error))
      {
        mesh_changes.back().error = marked.error;
        if (output != nullptr)
          output->write_mesh_changes(mesh_changes);
      }
    if (marked.n_refined == 0 ||
        n_repeats >= parameters.refinement.most_repeats)
      return false;
    ++n_repeats;
    change_mesh(marked, true, output);
    return true;
  }



  // The last mesh is looked at, too: what the run ends with has an error.
  template <int dim>
  bool Block<dim>::is_time_to_check() const
  {
    return n_repeats > 0 ||
           steps_since_check + 1 >= parameters.refinement.check_interval ||
           control.end_of_step() >= programme.end_time();
  }



  // What need not be repeated waits for the end of the step: merging cells, if
  // it is worth the effort of a new mesh, and refinement beyond the repeats.
  template <int dim>
  void Block<dim>::adapt_after_step(BlockOutput<dim> *output)
  {
    n_repeats = 0;
    ++steps_since_check;
    if (!is_marked)
      return;
    is_marked                = false;
    steps_since_check        = 0;
    const double n_cells     = triangulation.n_global_active_cells();
    const double growth      = (1 << dim) - 1.;
    const bool   is_worth_it = last_marked.n_refined > 0 ||
                             growth * last_marked.n_merged > 0.05 * n_cells;
    if (!is_worth_it || control.is_finished())
      return;
    change_mesh(last_marked, false, output);
  }



  template <int dim>
  MarkedCells Block<dim>::mark_cells()
  {
    auto errors =
      ErrorIndicator<dim>(parameters)
        .squared_errors(dof_handler, solution, contact, load_factors);
    const GoalWeight<dim> goal(parameters);
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        errors[cell->active_cell_index()] *= goal.of(cell);
    try
      {
        last_marked = marker.mark(triangulation,
                                  errors,
                                  goal.squared_norm(contact,
                                                    elastic_energy(),
                                                    communicator),
                                  dof_handler.n_dofs(),
                                  least_level);
      }
    catch (const RunError &error)
      {
        throw RunError("At t = " + std::to_string(control.time()) + " s " +
                       error.what());
      }
    is_marked         = true;
    most_cells_wanted = std::max(most_cells_wanted, last_marked.n_too_many);
    return last_marked;
  }



  // The state carried over is the committed one. What the change does to the
  // forces is measured twice: by the integrals of what was carried over, which
  // are conserved, and with the forces in equilibrium on the new mesh, where
  // the force differs by the error of the old one.
  template <int dim>
  void Block<dim>::change_mesh(const MarkedCells &marked,
                               const bool         repeats_step,
                               BlockOutput<dim>  *output)
  {
    contact.revert();
    const ContactTotals before = contact.totals(communicator);
    transfer_to_new_mesh();
    const ContactTotals carried = contact.totals(communicator);

    MeshChange change;
    change.time            = control.time();
    change.repeats_step    = repeats_step;
    change.n_refined       = marked.n_refined;
    change.n_merged        = marked.n_merged;
    change.error_before    = marked.error;
    change.n_cells         = triangulation.n_global_active_cells();
    change.n_unknowns      = dof_handler.n_dofs();
    change.tangential_load = before.tangential_load[0];
    change.dissipated      = before.dissipated;

    const double load = std::max(
      {before.tangential_load.norm(), 0.1 * before.limit_load, 1e-300});
    const double energy =
      std::max({before.dissipated, 0.01 * std::abs(external_work), 1e-300});
    const auto load_jump = [&](const ContactTotals &totals) {
      return (totals.tangential_load - before.tangential_load).norm() / load;
    };
    const auto dissipation_jump = [&](const ContactTotals &totals) {
      return (totals.dissipated - before.dissipated) / energy;
    };
    change.load_jump        = load_jump(carried);
    change.dissipation_jump = dissipation_jump(carried);
    // A block in motion is in no equilibrium with its loads.
    if (control.time() > 0. && !inertia.exists() && find_equilibrium_at_start())
      {
        const ContactTotals settled         = contact.totals(communicator);
        change.equilibrium_load_jump        = load_jump(settled);
        change.equilibrium_dissipation_jump = dissipation_jump(settled);
      }
    contact.revert();
    solution    = old_solution;
    mesh_is_new = true;

    largest_jump =
      std::max({largest_jump, change.load_jump, change.equilibrium_load_jump});
    mesh_changes.push_back(change);
    if (output != nullptr)
      output->write_mesh_changes(mesh_changes);
  }



  // Displacements and velocities are interpolated, contact histories projected;
  // everything else follows from the mesh.
  template <int dim>
  void Block<dim>::transfer_to_new_mesh()
  {
    system.reset();
    parallel::distributed::SolutionTransfer<dim, Vector> displacements(
      dof_handler);
    ContactTransfer<dim>  histories(triangulation,
                                   parameters,
                                   contact.friction_law());
    std::vector<Vector *> vectors = fields_of_state();
    // Velocities have more round-off than the transfer allows neighbours to
    // differ by.
    const auto conform = [&] {
      for (Vector *vector : vectors)
        {
          vector->zero_out_ghost_values();
          hanging_constraints.distribute(*vector);
          vector->update_ghost_values();
        }
    };
    conform();
    displacements.prepare_for_coarsening_and_refinement(
      std::vector<const Vector *>(vectors.begin(), vectors.end()));
    histories.attach(contact);
    triangulation.execute_coarsening_and_refinement();

    setup_system();
    displacements.interpolate(vectors);
    histories.unpack(contact);
    conform();
  }



  // Equilibrium on a new mesh under the loads at the beginning of the step, in
  // a time too short for anything that takes time.
  template <int dim>
  bool Block<dim>::find_equilibrium_at_start()
  {
    const Loading      end    = loading;
    const NewtonRecord record = newton;
    loading                   = old_loading;
    stage_time                = 1e-6 * control.step_size();
    stage_solution            = old_solution;
    stage_frame               = old_loading.displacement;
    load_factors = load_factors_at(programme, first_step, control.time());
    solution     = old_solution;
    drive.rest();
    move_frame_to(old_loading.displacement);
    impose_displacements();
    const bool is_found = solve_stage();
    loading             = end;
    newton              = record;
    return is_found;
  }
} // namespace SlipStep
