// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_commands_sweep_h
#define slipstep_commands_sweep_h

#include <slipstep/commands/case.h>

#include <filesystem>

#include <string>
#include <vector>

namespace SlipStep
{
  /// A program to be run for one variant.
  struct SweepJob
  {
    std::string              label;
    std::vector<std::string> arguments; ///< the first is the executable
  };

  /// This program once more, for one run of many; options --set are to be
  /// added.
  /// @param output folder of the run
  /// @param member the folder of the run of the line, or ""
  SweepJob child_job(const CommandLine           &line,
                     const std::string           &command,
                     const std::string           &label,
                     const std::filesystem::path &output,
                     const std::string           &member);

  /// Run the jobs as child processes, side by side on the cores, and show one
  /// progress for all. What a child writes to stderr is passed on with its
  /// label; a failed job does not stop the others. On a signal to stop the
  /// children are stopped, and then this process ends by the same signal.
  /// @param n_parallel at most so many at once; 0 = one per core
  /// @param is_resumable if not, a signal is left to the caller
  /// @return the exit codes in the order of the jobs; 1 for a killed child
  std::vector<int> run_side_by_side(const std::vector<SweepJob> &jobs,
                                    const std::string           &label,
                                    const bool                   quiet,
                                    const unsigned int           n_parallel = 0,
                                    const bool is_resumable = true);

  /// Write a job array for Slurm, whose jobs compute a variant each, into the
  /// file that --slurm names.
  /// @param output where the sweep's results go
  /// @throws InputError if the case is no sweep, or the file is there already
  int write_job_array(const Case                  &the_case,
                      const CommandLine           &line,
                      const std::filesystem::path &output);
} // namespace SlipStep

#endif
