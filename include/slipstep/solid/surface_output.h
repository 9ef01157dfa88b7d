// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_surface_output_h
#define slipstep_solid_surface_output_h

#include <slipstep/solid/contact_face.h>

#include <filesystem>

namespace SlipStep
{
  /// Write what is seen of a block as quadrilaterals, one row each: in 3-D the
  /// faces of cells on its boundary, in 2-D the cells. Positions before
  /// deformation and displacements of the four corners, going round; then means
  /// over the quadrilateral: equivalent stress of von Mises and, where it is in
  /// the contact plane, pressure, slip path and r. All ranks take part.
  ///
  /// A mesh of more than 20 000 is for ParaView: nothing is written of it.
  /// @param displacement ghosted, relative to the frame [mm]
  template <int dim>
  void write_surface(const std::filesystem::path   &file,
                     const BlockParameters         &parameters,
                     const dealii::DoFHandler<dim> &dof_handler,
                     const Vector                  &displacement,
                     const ContactFace<dim>        &contact,
                     const MPI_Comm                &communicator);
} // namespace SlipStep

#endif
