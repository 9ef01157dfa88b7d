// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/decimal_comma.h>

#include <algorithm>
#include <cctype>

namespace SlipStep
{
  std::string decimal_comma_hint(const std::string &text)
  {
    const auto is_digit = [&](const std::size_t i) {
      return i < text.size() && text[i] >= '0' && text[i] <= '9';
    };
    std::size_t comma = std::string::npos;
    while ((comma = text.find(',', comma + 1)) != std::string::npos)
      {
        std::size_t begin = comma, end = comma + 1;
        while (begin > 0 && is_digit(begin - 1))
          --begin;
        while (is_digit(end))
          ++end;
        const bool is_number = begin < comma && end > comma + 1;
        // The exponent of 1e-3 is no number.
        if (begin > 1 && (text[begin - 1] == '-' || text[begin - 1] == '+') &&
            std::isalnum(static_cast<unsigned char>(text[begin - 2])) != 0)
          continue;
        const char before = begin == 0 ? ' ' : text[begin - 1];
        const bool is_list =
          end < text.size() && text[end] == ',' && is_digit(end + 1);
        const char after   = end == text.size() ? ' ' : text[end];
        const bool is_pair = before == '(' && after == ')';
        if (is_number && before != '.' && before != ',' && before != '_' &&
            std::isalnum(static_cast<unsigned char>(before)) == 0 &&
            after != '.' && !is_list && !is_pair)
          {
            // With its exponent and unit.
            end = std::min(text.find_first_of(",;)", end), text.size());
            return "decimals begin with a point: " +
                   text.substr(begin, comma - begin) + "." +
                   text.substr(comma + 1, end - comma - 1);
          }
      }
    return "";
  }
} // namespace SlipStep
