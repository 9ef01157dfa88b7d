// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/contact_transfer.h>

#include <deal.II/base/utilities.h>

#include <boost/serialization/vector.hpp>

#include <array>

namespace SlipStep
{
  using namespace dealii;

  // @sect3{History on another mesh}
  //
  // When the mesh changes, the displacement is interpolated by deal.II's
  // SolutionTransfer. The history of the contact is no finite element function:
  // it lives at quadrature points, must stay admissible (r_s not above r, no
  // traction where it is open), and its integrals are forces and energies. So
  // the states travel with the cells as data of their own. On a cell that stays
  // they arrive bit for bit. Children get, and parents make of their children,
  // what ContactProjection finds: a projection that keeps the integrals of
  // traction, pressure, strength, slip and dissipated energy, limited where a
  // polynomial would leave what is admissible.

  template <int dim>
  std::array<typename ContactTransfer<dim>::Cell,
             ContactProjection<dim>::n_children>
  ContactTransfer<dim>::children_on_face(const Cell &cell) const
  {
    std::array<Cell, ContactProjection<dim>::n_children> children;
    for (unsigned int i = 0; i < children.size(); ++i)
      children[i] = cell->child(GeometryInfo<dim>::child_cell_on_face(
        RefinementCase<dim>::isotropic_refinement, parameters.contact_face, i));
    return children;
  }



  // Of a cell that is about to lose its children their states are merged here,
  // while they still exist; of one that gets children they are split after the
  // journey, which may lead to another rank.

  template <int dim>
  typename ContactTransfer<dim>::Bytes
  ContactTransfer<dim>::pack(const ContactFace<dim> &contact,
                             const Directory        &directory,
                             const Cell             &cell,
                             const Status            status) const
  {
    if (!cell->at_boundary(parameters.contact_face))
      return {};
    const auto states_of = [&](const Cell &of_cell) {
      States states;
      for (const auto &point :
           contact.cell_faces()[directory.at(of_cell->id())].points)
        states.push_back(point.point.committed());
      return states;
    };

    if (status != Triangulation::CELL_COARSEN)
      return Utilities::pack(states_of(cell), false);
    std::array<States, ContactProjection<dim>::n_children> of_children;
    const auto children = children_on_face(cell);
    for (unsigned int i = 0; i < children.size(); ++i)
      of_children[i] = states_of(children[i]);
    return Utilities::pack(projection.coarsen(of_children), false);
  }



  template <int dim>
  void ContactTransfer<dim>::unpack_cell(ContactFace<dim> &contact,
                                         const Directory  &directory,
                                         const Cell       &cell,
                                         const Status      status,
                                         const States     &states) const
  {
    if (states.empty())
      return;
    if (status != Triangulation::CELL_REFINE)
      {
        contact.set_states(directory.at(cell->id()), states);
        return;
      }
    const auto of_children = projection.refine(states);
    const auto children    = children_on_face(cell);
    for (unsigned int i = 0; i < children.size(); ++i)
      contact.set_states(directory.at(children[i]->id()), of_children[i]);
  }



  template <int dim>
  void ContactTransfer<dim>::attach(const ContactFace<dim> &contact)
  {
    handle = triangulation.register_data_attach(
      [this, &contact, directory = contact.places_of_cells()](
        const Cell &cell, const Status status) {
        return pack(contact, directory, cell, status);
      },
      /*returns_variable_size_data=*/true);
  }



  template <int dim>
  void ContactTransfer<dim>::unpack(ContactFace<dim> &contact)
  {
    const Directory directory = contact.places_of_cells();
    triangulation.notify_ready_to_unpack(
      handle,
      [&](const Cell                                         &cell,
          const Status                                        status,
          const boost::iterator_range<Bytes::const_iterator> &range) {
        unpack_cell(contact,
                    directory,
                    cell,
                    status,
                    range.empty() ? States() :
                                    Utilities::unpack<States>(range.begin(),
                                                              range.end(),
                                                              false));
      });
    handle = numbers::invalid_unsigned_int;
  }



  template class ContactTransfer<2>;
  template class ContactTransfer<3>;
} // namespace SlipStep
