// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/attempt_together.h>

namespace SlipStep
{
  std::string agreed(const std::string &reason, const MPI_Comm &communicator)
  {
    // Asked in every step: reasons are sent only if there are any.
    const unsigned int has_failed = reason.empty() ? 0 : 1;
    if (dealii::Utilities::MPI::max(has_failed, communicator) == 0)
      return "";
    for (const std::string &other :
         dealii::Utilities::MPI::all_gather(communicator, reason))
      if (!other.empty())
        return other;
    return "";
  }
} // namespace SlipStep
