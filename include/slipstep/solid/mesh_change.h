// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_mesh_change_h
#define slipstep_solid_mesh_change_h

#include <limits>

namespace SlipStep
{
  /// A change of the mesh during a run, and what it did to the forces.
  struct MeshChange
  {
    double             time = 0.; ///< of the state that was carried over [s]
    bool               repeats_step = false; ///< or it was done after a step
    unsigned long long n_refined    = 0;     ///< cells
    unsigned long long n_merged     = 0;     ///< parents of merged cells
    unsigned long long n_cells      = 0;     ///< of the new mesh
    unsigned long long n_unknowns   = 0;     ///< of the new mesh
    double error_before = 0.; ///< estimated on the old mesh, relative
    /// Estimated on the new mesh in the step made on it, relative; NaN until
    /// that is looked at.
    double error           = std::numeric_limits<double>::quiet_NaN();
    double tangential_load = 0.; ///< on the old mesh [N]
    double dissipated      = 0.; ///< on the old mesh [N mm]
    /// Integral of the traction as carried over, minus that on the old mesh,
    /// relative to the load (to a tenth of that at full slip, if more).
    double load_jump = 0.;
    /// The same for the dissipated energy (relative to it, or to a hundredth
    /// of the work done so far).
    double dissipation_jump = 0.;
    /// The same two with the forces in equilibrium on the new mesh. The load
    /// differs by what the old mesh was too stiff.
    double equilibrium_load_jump        = 0.;
    double equilibrium_dissipation_jump = 0.;

    /// For boost::serialization.
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &time &repeats_step &n_refined &n_merged &n_cells &n_unknowns
        &error_before &error &tangential_load &dissipated &load_jump &
          dissipation_jump &equilibrium_load_jump &equilibrium_dissipation_jump;
    }
  };
} // namespace SlipStep

#endif
