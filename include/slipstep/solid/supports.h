#ifndef slipstep_solid_supports_h
#define slipstep_solid_supports_h

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/lac/affine_constraints.h>

#include <slipstep/solid/block_parameters.h>

namespace SlipStep
{
  /// Unknowns that this rank must know: those of its own cells and their
  /// neighbours, and those to which the points of flat faces are tied.
  template <int dim>
  dealii::IndexSet relevant_dofs(const BlockParameters         &parameters,
                                 const dealii::DoFHandler<dim> &dof_handler);

  /// Everything that ties displacements: hanging nodes, prescribed values and
  /// flat faces. Closed.
  ///
  /// Displacements are prescribed in space, but the unknown is relative to the
  /// frame of the drive: along the contact plane the displacement of the frame
  /// is subtracted.
  /// @param relevant from relevant_dofs()
  /// @param frame displacement of the frame [mm]
  template <int dim>
  void constrain_displacements(const BlockParameters             &parameters,
                               const dealii::DoFHandler<dim>     &dof_handler,
                               const dealii::IndexSet            &relevant,
                               const dealii::Tensor<1, 2>        &frame,
                               dealii::AffineConstraints<double> &constraints);
} // namespace SlipStep

#endif
