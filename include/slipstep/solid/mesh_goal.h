// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_mesh_goal_h
#define slipstep_solid_mesh_goal_h

#include <slipstep/solid/contact_face.h>

namespace SlipStep
{
  /// What an adaptive mesh is to be good for.
  enum class MeshGoal : int
  {
    energy, ///< stresses everywhere, in the energy norm
    contact ///< tractions of the contact face, in the L2 norm
  };

  /// What the energy of the error in a cell means for the goal of the mesh.
  ///
  /// Energies count as they are, and tractions of the contact face with
  /// \f[ \frac{\|\delta t\|^2}{E} \approx \sum_K w_K\,\eta_K^2 , \qquad
  ///   w_K = \frac{1}{h_K} \left( \frac{h_K}{h_K + d_K} \right)^{p + d} \f]
  /// where h is the extent of a cell and d_K its distance from the plane. At
  /// the face, that makes tractions of energies. Away from it, the unbalanced
  /// forces of a cell cancel against polynomials of degree p, and what they do
  /// at the distance d falls with (h/d)^(p+d), its square twice as fast. That
  /// holds far from edges; what comes along free surfaces falls more slowly,
  /// hence half the exponent.
  template <int dim>
  class GoalWeight
  {
  public:
    explicit GoalWeight(const BlockParameters &parameters)
      : parameters(parameters)
      , is_of_contact(parameters.refinement.goal == MeshGoal::contact)
    {}

    /// Factor of the squared error of a cell; w_K [1/mm] or 1.
    double of(const typename dealii::Triangulation<dim>::active_cell_iterator
                &cell) const;

    /// How many times larger the factor is of the parent.
    double growth(
      const typename dealii::Triangulation<dim>::active_cell_iterator &cell)
      const;

    /// What relative errors refer to, when @p elastic_energy [N mm] is stored:
    /// the squared energy norm [N mm] or that of the tractions over E [N]. All
    /// ranks take part.
    double squared_norm(const ContactFace<dim> &contact,
                        const double            elastic_energy,
                        const MPI_Comm         &communicator) const;

  private:
    double weight(const double extent, const double distance) const;
    double distance(
      const typename dealii::Triangulation<dim>::cell_iterator &cell) const;

    const BlockParameters parameters;
    const bool            is_of_contact;
  };
} // namespace SlipStep

#endif
