// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_letter_case_h
#define slipstep_utilities_letter_case_h

#include <string>
#include <string_view>

namespace SlipStep
{
  /// The text with small letters for capitals (ASCII only: other letters and
  /// the locale do not matter).
  std::string lower_case(const std::string_view text);

  /// Whether two words differ in capitals only.
  bool is_same_word(const std::string_view a, const std::string_view b);
} // namespace SlipStep

#endif
