// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_commands_commands_h
#define slipstep_commands_commands_h

#include <slipstep/commands/outcome.h>
#include <slipstep/experiment/run_options.h>
#include <slipstep/experiment/summary.h>
#include <slipstep/utilities/command_line.h>

#include <filesystem>

namespace SlipStep
{
  /// The whole program: read the command line, do what it says, and tell of
  /// what went wrong.
  /// @param file the file that children are started from
  /// @return the exit code
  int program(const int argc, char **argv, const std::filesystem::path &file);

  /// @name The commands, each in a file of its own. They return the exit code,
  /// or more if they have something to say about every case.
  /// @throws InputError, before anything is written, or RunError
  ///@{

  /// `slipstep run` and `slipstep point`: a case, or the members of a sweep
  /// side by side, with their report.
  Outcome run(const CommandLine &line);

  /// `slipstep check`: cases, measured tests, folders of them, and maps of
  /// `slipstep import`, each with its own message.
  Outcome check(const CommandLine &line);

  /// `slipstep compare`: results of several runs in one page, beside measured
  /// tests.
  int compare_results(const CommandLine &line);

  /// `slipstep refine`: run the meshes and time steps of a study as child
  /// processes and report how the quantities of interest converge. Fails if one
  /// of the runs does.
  int refine_block(const CommandLine &line);

  /// `slipstep calibrate`
  int calibrate_case(const CommandLine &line);

  /// `slipstep diagnose`
  int diagnose_case(const CommandLine &line);

  /// `slipstep import MAP.prm [RAW]`: convert files of instruments into
  /// measured tests. RAW is the file, or the folder of the files, instead of
  /// the folder of the map. `slipstep import RAW` without a map looks at the
  /// file, writes a map for it (RAW_map.prm), and a page that shows what it
  /// makes of the record.
  ///
  /// The tests go into the folder `measured` beside the map, or that of
  /// --output. Nothing is written before all of them are converted and fit
  /// together, see check_conditions().
  int import_tests(const CommandLine &line);

  /// `slipstep export`: write the law of a case for other programs.
  int export_law(const CommandLine &line);

  /// `slipstep plant FOLDER`: make a campaign of tests with a hidden effect,
  /// FOLDER/case.prm, FOLDER/measured/*.csv and FOLDER/answer.sealed; or
  /// `slipstep plant --open FILE`: print such an answer.
  ///
  /// Nothing is written before everything is computed, and never into a folder
  /// that has something in it.
  int plant(const CommandLine &line);

  /// `slipstep parameters [import] [NAME ...]`: all parameters of a case, or of
  /// a map, with their defaults, or only those of keys and sections.
  int print_parameters(const CommandLine &line);
  ///@}

  /// @name What one command does for another
  ///@{

  /// The block through its programme, with all its files. Called by all ranks;
  /// rank 0 writes.
  /// @return the summary, with status "failed" and the reason if the programme
  ///   could not be finished; what was computed is kept
  Summary run_block(const Parameters &parameters, const RunOptions &options);

  /// The case on one contact point, with all its files.
  Summary run_point(const Parameters &parameters, const RunOptions &options);

  /// Whether a file is a map of `slipstep import`, by its sections; false for
  /// what cannot be read.
  bool is_import_map(const std::filesystem::path &file);

  /// Read such a map without its raw files and say that it is fine.
  /// @throws InputError for unknown keys and values that are not allowed
  void check_import_map(const std::filesystem::path &file,
                        const CommandLine           &line);
  ///@}
} // namespace SlipStep

#endif
