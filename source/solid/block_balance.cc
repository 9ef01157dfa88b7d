// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/block.h>

#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <set>

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



  // Loads act on the undeformed block. Where its head leans by delta, the
  // normal load N would turn it by N delta more than the friction T at the foot
  // of its height, T H. That moves the pressure towards an edge, by 6 delta / L
  // of the mean, and lets less force hold the lean of a block that bends.
  template <int dim>
  void Block<dim>::note_lean(const ContactTotals &totals)
  {
    constexpr double slender = 2., least_eccentricity = 0.01;

    const double height = parameters.size[parameters.normal_axis()];
    for (unsigned int i = 0; i < dim - 1; ++i)
      {
        const double length = parameters.size[parameters.tangential_axis(i)];
        const double distance =
          std::abs(Utilities::MPI::sum(head_against_foot[i].dot(solution),
                                       communicator));
        lean.share = std::max(lean.share, distance / length);
        if (height < slender * length)
          continue;
        lean.moment_of_load =
          std::max(lean.moment_of_load, totals.normal_load * distance);
        lean.moment_of_friction =
          std::max({lean.moment_of_friction,
                    std::abs(totals.tangential_load[i]) * height,
                    least_eccentricity * totals.normal_load * length});
      }
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



  // @sect3{What acts through a face}

  namespace
  {
    double coordinate_of_face(const BlockParameters &parameters,
                              const unsigned int     f)
    {
      return f % 2 == 0 ? 0. : parameters.size[f / 2];
    }

    // How much of the reaction at a point of a face is that face's: on an edge
    // faces that hold it share it, so that the sum over all faces is complete.
    template <int dim>
    double share_of_reaction(const BlockParameters &parameters,
                             const unsigned int     face,
                             const Point<dim>      &point,
                             const unsigned int     component)
    {
      if (!parameters.holds(face, component))
        return 0.;
      unsigned int n_holding = 0;
      for (unsigned int f = 0; f < 2 * dim; ++f)
        n_holding +=
          parameters.holds(f, component) &&
          std::abs(point[f / 2] - coordinate_of_face(parameters, f)) <=
            1e-9 * parameters.size[f / 2];
      return 1. / n_holding;
    }
  } // namespace



  // `unbalanced` holds the reactions. Loads are uniform, so they have no moment
  // about the centre of their face.
  template <int dim>
  FaceAction Block<dim>::action_on(const unsigned int face_number) const
  {
    const FaceConditions &face = parameters.faces[face_number];
    Point<dim>            centre;
    double                area = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        centre[d] = d == face_number / 2 ?
                      coordinate_of_face(parameters, face_number) :
                      parameters.size[d] / 2.;
        area *= d == face_number / 2 ? 1. : parameters.size[d];
      }

    FaceAction result;
    const auto add = [&](const Point<dim> &point, const Tensor<1, dim> &force) {
      Tensor<1, 3> lever, force_3d;
      for (unsigned int d = 0; d < dim; ++d)
        {
          lever[d]    = point[d] - centre[d];
          force_3d[d] = force[d];
        }
      result.force += force_3d;
      result.moment += cross_product_3d(lever, force_3d);
    };

    const Quadrature<dim - 1> support_points(fe.get_unit_face_support_points());
    FEFaceValues<dim> points(fe, support_points, update_quadrature_points);
    std::vector<types::global_dof_index> dofs(fe.dofs_per_face);
    std::set<types::global_dof_index>    seen;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && cell->face(face_number)->at_boundary())
        {
          points.reinit(cell, face_number);
          cell->face(face_number)->get_dof_indices(dofs);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (dof_handler.locally_owned_dofs().is_element(dofs[i]) &&
                seen.insert(dofs[i]).second)
              {
                const unsigned int d =
                  fe.face_system_to_component_index(i).first;
                const Point<dim> point = points.quadrature_point(i);
                Tensor<1, dim>   reaction;
                reaction[d] =
                  unbalanced(dofs[i]) *
                  share_of_reaction<dim>(parameters, face_number, point, d);
                add(point, reaction);
              }
        }
    if (face.is_contact)
      for (const auto &cell_face : contact.cell_faces())
        for (const auto &point : cell_face.points)
          add(point.position, -point.JxW * point.force);

    result.force  = Utilities::MPI::sum(result.force, communicator);
    result.moment = Utilities::MPI::sum(result.moment, communicator);
    result.force += area * face.traction(load_factors);
    return result;
  }
} // namespace SlipStep
