// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_paths_h
#define slipstep_utilities_paths_h

#include <filesystem>
#include <string>

namespace SlipStep
{
  /// A name as it is written, with the user's own folder for "~": a shell does
  /// that for the names it sees as words, not for those in a file or behind
  /// "--output=".
  /// @throws InputError for "~name", which would become a folder of that name
  std::filesystem::path with_home(const std::string &name);

  /// How to name a file in another file that stands in @p folder: relative, so
  /// that both can be moved together, unless they have but the root in common.
  std::string path_from(const std::filesystem::path &folder,
                        const std::filesystem::path &file);
} // namespace SlipStep

#endif
