// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_commands_print_parameters_h
#define slipstep_commands_print_parameters_h

#include <slipstep/utilities/command_line.h>

namespace SlipStep
{
  /// The command `slipstep parameters [import] [NAME ...]`: all parameters of a
  /// case, or of a map, with their defaults, or only those of keys and
  /// sections.
  /// @throws InputError
  int print_parameters(const CommandLine &line);
} // namespace SlipStep

#endif
