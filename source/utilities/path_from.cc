// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/path_from.h>

namespace SlipStep
{
  namespace fs = std::filesystem;

  namespace
  {
    fs::path first_below_root(const fs::path &path)
    {
      const fs::path below = path.relative_path();
      return below.empty() ? fs::path() : *below.begin();
    }
  } // namespace



  std::string path_from(const fs::path &folder, const fs::path &file)
  {
    const fs::path from = fs::weakly_canonical(fs::absolute(folder)),
                   to   = fs::weakly_canonical(fs::absolute(file));
    return (first_below_root(from) == first_below_root(to) ?
              to.lexically_relative(from) :
              to)
      .generic_string();
  }
} // namespace SlipStep
