// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_commands_run_checkpoints_h
#define slipstep_commands_run_checkpoints_h

#include <slipstep/experiment/checkpoint.h>
#include <slipstep/experiment/run_recorder.h>
#include <slipstep/solid/block.h>

#include <chrono>
#include <optional>
#include <string>

namespace SlipStep
{
  /// The checkpoints of a run of the block. All functions are called by all
  /// ranks, which take the same decisions; the first one keeps the files.
  class RunCheckpoints
  {
  public:
    /// @param resume look for a checkpoint to go on from
    /// @throws InputError if there are only such that cannot be used
    RunCheckpoints(const Parameters            &parameters,
                   const std::filesystem::path &output,
                   const bool                   resume,
                   const MPI_Comm              &communicator);

    /// The checkpoint from which the run goes on, or nullptr.
    const CheckpointManifest *found() const
    {
      return manifest ? &*manifest : nullptr;
    }

    /// Put the block into the state of the checkpoint that was found, and tell
    /// the user; or that there is none although one was wanted.
    template <int dim>
    void
    resume(Block<dim> &block, BlockOutput<dim> &fields, RunRecorder &recorder);

    /// Between two steps: write a checkpoint if it is time, if SIGUSR1 came, or
    /// if a signal stops the run. If that fails, the run goes on with a
    /// warning.
    /// @throws RunError if the run was stopped
    template <int dim>
    void write_if_due(const Block<dim>       &block,
                      const BlockOutput<dim> &fields,
                      RunRecorder            &recorder);

    /// Whether a signal came so long ago that the end of the step is not to be
    /// waited for, on any rank.
    bool cannot_wait() const;

    /// The run is finished: checkpoints have no use any more.
    void remove();

  private:
    template <int dim>
    std::string write(const Block<dim>       &block,
                      const BlockOutput<dim> &fields,
                      const RunRecorder      &recorder);

    using Clock = std::chrono::steady_clock;

    const Parameters                  parameters;
    const MPI_Comm                    communicator;
    const bool                        is_first_rank;
    const bool                        is_wanted;
    const double                      period; ///< [s]
    CheckpointStore                   store;
    std::optional<CheckpointManifest> manifest;
    std::vector<std::string>          warnings;
    unsigned int                      last_step  = 0; ///< with a checkpoint
    bool                              has_failed = false;
    Clock::time_point                 last_time;
  };
} // namespace SlipStep

#endif
