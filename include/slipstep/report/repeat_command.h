// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_repeat_command_h
#define slipstep_report_repeat_command_h

#include <slipstep/utilities/parameters.h>

#include <string>

namespace SlipStep
{
  /// How the user calls the program with a case: "slipstep point case.prm", or
  /// by the script that was used, or under mpirun.
  std::string program_call(const std::string &command,
                           const std::string &file,
                           const unsigned int n_ranks = 1);

  /// The options --set and --sweep that the user gave, each preceded by a
  /// blank.
  std::string given_settings(const Parameters &parameters);
} // namespace SlipStep

#endif
