// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_commands_job_array_h
#define slipstep_commands_job_array_h

#include <slipstep/commands/case.h>
#include <slipstep/utilities/command_line.h>

#include <filesystem>

namespace SlipStep
{
  /// Write a job array for Slurm, whose jobs compute a variant each, into the
  /// file that --slurm names.
  /// @param output where the sweep's results go
  /// @throws InputError if the case is no sweep, or the file is there already
  int write_job_array(const Case                  &the_case,
                      const CommandLine           &line,
                      const std::filesystem::path &output);
} // namespace SlipStep

#endif
