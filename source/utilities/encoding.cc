// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/encoding.h>

#include <boost/locale/utf.hpp>

namespace SlipStep
{
  namespace
  {
    // Bytes of the character that begins there; none if it is no UTF-8.
    std::size_t length_of_character(const std::string &text,
                                    const std::size_t  begin)
    {
      namespace utf    = boost::locale::utf;
      auto       next  = text.begin() + begin;
      const auto point = utf::utf_traits<char>::decode(next, text.end());
      return utf::is_valid_codepoint(point) ? next - text.begin() - begin : 0;
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
