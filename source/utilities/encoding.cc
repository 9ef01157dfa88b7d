// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/encoding.h>

namespace SlipStep
{
  namespace
  {
    // Bytes of the character that begins there; none if it is no UTF-8.
    std::size_t length_of_character(const std::string &text,
                                    const std::size_t  begin)
    {
      const unsigned char first = text[begin];
      const unsigned char second =
        begin + 1 < text.size() ? text[begin + 1] : '\0';
      // The last four: longer than they need to be, of UTF-16, beyond all.
      if (first >= 0xF5 || (first & 0xC0) == 0x80 || first == 0xC0 ||
          first == 0xC1 || (first == 0xE0 && second < 0xA0) ||
          (first == 0xED && second >= 0xA0) ||
          (first == 0xF0 && second < 0x90) || (first == 0xF4 && second >= 0x90))
        return 0;
      const std::size_t length = first >= 0xF0 ? 4 :
                                 first >= 0xE0 ? 3 :
                                 first >= 0xC0 ? 2 :
                                                 1;
      for (std::size_t i = 1; i < length; ++i)
        if (begin + i >= text.size() || (text[begin + i] & 0xC0) != 0x80)
          return 0;
      return length;
    }
  } // namespace



  bool is_utf8(const std::string &text)
  {
    for (std::size_t i = 0; i < text.size();)
      {
        const std::size_t length = length_of_character(text, i);
        if (length == 0)
          return false;
        i += length;
      }
    return true;
  }



  std::string to_utf8(const std::string &text)
  {
    if (is_utf8(text))
      return text;
    std::string result;
    for (std::size_t i = 0; i < text.size();)
      if (const std::size_t length = length_of_character(text, i); length > 0)
        {
          result += text.substr(i, length);
          i += length;
        }
      else
        {
          const unsigned char byte = text[i++];
          result += static_cast<char>(0xC0 | (byte >> 6));
          result += static_cast<char>(0x80 | (byte & 0x3F));
        }
    return result;
  }



  std::string readable_text(const std::string &text)
  {
    std::string result;
    for (std::size_t i = 0; i < text.size();)
      {
        const std::size_t length = length_of_character(text, i);
        const bool        is_unseen =
          length == 0 ||
          (length == 1 && (text[i] < ' ' || text[i] == '\x7f')) ||
          // The second half of the control characters.
          (length == 2 && text[i] == '\xC2' &&
           static_cast<unsigned char>(text[i + 1]) < 0xA0);
        result += is_unseen ? "?" : text.substr(i, length);
        i += is_unseen && length == 0 ? 1 : length;
      }
    return result;
  }
} // namespace SlipStep
