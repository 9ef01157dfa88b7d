// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_message_lines_h
#define slipstep_utilities_message_lines_h

#include <string>

namespace SlipStep
{
  /// The first lines with something in them, in one: deal.II's messages are
  /// pages.
  std::string essential_lines(const std::string &text,
                              const unsigned int n_lines);

  /// A message whose lines have a length that can be read.
  std::string readable(const std::string &message);
} // namespace SlipStep

#endif
