// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_commands_diagnose_h
#define slipstep_commands_diagnose_h

#include <slipstep/utilities/command_line.h>

namespace SlipStep
{
  /// The command `slipstep diagnose`.
  /// @throws InputError, RunError
  int diagnose_case(const CommandLine &line);
} // namespace SlipStep

#endif
