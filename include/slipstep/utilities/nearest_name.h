// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_nearest_name_h
#define slipstep_utilities_nearest_name_h

#include <string>
#include <vector>

namespace SlipStep
{
  /// The candidate closest to @p name in edit distance (case ignored), or "" if
  /// none is near enough to be meant.
  std::string nearest_name(const std::string              &name,
                           const std::vector<std::string> &candidates);

  /// "; did you mean X?", or "" if nothing is near: the end of a message.
  std::string did_you_mean(const std::string              &name,
                           const std::vector<std::string> &candidates);
} // namespace SlipStep

#endif
