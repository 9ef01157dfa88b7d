// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_commands_refine_block_h
#define slipstep_commands_refine_block_h

#include <slipstep/utilities/command_line.h>

namespace SlipStep
{
  /// `slipstep refine`: run the meshes and time steps of a study as child
  /// processes and report how the quantities of interest converge.
  /// @return the exit code: 1 if one of the runs failed
  /// @throws InputError before anything is written
  int refine_block(const CommandLine &line);
} // namespace SlipStep

#endif
