// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_path_from_h
#define slipstep_utilities_path_from_h

#include <filesystem>
#include <string>

namespace SlipStep
{
  /// How to name a file in another file that stands in @p folder: relative, so
  /// that both can be moved together, unless they have but the root in common.
  std::string path_from(const std::filesystem::path &folder,
                        const std::filesystem::path &file);
} // namespace SlipStep

#endif
