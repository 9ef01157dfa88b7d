// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_decimal_comma_h
#define slipstep_utilities_decimal_comma_h

#include <string>

namespace SlipStep
{
  /// "decimals begin with a point: 0.05" if a number such as 0,05 is in the
  /// text; "" if there is none. Commas in a list of more numbers without blanks
  /// (4,4,4), and one alone in parentheses, are no decimals.
  std::string decimal_comma_hint(const std::string &text);
} // namespace SlipStep

#endif
