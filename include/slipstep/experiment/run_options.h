// SPDX-License-Identifier: LGPL-2.1-or-later
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
} // namespace SlipStep

#endif
