// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_commands_check_h
#define slipstep_commands_check_h

#include <slipstep/commands/outcome.h>
#include <slipstep/utilities/command_line.h>

namespace SlipStep
{
  /// The command `slipstep check`: cases, measured tests, folders of them, and
  /// maps of `slipstep import`, each with its own message.
  Outcome check(const CommandLine &line);
} // namespace SlipStep

#endif
