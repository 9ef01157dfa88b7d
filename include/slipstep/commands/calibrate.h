// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_commands_calibrate_h
#define slipstep_commands_calibrate_h

#include <slipstep/utilities/command_line.h>

namespace SlipStep
{
  /// The command `slipstep calibrate`.
  /// @throws InputError, RunError
  int calibrate_case(const CommandLine &line);
} // namespace SlipStep

#endif
