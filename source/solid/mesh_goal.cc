// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/mesh_goal.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace SlipStep
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    double
    extent_of(const typename Triangulation<dim>::active_cell_iterator &cell)
    {
      return cell->diameter() / std::sqrt(static_cast<double>(dim));
    }
  } // namespace



  template <int dim>
  double GoalWeight<dim>::weight(const double extent,
                                 const double distance) const
  {
    return std::pow(extent / (extent + distance),
                    static_cast<double>(parameters.degree + dim)) /
           extent;
  }



  template <int dim>
  double GoalWeight<dim>::distance(
    const typename Triangulation<dim>::cell_iterator &cell) const
  {
    const unsigned int axis = parameters.normal_axis();
    const double       plane =
      parameters.outward_sign() > 0. ? parameters.size[axis] : 0.;
    double nearest = std::numeric_limits<double>::infinity();
    for (const unsigned int v : cell->vertex_indices())
      nearest = std::min(nearest, std::abs(cell->vertex(v)[axis] - plane));
    return nearest;
  }



  template <int dim>
  double GoalWeight<dim>::of(
    const typename Triangulation<dim>::active_cell_iterator &cell) const
  {
    return is_of_contact ? weight(extent_of<dim>(cell), distance(cell)) : 1.;
  }



  template <int dim>
  double GoalWeight<dim>::growth(
    const typename Triangulation<dim>::active_cell_iterator &cell) const
  {
    if (!is_of_contact || cell->level() == 0)
      return 1.;
    return weight(2. * extent_of<dim>(cell), distance(cell->parent())) /
           of(cell);
  }



  template <int dim>
  double GoalWeight<dim>::squared_norm(const ContactFace<dim> &contact,
                                       const double            elastic_energy,
                                       const MPI_Comm &communicator) const
  {
    if (!is_of_contact)
      return 2. * elastic_energy;
    double sum = 0.;
    for (const auto &face : contact.cell_faces())
      for (const auto &point : face.points)
        sum += point.force.norm_square() * point.JxW;
    return Utilities::MPI::sum(sum, communicator) / parameters.young_modulus;
  }



  template class GoalWeight<2>;
  template class GoalWeight<3>;
} // namespace SlipStep
