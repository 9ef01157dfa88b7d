// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_refinement_parameters_h
#define slipstep_solid_refinement_parameters_h

#include <slipstep/utilities/parameters.h>

#include <set>
#include <string>

namespace SlipStep
{
  /// How the mesh of the block is made from its subdivisions.
  enum class RefinementType
  {
    none,
    uniform, ///< all cells are halved, a number of times
    adaptive ///< where the solution asks for it, during the run
  };

  /// Memory of this machine [MB].
  double installed_memory();

  /// What an adaptive mesh is to be good for, see mesh_goal.h.
  enum class MeshGoal : int;

  /// `set Refinement = none | uniform N | adaptive N`, and the section that
  /// belongs to the last of them.
  struct RefinementParameters
  {
    RefinementType type = RefinementType::none;
    /// Halvings of a subdivision: all of them, or at most.
    unsigned int levels = 0;

    // Adaptive only.
    /// Estimated error for which cells are refined, relative, in the norm of
    /// the goal.
    double tolerance = 0.;
    /// Cells are merged if the expected error of their parent is below this
    /// share of that for which it would be refined.
    double       merging_share  = 0.;
    unsigned int check_interval = 1; ///< steps
    unsigned int most_repeats   = 0; ///< of a step on new meshes
    double       most_cells     = 0.;
    double       most_memory    = 0.; ///< [MB]
    bool         stop_at_cap    = true;
    MeshGoal     goal;

    static void declare_parameters(Parameters &parameters);

    /// @throws InputError, also for values given to adaptivity when it is off
    explicit RefinementParameters(const Parameters &parameters);

    /// Sections that mean nothing with this kind of refinement.
    static std::set<std::string>
    inactive_sections(const Parameters &parameters);

    /// Cells that one cell of the subdivisions has become at the beginning,
    /// per direction.
    unsigned int initial_cells_per_subdivision() const
    {
      return type == RefinementType::uniform ? 1u << levels : 1u;
    }
  };
} // namespace SlipStep

#endif
