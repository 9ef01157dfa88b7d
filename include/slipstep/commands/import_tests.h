// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_commands_import_tests_h
#define slipstep_commands_import_tests_h

#include <slipstep/utilities/command_line.h>

#include <filesystem>

namespace SlipStep
{
  /// Whether a file is such a map, by its sections; false for what cannot be
  /// read.
  bool is_import_map(const std::filesystem::path &file);

  /// Read a map without its raw files and say that it is fine.
  /// @throws InputError for unknown keys and values that are not allowed
  void check_import_map(const std::filesystem::path &file,
                        const CommandLine           &line);

  /// The command `slipstep import MAP.prm [RAW]`: convert files of instruments
  /// into measured tests, one per variant of the map. RAW is the file, or the
  /// folder of the files, instead of the folder of the map.
  ///
  /// The tests go into the folder `measured` beside the map, or that of
  /// --output. Nothing is written before all of them are converted and fit
  /// together, see check_conditions().
  /// @return exit code
  int import_tests(const CommandLine &line);
} // namespace SlipStep

#endif
