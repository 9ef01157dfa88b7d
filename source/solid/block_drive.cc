// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/block.h>

#include <slipstep/solid/supports.h>
#include <slipstep/utilities/exceptions.h>

#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <set>

namespace SlipStep
{
  using namespace dealii;

  // @sect3{A drive that gives way}

  // The driven faces are rigid, and the motion d of the frame is theirs. Where
  // the programme gives the load instead, or a spring is between (Drive), d
  // joins the unknowns, one per direction of the contact plane, with the
  // equation that the reactions of the driven faces are what the drive exerts:
  // @f[ \mathbf R(\mathbf u, d) = 0, \qquad F(\mathbf u, d) = Q - K d . @f]
  // Newton's method solves with the tangent of the block as it always does,
  // once for the forces out of balance and once per d for the mode
  // @f$\mathbf v = -(\partial\mathbf R/\partial\mathbf u)^{-1}
  // \partial\mathbf R/\partial d@f$ in which the block follows its drive; then
  // @f[ \Delta d = \frac{Q - K d - F - F'(\Delta\mathbf u_0)}{F'(\mathbf v) + K} , \qquad
  //     \Delta\mathbf u = \Delta\mathbf u_0 + \mathbf v\,\Delta d . @f]
  // That the tangent of the contact is unsymmetric does not matter.

  template <int dim>
  void Block<dim>::move_frame_to(const Tensor<1, 2> &displacement)
  {
    loading.displacement = displacement;
    for (unsigned int i = 0; i < 2; ++i)
      load_factors[frame_x + i] = displacement[i];
  }



  // Where two faces meet, their common unknowns are driven once.
  template <int dim>
  void Block<dim>::find_driven_unknowns()
  {
    std::set<types::boundary_id> driven_faces;
    for (unsigned int f = 0; f < 2 * dim; ++f)
      if (parameters.faces[f].is_driven)
        driven_faces.insert(f);
    for (unsigned int i = 0; i < dim - 1; ++i)
      {
        driven_dofs[i].clear();
        if (driven_faces.empty())
          continue;
        const FEValuesExtractors::Scalar along(parameters.tangential_axis(i));
        (DoFTools::extract_boundary_dofs(dof_handler,
                                         fe.component_mask(along),
                                         driven_faces) &
         dof_handler.locally_owned_dofs())
          .fill_index_vector(driven_dofs[i]);
      }
  }



  // @param forces moved off the hanging nodes
  template <int dim>
  Tensor<1, 2> Block<dim>::force_on_drive(const Vector &forces) const
  {
    Tensor<1, 2> sums;
    const auto   first = forces.get_partitioner()->local_range().first;
    for (unsigned int i = 0; i < dim - 1; ++i)
      for (const auto dof : driven_dofs[i])
        sums[i] += forces.local_element(dof - first);
    return Utilities::MPI::sum(sums, communicator);
  }



  // By how much internal minus external forces change with a displacement
  // (ghosted) and a motion of the frame.
  template <int dim>
  void Block<dim>::compute_force_changes(const Vector       &displacement,
                                         const Tensor<1, 2> &frame,
                                         Vector             &changes) const
  {
    changes = 0.;
    system->add_elastic_forces(displacement, changes);
    changes.compress(VectorOperation::add);
    changes *= inertia.factors(stage_time).stiffness;
    contact.add_force_changes(displacement, frame, changes);
    changes.compress(VectorOperation::add);
    inertia.add_force_changes(displacement,
                              parameters.template in_plane<dim>(frame),
                              stage_time,
                              changes);
    move_to_masters(hanging_constraints, changes);
  }



  // Modes of the step before would do, too, but a run that is resumed has not
  // got them. Points that are held in space go backwards in the frame.
  template <int dim>
  void Block<dim>::begin_modes()
  {
    for (unsigned int i = 0; i < dim - 1; ++i)
      {
        drive_modes[i].reinit(solution);
        load_cases[frame_x + i].displacement.add_to(1., drive_modes[i]);
        drive_modes[i].update_ghost_values();
        mode_scale[i] = 0.;
      }
  }



  template <int dim>
  Tensor<1, 2> Block<dim>::force_missing_on_drive() const
  {
    return drive.is_unknown() ?
             drive.force(loading.displacement) - force_on_drive(unbalanced) :
             Tensor<1, 2>();
  }



  // Motion of the frame that a force on the drive makes, as far as block,
  // contact and drive let it; the block follows by its modes.
  // @throws RunError if nothing resists, or so little that it is farther than
  //   the block is high
  template <int dim>
  Tensor<1, 2> Block<dim>::yielding_of_drive(const Tensor<1, 2> &force) const
  {
    Tensor<2, 2> resistance = drive_springs;
    for (unsigned int i = 0; i < 2; ++i)
      resistance[i][i] += i < dim - 1 ? drive.stiffness() : 1.;
    if (determinant(resistance) > 0. && trace(resistance) > 0.)
      {
        const Tensor<1, 2> motion = invert(resistance) * force;
        if (motion.norm() <= parameters.size[parameters.normal_axis()])
          return motion;
      }
    throw RunError("nothing resists a further motion of the drive");
  }



  // @param[in,out] update of the displacements while the frame rests, then with
  // its motion
  // @return that motion
  // @throws RunError if the contact does not resist it
  template <int dim>
  Tensor<1, 2> Block<dim>::move_drive(Vector &update)
  {
    Vector &changes = right_hand_side;
    update.update_ghost_values();
    compute_force_changes(update, Tensor<1, 2>(), changes);
    const Tensor<1, 2> missing =
      force_missing_on_drive() - force_on_drive(changes);

    Vector correction(update);
    drive_springs = Tensor<2, 2>();
    for (unsigned int j = 0; j < dim - 1; ++j)
      {
        Tensor<1, 2> unit;
        unit[j] = 1.;
        compute_force_changes(drive_modes[j], unit, changes);
        changes *= -1.;
        move_to_masters(homogeneous_constraints, changes);
        mode_scale[j] = std::max(mode_scale[j], changes.l2_norm());
        count_linear_iterations(
          solve_linear_system(correction, 1e-6 * mode_scale[j]));
        constrain(correction);
        drive_modes[j].zero_out_ghost_values();
        drive_modes[j] += correction;
        drive_modes[j].update_ghost_values();
        compute_force_changes(drive_modes[j], unit, changes);
        const Tensor<1, 2> force = force_on_drive(changes);
        for (unsigned int i = 0; i < dim - 1; ++i)
          drive_springs[i][j] = force[i];
      }

    const Tensor<1, 2> motion = yielding_of_drive(missing);
    update.zero_out_ghost_values();
    for (unsigned int j = 0; j < dim - 1; ++j)
      update.add(motion[j], drive_modes[j]);
    return motion;
  }
} // namespace SlipStep
