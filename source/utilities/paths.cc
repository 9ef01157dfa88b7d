// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/paths.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cstdlib>

namespace SlipStep
{
  namespace fs = std::filesystem;

  fs::path with_home(const std::string &name)
  {
    if (name.empty() || name.front() != '~')
      return name;
    const char *const home = std::getenv("HOME");
    if (name.size() > 1 && name[1] != '/')
      throw InputError(excerpt(name) +
                       ": only your own home folder is known, as ~/; write the "
                       "whole path, or ./" +
                       excerpt(name));
    if (home == nullptr || *home == '\0')
      throw InputError(excerpt(name) +
                       ": HOME is not set, so ~ means nothing; write the whole "
                       "path");
    return fs::path(home) / name.substr(std::min<std::size_t>(2, name.size()));
  }



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
