// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/block.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  using namespace dealii;

  // Sum of the entries that belong to each displacement component: because
  // shape functions sum to one, the resultant of the forces.
  template <int dim>
  Tensor<1, dim> Block<dim>::sum_by_component(const Vector &vector) const
  {
    Tensor<1, dim> sums;
    const auto     first = vector.get_partitioner()->local_range().first;
    for (unsigned int d = 0; d < dim; ++d)
      for (const auto dof : dofs_of_component[d])
        sums[d] += vector.local_element(dof - first);
    return Utilities::MPI::sum(sums, communicator);
  }



  // Reactions and loads do work on displacements in space: those in the frame
  // plus the motion of the frame. A face that is held in space moves against
  // the frame, and its reactions do none.
  template <int dim>
  double Block<dim>::work_of_stage()
  {
    const Tensor<1, dim> frame_motion = frame_motion_in_stage();
    double               work         = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      for (const auto dof : supported_dofs[d])
        work += unbalanced(dof) *
                (solution(dof) - stage_solution(dof) + frame_motion[d]);
    // Of a load that comes down as material wears away the friction pays.
    work = Utilities::MPI::sum(work - contact.wear_work(), communicator) +
           drive.work_beyond(force_on_drive(unbalanced));

    Vector &loads = right_hand_side;
    loads         = 0.;
    add_loads(1., loads);
    return work + loads * solution - loads * stage_solution +
           sum_by_component(loads) * frame_motion;
  }



  template <int dim>
  void Block<dim>::check_balance_of_forces()
  {
    // Global balance: elastic forces have no resultant, so contact forces and
    // those of inertia are the loads plus all reactions; `unbalanced` holds
    // nothing but reactions.
    Vector &forces = right_hand_side;
    forces         = 0.;
    contact_forces.add_to(1., forces);
    const double normal_load =
      std::abs(sum_by_component(forces)[parameters.normal_axis()]);
    add_loads(-1., forces);
    inertia.add_forces(
      solution, stage_solution, frame_motion_in_stage(), stage_time, forces);
    for (const auto &line : homogeneous_constraints.get_lines())
      if (line.entries.empty() &&
          dof_handler.locally_owned_dofs().is_element(line.index))
        forces(line.index) -= unbalanced(line.index);
    if (normal_load > 0.)
      largest_imbalance =
        std::max(largest_imbalance,
                 sum_by_component(forces).norm() / normal_load);
  }



  // u . K u / 2, where K u is what the residual says of it, unless there is
  // more in it. The motion of the frame stores nothing.
  template <int dim>
  double Block<dim>::elastic_energy()
  {
    Vector &forces = right_hand_side;
    if (inertia.exists())
      {
        forces = 0.;
        system->add_elastic_forces(solution, forces);
        forces.compress(VectorOperation::add);
      }
    else
      {
        forces = unbalanced;
        contact_forces.add_to(-1., forces);
        add_loads(1., forces);
      }
    return 0.5 * (forces * solution);
  }
} // namespace SlipStep
