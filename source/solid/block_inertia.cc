// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/block.h>

#include <slipstep/solid/supports.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace SlipStep
{
  using namespace dealii;

  // @sect3{A body with mass}

  // With a density the forces of inertia join the balance (Inertia). They are
  // those of the motion in space, so the frame that moves with the drive adds
  // its own.

  template <int dim>
  Tensor<1, dim> Block<dim>::frame_motion_in_stage() const
  {
    return parameters.template in_plane<dim>(loading.displacement -
                                             stage_frame);
  }



  // The displacement whose elastic stress the body has: u, with damping
  // u + t_d v.
  template <int dim>
  const Vector &Block<dim>::strained_displacement()
  {
    const double factor = inertia.factors(stage_time).stiffness;
    if (factor == 1.)
      return solution;
    Vector &strained = right_hand_side;
    strained.equ(factor, solution);
    strained.add(1. - factor, stage_solution);
    strained.update_ghost_values();
    return strained;
  }



  // t_d v . K v over the time of the stage.
  template <int dim>
  double Block<dim>::damped_energy_of_stage()
  {
    if (parameters.damping_time == 0.)
      return 0.;
    Vector motion(solution);
    motion -= stage_solution;
    motion.update_ghost_values();
    Vector &forces = right_hand_side;
    forces         = 0.;
    system->add_elastic_forces(motion, forces);
    forces.compress(VectorOperation::add);
    return parameters.damping_time / stage_time * (forces * motion);
  }



  // Displacements, in space, that forces make which act through a stage.
  // @param on_drive force on the drive besides
  // @param[in,out] forces on the block, then its displacement
  // @return that of the driven faces where it is unknown
  template <int dim>
  Tensor<1, 2> Block<dim>::let_through(const Tensor<1, 2> &on_drive,
                                       Vector             &forces)
  {
    const bool   yields = drive.is_unknown() && newton.n_iterations > 0;
    Vector       moved(forces);
    Tensor<1, 2> missing = on_drive;
    if (yields)
      {
        move_to_masters(hanging_constraints, moved);
        missing += force_on_drive(moved);
      }
    move_to_masters(homogeneous_constraints, forces);
    Vector displacement(forces);
    count_linear_iterations(
      system->solve(displacement, forces, 0.1 * forces.l2_norm()));
    constrain(displacement);
    Tensor<1, 2> motion;
    if (yields)
      {
        displacement.update_ghost_values();
        compute_force_changes(displacement, Tensor<1, 2>(), moved);
        motion = yielding_of_drive(missing - force_on_drive(moved));
        displacement.zero_out_ghost_values();
        for (unsigned int j = 0; j < dim - 1; ++j)
          displacement.add(motion[j], drive_modes[j]);
        inertia.add_frame(parameters.template in_plane<dim>(motion),
                          displacement);
      }
    forces.swap(displacement);
    return motion;
  }



  // As of the machine (Machine::error_of_motion): the stage lets a part of the
  // difference e of two orders through,
  // @f$\delta = (\mathbf K + \mathbf C + m)^{-1} m e@f$ with
  // @f$m = \mathbf M/(\gamma h)^2@f$, little of what is far quicker than it.
  // The energy of its stress, @f$\delta\cdot m(e - \delta)/2@f$, counts beside
  // that in block, contact and spring of the drive, and beside that of the
  // loads while these are still empty. A stiff block on a soft spring has next
  // to none of its own when it comes to rest.
  template <int dim>
  double Block<dim>::error_of_motion(const ContactTotals &totals)
  {
    if (!inertia.exists())
      return 0.;
    Vector difference(right_hand_side);
    difference = 0.;
    inertia.difference_of_orders(stage_time, difference);
    Tensor<1, 2> of_drive;
    if (drive.is_unknown())
      of_drive = drive.difference_of_orders();
    Vector &forces = right_hand_side;
    forces         = 0.;
    inertia.add_force_changes(difference, Tensor<1, dim>(), stage_time, forces);
    Vector       passed(forces);
    Tensor<1, 2> passed_by_drive;
    try
      {
        passed_by_drive = let_through(drive.inertia() * of_drive, passed);
      }
    catch (const RunError &)
      {
        // Not known: a shorter step will tell.
        return std::numeric_limits<double>::infinity();
      }

    // The drive moves with the machine's mass, the block with its own.
    difference -= passed;
    of_drive -= passed_by_drive;
    forces = 0.;
    inertia.add_force_changes(difference, Tensor<1, dim>(), stage_time, forces);
    const double energy =
      std::abs(forces * passed +
               drive.inertia() * (of_drive * passed_by_drive)) /
      2.;
    if (energy == 0.)
      return 0.;

    double stress = programme.largest_pressure(), volume = 1.;
    for (const FaceConditions &face : parameters.faces)
      for (const LoadPart part : {gradual, at_once})
        stress = std::max(stress, face.tractions[part].norm());
    for (unsigned int d = 0; d < dim; ++d)
      volume *= parameters.size[d];
    const double of_loads =
      stress * stress / (2. * parameters.young_modulus) * volume;
    constexpr double part   = 0.3;
    const double     stored = elastic_energy() + inertia.kinetic_energy() +
                          totals.stored + drive.stored_energy();
    return part * std::sqrt(energy / std::max(of_loads, stored));
  }



  // Fields that the next step begins with: of the last two steps the
  // displacements, and the velocity.
  template <int dim>
  std::vector<Vector *> Block<dim>::fields_of_state()
  {
    std::vector<Vector *> fields = {&old_solution, &older_solution};
    if (inertia.exists())
      fields.push_back(&inertia.state());
    return fields;
  }
} // namespace SlipStep
