// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_commands_run_h
#define slipstep_commands_run_h

#include <slipstep/commands/outcome.h>
#include <slipstep/utilities/command_line.h>

namespace SlipStep
{
  /// The commands `slipstep run` and `slipstep point`: a case, or the members
  /// of a sweep side by side, with their report.
  Outcome run(const CommandLine &line);
} // namespace SlipStep

#endif
