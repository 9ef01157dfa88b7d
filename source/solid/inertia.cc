// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/inertia.h>

#include <deal.II/dofs/dof_tools.h>

#include <cmath>
#include <limits>

namespace SlipStep
{
  using namespace dealii;

  template <int dim>
  void Inertia<dim>::reinit(const DoFHandler<dim> &dof_handler,
                            const Vector          &like)
  {
    if (!exists())
      return;
    for (Vector *vector :
         {&lumped_mass, &velocity, &stage_velocity, &end_velocity})
      vector->reinit(like);

    const auto first = like.get_partitioner()->local_range().first;
    component.assign(like.locally_owned_size(), 0);
    for (unsigned int d = 0; d < dim; ++d)
      for (const auto dof :
           DoFTools::extract_dofs(dof_handler,
                                  dof_handler.get_fe().component_mask(
                                    FEValuesExtractors::Scalar(d))))
        component[dof - first] = d;

    const auto             shares = shares_of_mass(dof_handler.get_fe());
    dealii::Vector<double> masses(shares.size());
    std::vector<types::global_dof_index> dofs(shares.size());
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          for (unsigned int i = 0; i < dofs.size(); ++i)
            masses(i) = parameters.density * cell->measure() * shares[i];
          cell->get_dof_indices(dofs);
          lumped_mass.add(dofs, masses);
        }
    lumped_mass.compress(VectorOperation::add);
  }



  template <int dim>
  double Inertia<dim>::add_forces(const Vector         &displacement,
                                  const Vector         &start,
                                  const Tensor<1, dim> &frame_motion,
                                  const double          time,
                                  Vector               &forces) const
  {
    double square = 0.;
    for (unsigned int i = 0; i < component.size(); ++i)
      {
        const double motion = displacement.local_element(i) -
                              start.local_element(i) +
                              frame_motion[component[i]];
        const double force = lumped_mass.local_element(i) *
                             (motion / time - stage_velocity.local_element(i)) /
                             time;
        forces.local_element(i) += force;
        square += force * force;
      }
    return std::sqrt(sum_of_ranks(square));
  }



  template <int dim>
  double Inertia<dim>::round_off(const Vector &displacement,
                                 const double  frame,
                                 const double  time) const
  {
    double square = 0.;
    for (unsigned int i = 0; i < component.size(); ++i)
      {
        const double force = lumped_mass.local_element(i) / (time * time) *
                             (std::abs(displacement.local_element(i)) + frame);
        square += force * force;
      }
    return std::numeric_limits<double>::epsilon() *
           std::sqrt(sum_of_ranks(square));
  }



  template <int dim>
  double Inertia<dim>::sum_of_ranks(const double value) const
  {
    return exists() ?
             Utilities::MPI::sum(value, lumped_mass.get_mpi_communicator()) :
             0.;
  }



  template <int dim>
  void Inertia<dim>::add_force_changes(const Vector         &displacement,
                                       const Tensor<1, dim> &frame,
                                       const double          time,
                                       Vector               &forces) const
  {
    for (unsigned int i = 0; i < component.size(); ++i)
      forces.local_element(i) +=
        lumped_mass.local_element(i) / (time * time) *
        (displacement.local_element(i) + frame[component[i]]);
  }



  template <int dim>
  void Inertia<dim>::add_frame(const Tensor<1, dim> &frame,
                               Vector               &displacement) const
  {
    for (unsigned int i = 0; i < component.size(); ++i)
      displacement.local_element(i) += frame[component[i]];
  }



  template <int dim>
  void Inertia<dim>::end_stage(const Vector         &displacement,
                               const Vector         &start,
                               const Tensor<1, dim> &frame_motion,
                               const double          time)
  {
    for (unsigned int i = 0; i < component.size(); ++i)
      end_velocity.local_element(i) =
        (displacement.local_element(i) - start.local_element(i) +
         frame_motion[component[i]]) /
        time;
  }



  // Rigid constraints and hanging nodes hold for velocities as they do for
  // displacements, so the sum over all nodes is that of the motion.
  template <int dim>
  double Inertia<dim>::kinetic_energy() const
  {
    double sum = 0.;
    for (unsigned int i = 0; i < component.size(); ++i)
      sum += 0.5 * lumped_mass.local_element(i) *
             end_velocity.local_element(i) * end_velocity.local_element(i);
    return sum_of_ranks(sum);
  }



  template <int dim>
  void Inertia<dim>::difference_of_orders(const double time,
                                          Vector      &difference) const
  {
    const double factor = 0.5 * TwoStages::carry * time;
    for (unsigned int i = 0; i < component.size(); ++i)
      {
        const double start  = velocity.local_element(i);
        const double second = stage_velocity.local_element(i);
        const double end    = end_velocity.local_element(i);
        const double first  = start + (second - start) / TwoStages::carry;
        difference.local_element(i) =
          factor * ((first - end) + (first - start) - (end - second));
      }
  }



  template class Inertia<2>;
  template class Inertia<3>;
} // namespace SlipStep
