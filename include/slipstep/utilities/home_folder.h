// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_home_folder_h
#define slipstep_utilities_home_folder_h

#include <filesystem>
#include <string>

namespace SlipStep
{
  /// A name as it is written, with the user's own folder for "~": a shell does
  /// that for the names it sees as words, not for those in a file or behind
  /// "--output=".
  /// @throws InputError for "~name", which would become a folder of that name
  std::filesystem::path with_home(const std::string &name);
} // namespace SlipStep

#endif
