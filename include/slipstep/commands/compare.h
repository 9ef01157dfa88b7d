// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_commands_compare_h
#define slipstep_commands_compare_h

#include <slipstep/utilities/command_line.h>

namespace SlipStep
{
  /// `slipstep compare`: results of several runs in one page, beside measured
  /// tests.
  /// @throws InputError for a folder without results, or a wrong test
  int compare_results(const CommandLine &line);
} // namespace SlipStep

#endif
