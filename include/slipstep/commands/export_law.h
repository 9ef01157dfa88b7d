// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_commands_export_law_h
#define slipstep_commands_export_law_h

#include <slipstep/utilities/command_line.h>

namespace SlipStep
{
  /// The command `slipstep export`: writes the law of a case for other
  /// programs.
  /// @throws InputError
  int export_law(const CommandLine &line);
} // namespace SlipStep

#endif
