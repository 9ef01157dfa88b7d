// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_block_probes_h
#define slipstep_solid_block_probes_h

#include <slipstep/solid/block.h>
#include <slipstep/solid/face_probes.h>

#include <vector>

namespace SlipStep
{
  /// Displacements in space of points of a block at the end of the last step
  /// [mm]; the same on all ranks, which all take part with the same points.
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  displacements_at(const Block<dim>                      &block,
                   const std::vector<dealii::Point<dim>> &points,
                   const MPI_Comm                        &communicator);

  /// Reads all quantities of interest off a block that have to be read step by
  /// step: those of the contact face, displacements of points, and what acts
  /// through faces.
  template <int dim>
  class BlockProbes
  {
  public:
    BlockProbes(const BlockParameters                 &parameters,
                const Programme                       &programme,
                const std::vector<QuantityOfInterest> &quantities)
      : probes(probes_among(quantities))
      , on_contact_face(parameters, programme)
    {}

    /// Values in the order of probes_among(), for the step just accepted; the
    /// same on all ranks, which all take part.
    std::vector<double> values(const Block<dim> &block,
                               const MPI_Comm   &communicator) const;

  private:
    const std::vector<QuantityOfInterest> probes;
    const FaceProbes<dim>                 on_contact_face;
  };
} // namespace SlipStep

#endif
