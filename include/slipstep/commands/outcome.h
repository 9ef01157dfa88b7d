// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_commands_outcome_h
#define slipstep_commands_outcome_h

#include <functional>
#include <string>

namespace SlipStep
{
  /// What the shell is told.
  enum ExitCode
  {
    done        = 0,
    run_failed  = 1,
    input_wrong = 2
  };

  /// How a command ended, and what is still to be said about it.
  struct Outcome
  {
    int         exit_code = done;
    std::string message;
  };

  /// Do the work and turn what it throws into an exit code and one message.
  Outcome guarded(const std::function<int()> &work);

  /// The outcome of all ranks, with one of them to speak. If a rank failed
  /// alone, the others wait for it somewhere in the middle of the run: after a
  /// while it takes them down, with its message printed before.
  Outcome agreed(Outcome outcome);

  /// guarded() with MPI from here to its end; the message is printed.
  Outcome guarded_with_mpi(const std::function<int()> &work);
} // namespace SlipStep

#endif
