// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/version.h>

#include <slipstep_git_hash.h>

namespace SlipStep
{
  const char *version()
  {
    return SLIPSTEP_VERSION;
  }



  const char *git_hash()
  {
    return SLIPSTEP_GIT_HASH;
  }
} // namespace SlipStep
