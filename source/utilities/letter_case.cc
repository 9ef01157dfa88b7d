// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/letter_case.h>

namespace SlipStep
{
  std::string lower_case(const std::string_view text)
  {
    std::string result(text);
    for (char &c : result)
      if (c >= 'A' && c <= 'Z')
        c = static_cast<char>(c - 'A' + 'a');
    return result;
  }



  bool is_same_word(const std::string_view a, const std::string_view b)
  {
    return a.size() == b.size() && lower_case(a) == lower_case(b);
  }
} // namespace SlipStep
