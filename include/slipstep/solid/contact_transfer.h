// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_contact_transfer_h
#define slipstep_solid_contact_transfer_h

#include <deal.II/distributed/tria.h>

#include <slipstep/solid/contact_face.h>
#include <slipstep/solid/contact_projection.h>

#include <map>
#include <vector>

namespace SlipStep
{
  /// Carries the committed states of a contact face from mesh to mesh: through
  /// refinement and coarsening, to other ranks, and through a file.
  ///
  /// The states travel with the cells of the triangulation. Those of a cell
  /// that is neither refined nor coarsened arrive bit for bit; the others go
  /// through ContactProjection.
  /// @code
  ///   ContactTransfer<dim> transfer(triangulation, parameters, law);
  ///   triangulation.prepare_coarsening_and_refinement();
  ///   transfer.attach(contact);
  ///   triangulation.execute_coarsening_and_refinement();
  ///   dof_handler.distribute_dofs(fe);
  ///   contact.reinit(dof_handler);
  ///   transfer.unpack(contact);
  /// @endcode
  /// Several classes may attach data to one triangulation.
  template <int dim>
  class ContactTransfer
  {
  public:
    /// All arguments are kept as references.
    ContactTransfer(
      dealii::parallel::distributed::Triangulation<dim> &triangulation,
      const BlockParameters                             &parameters,
      const FrictionLaw                                 &law)
      : triangulation(triangulation)
      , parameters(parameters)
      , projection(parameters.degree, law)
    {}

    /// Attach the states to the cells, before the mesh changes. The face must
    /// not change until it has.
    void attach(const ContactFace<dim> &contact);

    /// Put the states into a face made anew on the changed mesh.
    void unpack(ContactFace<dim> &contact);

  private:
    using Triangulation = dealii::parallel::distributed::Triangulation<dim>;
    using Cell          = typename Triangulation::cell_iterator;
    using Status        = typename Triangulation::CellStatus;
    using States        = typename ContactProjection<dim>::States;
    using Bytes         = std::vector<char>;

    /// Where the contact face of a cell is in ContactFace::cell_faces().
    using Directory = std::map<dealii::CellId, unsigned int>;

    /// Cells at the contact face among the children of a cell, in the order of
    /// ContactProjection.
    std::array<Cell, ContactProjection<dim>::n_children>
    children_on_face(const Cell &cell) const;

    Bytes pack(const ContactFace<dim> &contact,
               const Directory        &directory,
               const Cell             &cell,
               const Status            status) const;
    void  unpack_cell(ContactFace<dim> &contact,
                      const Directory  &directory,
                      const Cell       &cell,
                      const Status      status,
                      const States     &states) const;

    Triangulation               &triangulation;
    const BlockParameters       &parameters;
    const ContactProjection<dim> projection;
    unsigned int                 handle = dealii::numbers::invalid_unsigned_int;
  };
} // namespace SlipStep

#endif
