// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_commands_results_folder_h
#define slipstep_commands_results_folder_h

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace SlipStep
{
  /// Check that results may be written into @p folder, which need not exist,
  /// without writing anything.
  /// @param origin what a message names: "--output", "Output/Directory"
  /// @throws InputError if it cannot be created, is read-only, or holds files
  /// but no result of this program (which would be overwritten).
  void check_output_folder(const std::filesystem::path &folder,
                           const std::string           &origin);

  /// Remove the history, summary, report and checkpoints of an earlier run, so
  /// that a run that fails early does not seem to have written them.
  void remove_earlier_results(const std::filesystem::path &folder);

  /// Folders within one of results that have finished runs of the same command
  /// but are none of these: a pattern like results/*/history.csv would take
  /// them for results of the present run.
  std::vector<std::string>
  other_runs_in(const std::filesystem::path    &folder,
                const std::string              &command,
                const std::vector<std::string> &members);

  /// A folder in which one command of one process writes results, for as long
  /// as this object lives. It holds a file `.slipstep`, locked meanwhile, which
  /// names command, process and case. A folder that nothing was written into
  /// goes again.
  class ResultsFolder
  {
  public:
    /// Create the folder with its parents and lock it. Warns if it holds
    /// results of another case that is still there.
    /// @param case_file "" where there is none
    /// @param patience how long to wait for another process that has it
    /// @throws InputError if that fails, if another process keeps it, or if it
    /// holds results of another command
    ResultsFolder(
      const std::filesystem::path &folder,
      const std::string           &command,
      const std::filesystem::path &case_file,
      const std::chrono::seconds   patience = std::chrono::seconds(2));

    ~ResultsFolder();

    ResultsFolder(const ResultsFolder &)            = delete;
    ResultsFolder &operator=(const ResultsFolder &) = delete;

  private:
    void lock(const std::string           &command,
              const std::filesystem::path &case_file,
              const std::chrono::seconds   patience);

    void release() noexcept;

    std::filesystem::path folder;
    /// The uppermost folder that had to be created.
    std::filesystem::path first_created;
    /// Of the marker; it has the lock.
    int descriptor = -1;
  };
} // namespace SlipStep

#endif
