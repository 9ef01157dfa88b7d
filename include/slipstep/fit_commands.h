#ifndef slipstep_fit_commands_h
#define slipstep_fit_commands_h

#include <slipstep/utilities/command_line.h>

namespace SlipStep
{
  /// @name The commands that fit a case to measured tests.
  /// @throws InputError, RunError
  ///@{
  void calibrate_case(const CommandLine &line);

  /// The block is simulated by processes of their own, one per core.
  void diagnose_case(const CommandLine &line);
  ///@}
} // namespace SlipStep

#endif
