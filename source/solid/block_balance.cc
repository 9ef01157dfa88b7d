#include <slipstep/solid/block.h>

#include <slipstep/utilities/exceptions.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace SlipStep
{
  using namespace dealii;

  // Sum of the entries that belong to each displacement component: because
  // shape functions sum to one, the resultant of the forces.
  template <int dim>
  Tensor<1, dim> Block<dim>::sum_by_component(const Vector &vector) const
  {
    Tensor<1, dim> sums;
    for (unsigned int d = 0; d < dim; ++d)
      for (const auto dof : dofs_of_component[d])
        sums[d] += vector(dof);
    return Utilities::MPI::sum(sums, communicator);
  }



  // Reactions and loads do work on displacements in space: those in the frame
  // plus the motion of the frame. A face that is held in space moves against
  // the frame, and its reactions do none.
  template <int dim>
  double Block<dim>::work_of_stage()
  {
    const Tensor<1, 2> motion = loading.displacement - stage_frame;
    Tensor<1, dim>     frame_motion;
    for (unsigned int i = 0; i < dim - 1; ++i)
      frame_motion[parameters.tangential_axis(i)] = motion[i];
    double work = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      for (const auto dof : supported_dofs[d])
        work += unbalanced(dof) *
                (solution(dof) - stage_solution(dof) + frame_motion[d]);
    work = Utilities::MPI::sum(work, communicator);

    forces = 0.;
    forces.add(constant_share,
               constant_load,
               loading.pressure,
               unit_pressure_load);
    return work + forces * solution - forces * stage_solution +
           sum_by_component(forces) * frame_motion;
  }



  template <int dim>
  void Block<dim>::check_balance_of_forces()
  {
    // Global balance: elastic forces have no resultant, so contact forces are
    // the loads plus all reactions; `unbalanced` holds nothing but reactions.
    const double normal_load =
      std::abs(sum_by_component(contact_forces)[parameters.normal_axis()]);
    forces = contact_forces;
    forces.add(-constant_share,
               constant_load,
               -loading.pressure,
               unit_pressure_load);
    for (const auto &line : homogeneous_constraints.get_lines())
      if (line.entries.empty() &&
          dof_handler.locally_owned_dofs().is_element(line.index))
        forces(line.index) -= unbalanced(line.index);
    if (normal_load > 0.)
      largest_imbalance =
        std::max(largest_imbalance,
                 sum_by_component(forces).norm() / normal_load);
  }



  // u . K u / 2, where K u is what the residual says of it. The motion of the
  // frame stores nothing.
  template <int dim>
  double Block<dim>::elastic_energy()
  {
    forces = unbalanced;
    forces -= contact_forces;
    forces.add(constant_share,
               constant_load,
               loading.pressure,
               unit_pressure_load);
    return 0.5 * (forces * solution);
  }



  // @sect3{When it goes wrong}

  // A block without contact is free to move, so there is nothing left to
  // compute.
  template <int dim>
  void Block<dim>::check_contact(const ContactTotals &totals)
  {
    largest_normal_load = std::max(largest_normal_load, totals.normal_load);
    contact_share       = totals.area / parameters.nominal_contact_area();
    if (contact_share < smallest_contact_share)
      {
        smallest_contact_share = contact_share;
        time_of_opening        = control.time();
      }
    if (totals.normal_load <= 1e-6 * largest_normal_load)
      {
        std::ostringstream message;
        message << "no contact pressure is left at t = " << control.time()
                << " s: the block has come off the plane";
        throw RunError(message.str());
      }

    // Along a side of the block the motion is measured by that side: a thin
    // strip may be stretched by more than its height, but not rise as much, and
    // the load on a high block must stay above its foot.
    for (unsigned int d = 0; d < dim; ++d)
      {
        double motion = 0.;
        for (const auto dof : dofs_of_component[d])
          motion = std::max(motion, std::abs(solution(dof)));
        motion = Utilities::MPI::max(motion, communicator);
        if (motion <= 0.05 * parameters.size[d])
          continue;
        std::ostringstream message;
        message << "points of the block have moved by " << motion
                << " mm along "
                << "xyz"[d]
                << " with respect to the drive, which is too much for small "
                   "strains and rotations";
        failure = message.str();
        throw RunError("At t = " + std::to_string(control.time()) + " s " +
                       reason_of_failure());
      }
  }



  // The state of the contact tells more than the algebra.
  template <int dim>
  std::string Block<dim>::reason_of_failure() const
  {
    std::ostringstream message;
    if (largest_normal_load > 0. && contact_share < 0.6)
      message << "the block tips over: only "
              << std::round(100. * contact_share)
              << " % of its face is still in contact (" << failure << ")";
    else
      message << failure;
    return message.str();
  }



  template <int dim>
  void Block<dim>::fill(Summary &summary) const
  {
    summary.dimension         = dim;
    summary.cells             = triangulation.n_global_active_cells();
    summary.dofs              = dof_handler.n_dofs();
    summary.ranks             = Utilities::MPI::n_mpi_processes(communicator);
    summary.steps             = control.n_accepted();
    summary.rejected_steps    = control.n_rejected();
    summary.newton_iterations = n_newton_total;
    summary.linear_iterations = n_linear_total;
    summary.mesh_error        = tolerance.summary();
    summary.warnings.clear();
    // Round-off of sums of areas opens nothing.
    if (smallest_contact_share < 1. - 1e-9)
      {
        summary.opening = {1. - smallest_contact_share, time_of_opening};
        std::ostringstream message;
        message << "part of the contact face lifted off the plane: at worst "
                << std::setprecision(2) << 100. * summary.opening.share
                << " % of it was open, at t = " << std::setprecision(6)
                << time_of_opening
                << " s (friction turns a block that is high for its length)";
        summary.warnings.push_back(message.str());
      }
    if (most_cells_wanted > 0.)
      summary.warnings.push_back(
        "the mesh reached the limit set in section Block/Adaptivity: at worst " +
        std::to_string(std::llround(most_cells_wanted)) +
        " more cells were wanted than are allowed");
    if (!summary.missed_tolerance().empty())
      summary.warnings.push_back(summary.missed_tolerance() + ": " +
                                 tolerance.remedy());
    if (largest_jump > 1e-3)
      {
        std::ostringstream message;
        message << "the friction force jumped by up to " << std::setprecision(2)
                << 100. * largest_jump
                << " % when the mesh changed (see refinement.csv); a smaller "
                   "'Tolerance' in section Block/Adaptivity or more "
                   "subdivisions make it smoother";
        summary.warnings.push_back(message.str());
      }
  }



  template class Block<2>;
  template class Block<3>;
} // namespace SlipStep
