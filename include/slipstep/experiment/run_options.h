#ifndef slipstep_experiment_run_options_h
#define slipstep_experiment_run_options_h

#include <slipstep/utilities/parameters.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace SlipStep
{
  /// What a driver is told besides the parameters.
  struct RunOptions
  {
    /// Where results go; exists when a driver is called.
    std::filesystem::path output;
    /// No progress, no tables.
    bool quiet = false;
    /// Of the variant, or "" for a single run.
    std::string label;
    /// Sections to leave out of used_parameters.prm, because giving values
    /// there would be an error; those of the law need not be named.
    std::set<std::string> inactive_sections;
    /// Go on from the checkpoint in the output folder.
    bool resume = false;
  };

  /// Declares section "Output": the folder.
  void declare_output_parameters(Parameters &parameters);

  /// The folder of a case: "Output/Directory", with {case} replaced by the name
  /// of the .prm file, relative to the working directory.
  /// @throws InputError if it is empty
  std::filesystem::path output_folder(const Parameters &parameters);

  /// Check that results may be written into @p folder, which need not exist,
  /// without writing anything.
  /// @param origin what a message names: "--output", "Output/Directory"
  /// @throws InputError if it cannot be created, is read-only, or holds files
  /// but no result of this program (which would be overwritten).
  void check_output_folder(const std::filesystem::path &folder,
                           const std::string           &origin);

  /// Create the folder with its parents.
  /// @throws InputError if that fails
  void create_output_folder(const std::filesystem::path &folder);

  /// Remove the history, summary, report and checkpoints of an earlier run, so
  /// that a run that fails early does not seem to have written them.
  void remove_earlier_results(const std::filesystem::path &folder);
} // namespace SlipStep

#endif
