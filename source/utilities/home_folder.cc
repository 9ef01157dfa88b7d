// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/home_folder.h>
#include <slipstep/utilities/pattern_words.h>

#include <algorithm>
#include <cstdlib>

namespace SlipStep
{
  std::filesystem::path with_home(const std::string &name)
  {
    if (name.empty() || name.front() != '~')
      return name;
    const char *const home = std::getenv("HOME");
    if (name.size() > 1 && name[1] != '/')
      throw InputError(excerpt(name) +
                       ": of home folders only one's own is known, as ~/; "
                       "write the whole path, or ./" +
                       excerpt(name));
    if (home == nullptr || *home == '\0')
      throw InputError(excerpt(name) +
                       ": HOME is not set, so ~ means nothing; write the whole "
                       "path");
    return std::filesystem::path(home) /
           name.substr(std::min<std::size_t>(2, name.size()));
  }
} // namespace SlipStep
