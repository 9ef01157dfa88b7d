// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_encoding_h
#define slipstep_utilities_encoding_h

#include <string>

namespace SlipStep
{
  bool is_utf8(const std::string &text);

  /// With each byte that is no UTF-8 taken for a letter of Latin-1.
  std::string to_utf8(const std::string &text);

  /// The text with a question mark for each byte that is no UTF-8 or cannot be
  /// seen: files of measured data hold anything.
  std::string readable_text(const std::string &text);
} // namespace SlipStep

#endif
