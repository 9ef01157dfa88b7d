// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_supports_h
#define slipstep_solid_supports_h

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <slipstep/solid/block_parameters.h>

namespace SlipStep
{
  /// Unknowns that this rank must know: those of its own cells and their
  /// neighbours, and those to which hanging nodes and the points of flat faces
  /// are tied.
  template <int dim>
  dealii::IndexSet relevant_dofs(const BlockParameters         &parameters,
                                 const dealii::DoFHandler<dim> &dof_handler);

  /// Hanging nodes only. Closed.
  /// @param relevant from relevant_dofs()
  template <int dim>
  void constrain_hanging_nodes(const dealii::DoFHandler<dim>     &dof_handler,
                               const dealii::IndexSet            &relevant,
                               dealii::AffineConstraints<double> &constraints);

  /// Move forces from tied unknowns to those on which they depend, by the
  /// principle of virtual work. Forces at fixed unknowns vanish.
  /// @param forces compressed; ghosted as relevant_dofs() says
  void
  move_to_masters(const dealii::AffineConstraints<double> &constraints,
                  dealii::LinearAlgebra::distributed::Vector<double> &forces);

  /// Everything that ties displacements: hanging nodes, prescribed values and
  /// flat faces. Closed.
  ///
  /// Displacements are prescribed in space, but the unknown is relative to the
  /// frame of the drive: along the contact plane the displacement of the frame
  /// is subtracted.
  /// @param relevant from relevant_dofs()
  /// @param factors of the parts of the loading
  template <int dim>
  void constrain_displacements(const BlockParameters             &parameters,
                               const dealii::DoFHandler<dim>     &dof_handler,
                               const dealii::IndexSet            &relevant,
                               const LoadFactors                 &factors,
                               dealii::AffineConstraints<double> &constraints);

  /// Prescribe zero wherever a value is prescribed.
  void make_homogeneous(dealii::AffineConstraints<double> &constraints);
} // namespace SlipStep

#endif
