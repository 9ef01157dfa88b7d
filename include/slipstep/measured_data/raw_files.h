// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_raw_files_h
#define slipstep_measured_data_raw_files_h

#include <slipstep/utilities/csv.h>
#include <slipstep/utilities/parameters.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace SlipStep
{
  /// A raw file, and what the wildcards of its pattern stood for: "1", "2", ...
  struct RawFile
  {
    std::filesystem::path              file;
    std::map<std::string, std::string> found;
  };

  /// Whether a name has wildcards.
  bool has_wildcards(const std::string &name);

  /// Whether @p name has this pattern: * stands for any letters, as few as will
  /// do, ? for one.
  /// @param found what each wildcard stands for
  bool matches_pattern(const std::string                  &name,
                       const std::string                  &pattern,
                       std::map<std::string, std::string> &found);

  /// The files of a pattern, in the order of their names. Wildcards are in the
  /// name, not in the folder.
  /// @throws InputError if there is none
  std::vector<RawFile> files_of_pattern(const std::filesystem::path &pattern);

  /// The files that a key of a case names, separated by commas: relative to its
  /// folder, with wildcards, or folders as they are.
  /// @throws InputError for what is not there
  std::vector<std::filesystem::path> named_files(const Parameters  &parameters,
                                                 const std::string &key);

  /// The text with values in place of {names}.
  /// @throws InputError for a name that is not there, listing those that are
  std::string filled_in(const std::string                        &text,
                        const std::map<std::string, std::string> &values);

  /// How a map says that its raw file is written.
  /// @throws InputError naming the place in the map
  CsvFormat raw_format(const Parameters &map);
} // namespace SlipStep

#endif
