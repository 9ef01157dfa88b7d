// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_commands_commands_h
#define slipstep_commands_commands_h

#include <slipstep/commands/outcome.h>

namespace SlipStep
{
  /// Read the command line and do what it says.
  Outcome start(const int argc, char **argv);
} // namespace SlipStep

#endif
