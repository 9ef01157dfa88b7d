// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/exceptions.h>

#include <slipstep/commands/commands.h>
#include <slipstep/utilities/process.h>
#include <slipstep/utilities/write_file.h>

#include <csignal>
#include <iostream>

int main(int argc, char **argv)
{
  SlipStep::open_closed_descriptors();
  // A file that grows too large is a failed write, reported as such.
  std::signal(SIGXFSZ, SIG_IGN);
  // A wish for a checkpoint does no harm where there is none; children inherit
  // this until they can listen.
  std::signal(SIGUSR1, SIG_IGN);
  dealii::deal_II_exceptions::disable_abort_on_exception();
  dealii::deal_II_exceptions::suppress_stacktrace_in_exceptions();
  SlipStep::Outcome outcome = SlipStep::start(argc, argv);
  if (!std::cout.flush() && outcome.exit_code == SlipStep::done)
    outcome = {SlipStep::run_failed,
               SlipStep::write_failure("the output").what()};
  // Under mpirun every rank finds the same errors in the input.
  if (!outcome.message.empty() && SlipStep::launched_rank() == 0)
    std::cerr << outcome.message << std::endl;
  SlipStep::SignalGuard::obey();
  return outcome.exit_code;
}
