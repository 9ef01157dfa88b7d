// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_experiment_run_recorder_h
#define slipstep_experiment_run_recorder_h

#include <slipstep/experiment/checkpoint.h>
#include <slipstep/experiment/history.h>
#include <slipstep/experiment/programme.h>
#include <slipstep/experiment/run_options.h>
#include <slipstep/experiment/summary.h>
#include <slipstep/experiment/work_estimate.h>
#include <slipstep/friction/law.h>
#include <slipstep/utilities/process.h>
#include <slipstep/utilities/progress.h>

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace SlipStep
{
  /// Write used_parameters.prm, which can be run again.
  /// @param omitted_sections not written: values for what is off are errors
  /// @throws RunError if the disk refuses
  void write_used_parameters(const Parameters            &parameters,
                             const std::filesystem::path &folder,
                             const std::set<std::string> &omitted_sections);

  /// Keeps the files of one run: used_parameters.prm from the beginning,
  /// history.csv row by row, summary.json at the beginning and at the end; and
  /// shows the progress.
  class RunRecorder
  {
  public:
    /// @param is_writer false on all ranks but one: then nothing is written or
    ///   shown
    /// @param resumed the checkpoint from which the run goes on, if it does: the
    ///   history goes back to there
    RunRecorder(const Parameters         &parameters,
                const RunOptions         &options,
                const std::string        &command,
                const FrictionLaw        &law,
                const Programme          &programme,
                const bool                is_writer = true,
                const CheckpointManifest *resumed   = nullptr);

    /// A step was made.
    void record(const HistoryRow &row);

    /// Tell what a checkpoint has to know: the history, and the resources used
    /// by all sessions. The writer only.
    /// @param cpu_time of this session, all ranks [s]
    /// @param peak_memory of this session, all ranks [MB]
    /// @throws RunError if the history cannot be forced onto the disk
    void fill(CheckpointManifest &manifest,
              const double        cpu_time,
              const double        peak_memory) const;

    /// Say something now, unless the run is quiet.
    void announce(const std::string &text);

    /// Warn now, and in the summary.
    void warn(const std::string &text);

    /// The run is over, with a reason if it failed. Completes the summary.
    void finish(const std::string &reason = "");

    /// To be filled with what only the driver knows.
    Summary summary;

    /// What else the progress shall say, e.g. "1200 cells".
    std::string note;

  private:
    const RunOptions  options;
    const Programme   programme;
    const bool        is_writer;
    const std::string shorter_steps; ///< how to have them, in words
    const std::string longer_steps;
    const bool        has_equal_steps;
    bool              has_told_pace = false;
    /// Evaluated at the end.
    const std::vector<QuantityOfInterest> quantities;
    const ResourceUsage                   start;
    ResourceUsage                         earlier; ///< sessions
    std::vector<std::string>              warnings;
    /// What may make steps short or a run fail.
    std::vector<std::string> instabilities;
    HistoryWriter            writer;
    std::vector<HistoryRow>  history;
    Progress                 progress;
    WorkEstimate             work;
  };
} // namespace SlipStep

#endif
