// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/units.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>

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
} // namespace SlipStep
