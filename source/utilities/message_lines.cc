// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <slipstep/utilities/message_lines.h>
#include <slipstep/utilities/pattern_words.h>

#include <sstream>

namespace SlipStep
{
  // The first lines with something in them: deal.II's messages are pages.
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
} // namespace SlipStep
