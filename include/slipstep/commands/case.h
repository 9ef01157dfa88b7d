// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_commands_case_h
#define slipstep_commands_case_h

#include <slipstep/experiment/run_options.h>
#include <slipstep/measured_data/measured_test.h>
#include <slipstep/utilities/command_line.h>
#include <slipstep/utilities/parameters.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace SlipStep
{
  /// Declare the parameters of all rooms, in the order in which they are
  /// printed.
  void declare_all_parameters(Parameters &parameters);

  /// All parameters with their defaults.
  Parameters declared_parameters();

  /// Take over the options --set.
  /// @throws InputError
  void apply_settings(const CommandLine &line, Parameters &parameters);

  /// A case with its complete parameter sets: one per variant, or one.
  struct Case
  {
    Parameters              parameters;
    std::vector<Variant>    variants;
    std::vector<Parameters> complete;
    /// With --variant: the one to run, which is then no sweep.
    Variant selected;
    /// As the file and --sweep have them, before --set.
    std::size_t n_variants_written = 0;

    bool is_sweep() const
    {
      return !variants.empty();
    }
  };

  /// @throws InputError
  Case read_case(const std::filesystem::path &file, const CommandLine &line);

  /// The same for a command that takes one case and fits points to it: checked,
  /// with a folder for its results that may be written, and with a warning of
  /// what points do not have.
  /// @throws InputError, also for a sweep
  Case read_single_case(const CommandLine &line);

  /// check_case() for all runs of a case.
  /// @throws InputError naming the variant
  void check_all(const Case &the_case);

  /// What was done to the rows of tests that programmes follow, each once.
  std::vector<std::string> warnings_of_programmes(const Case &the_case);

  /// That --set has the last word on what variants differ in, of which some are
  /// equal then, or all.
  std::vector<std::string> warnings_of_equal_variants(const Case &the_case);

  /// Tests whose pressure is a load over another area than that of the block.
  std::vector<std::string>
  warnings_of_areas(const Parameters                &parameters,
                    const std::vector<MeasuredTest> &tests);

  /// The same of tests that programmes follow.
  std::vector<std::string> warnings_of_followed_areas(const Case &the_case);

  /// That maps of the block's face do not act on contact points, which point,
  /// calibrate and diagnose compute, and are no part of the law.
  std::vector<std::string> warnings_of_face(const Case &the_case);

  /// Where the results of a case go; of one variant, its own folder.
  std::filesystem::path chosen_output(const Case        &the_case,
                                      const CommandLine &line);

  /// What such a command passes on.
  RunOptions options_of(const Case &the_case, const CommandLine &line);

  /// check_output_folder() for all runs of a case.
  /// @throws InputError
  void check_output(const Case &the_case, const CommandLine &line);

  /// Sections that mean nothing in a case, e.g. of effects that are off: values
  /// given there would be errors.
  /// @throws InputError
  std::set<std::string> inactive_sections(const Parameters &parameters);

  /// Read everything that a case says as run() and point() would, without
  /// computing.
  /// @throws InputError
  void check_case(const Parameters &parameters);

  /// Refuse a block that this computer, or @p n_processes of its kind, cannot
  /// hold in memory, and a machine in series with a block.
  /// @throws InputError
  void check_block(const Parameters  &parameters,
                   const unsigned int n_processes);
} // namespace SlipStep

#endif
