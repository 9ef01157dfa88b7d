// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <slipstep/utilities/text.h>
#include <slipstep/utilities/units.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <sstream>

namespace SlipStep
{
  std::string exact_text(const double value)
  {
    std::array<char, 32> buffer;
    const auto           result =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return std::string(buffer.data(), result.ptr);
  }



  std::string rounded_text(const double value, const unsigned int n_digits)
  {
    std::array<char, 64> buffer;
    const auto           result  = std::to_chars(buffer.data(),
                                      buffer.data() + buffer.size(),
                                      value,
                                      std::chars_format::scientific,
                                      n_digits - 1);
    double               rounded = value;
    std::from_chars(buffer.data(), result.ptr, rounded);
    return exact_text(rounded == 0. ? 0. : rounded);
  }



  std::string plain_text(const double value, const unsigned int n_digits)
  {
    return std::isfinite(value) ? rounded_text(value, n_digits) : "–";
  }



  std::string fixed_text(const double value, const int decimals)
  {
    if (!std::isfinite(value))
      return "–";
    char buffer[64];
    std::snprintf(buffer, sizeof(buffer), "%.*f", decimals, value);
    // Without the sign of a negative value that is rounded to zero.
    const bool is_zero = std::strspn(buffer, "-0.") == std::strlen(buffer);
    return is_zero && buffer[0] == '-' ? buffer + 1 : buffer;
  }



  std::string friction_text(const double value)
  {
    constexpr double small = 0.01, round_off = 1e-12;
    return std::abs(value) < small && std::abs(value) > round_off ?
             short_text(value, 4) :
             fixed_text(value, 4);
  }



  std::string short_text(const double value, const int significant)
  {
    if (!std::isfinite(value))
      return "–";
    char buffer[64];
    std::snprintf(buffer, sizeof(buffer), "%.*g", significant, value);
    return buffer;
  }



  std::string percent_text(const double share)
  {
    const double percent = 100. * share;
    const double size    = std::abs(percent);
    if (!std::isfinite(percent))
      return "–";
    return (size >= 99.95                ? fixed_text(percent, 0) :
            size >= 9.995                ? fixed_text(percent, 1) :
            size >= 0.0995 || size == 0. ? fixed_text(percent, 2) :
                                           plain_text(percent, 2)) +
           " %";
  }



  std::string speed_text(const double speed)
  {
    return short_text(speed * mm_min) + " mm/min";
  }



  std::string list_text(const std::vector<std::string> &names,
                        const std::string              &before_last)
  {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
      text += (i == 0                ? "" :
               i + 1 == names.size() ? " " + before_last + " " :
                                       ", ") +
              names[i];
    return text;
  }



  std::string counted(const std::size_t n, const std::string &what)
  {
    return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
  }



  std::string capitalised(std::string text)
  {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z')
      text[0] += 'A' - 'a';
    return text;
  }



  std::string in_quotes(const std::string &text)
  {
    return "'" + text + "'";
  }



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



  std::string excerpt(const std::string &text, const std::size_t most)
  {
    const std::size_t half = most / 2 - 2;
    if (text.size() <= most)
      return text;
    // Characters of several bytes are not cut in two.
    const auto is_inside = [&](const std::size_t i) {
      return (static_cast<unsigned char>(text[i]) & 0xC0) == 0x80;
    };
    std::size_t begin = half, end = text.size() - half;
    while (begin > 0 && is_inside(begin))
      --begin;
    while (end < text.size() && is_inside(end))
      ++end;
    return text.substr(0, begin) + " ... " + text.substr(end);
  }



  std::string essential_lines(const std::string &text,
                              const unsigned int n_lines)
  {
    std::istringstream in(text);
    std::string        line, result;
    for (unsigned int n = 0; n < n_lines && std::getline(in, line);)
      {
        line = dealii::Utilities::trim(line);
        if (line.empty())
          continue;
        result += (n == 0 ? "" : " ") + line;
        ++n;
      }
    return result;
  }



  std::string commented(const std::string &text,
                        const std::string &indent,
                        const std::size_t  most)
  {
    std::string lines;
    for (const std::string &line : dealii::Utilities::break_text_into_lines(
           text, most - 2 - std::min<std::size_t>(indent.size(), 40)))
      lines += indent + "# " + line + '\n';
    return lines;
  }



  // Of a name of 5000 letters the ends are enough.
  std::string readable(const std::string &message)
  {
    constexpr std::size_t longest = 1000;

    std::istringstream in(message);
    std::string        result;
    for (std::string line; std::getline(in, line);)
      result += (result.empty() ? "" : "\n") + excerpt(line, longest);
    return result;
  }



  std::string minus_hint(const std::string &text)
  {
    // The typographer's minus, and an en dash.
    for (const char *const dash : {"\u2212", "\u2013"})
      if (text.find(dash) != std::string::npos)
        return "'" + std::string(dash) + "' is no minus sign: write -";
    return "";
  }



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
