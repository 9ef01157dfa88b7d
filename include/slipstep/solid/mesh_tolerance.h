// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_mesh_tolerance_h
#define slipstep_solid_mesh_tolerance_h

#include <slipstep/experiment/summary.h>
#include <slipstep/solid/mesh_marker.h>

#include <string>

namespace SlipStep
{
  /// Whether the steps that were accepted met the tolerance of an adaptive
  /// mesh, and what kept it from being finer where they did not.
  class MeshTolerance
  {
  public:
    explicit MeshTolerance(const RefinementParameters &refinement);

    /// A step was accepted on a mesh.
    /// @param marked what that mesh should change
    void add(const double time, const MarkedCells &marked);

    const MeshErrorSummary &summary() const
    {
      return record;
    }

    /// What to change in the case, or "" if the tolerance was met.
    std::string remedy() const;

    /// For boost::serialization.
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &record &by_levels &by_cells &by_repeats;
    }

  private:
    const RefinementParameters refinement;
    MeshErrorSummary           record;
    /// Steps that missed it because of ...
    unsigned long long by_levels = 0, by_cells = 0, by_repeats = 0;
  };
} // namespace SlipStep

#endif
