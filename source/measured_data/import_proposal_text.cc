// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/import_map.h>
#include <slipstep/measured_data/import_proposal.h>
#include <slipstep/utilities/lists.h>

#include <sstream>

namespace SlipStep
{
  namespace
  {
    // Wrapped, each line begun with the mark.
    std::string comment(const std::string &text, const std::string &mark)
    {
      constexpr std::size_t width = 78;
      std::istringstream    words(text);
      std::string           lines, line = mark, word;
      while (words >> word)
        {
          if (line.size() + 1 + word.size() > width && line != mark)
            {
              lines += line + '\n';
              line = mark;
            }
          line += ' ' + word;
        }
      return lines + line + '\n';
    }
  } // namespace



  bool ImportProposal::is_complete() const
  {
    return none_of(guesses, [](const auto &guess) {
      return guess.is_open && guess.path != "Test/Condition";
    });
  }



  Parameters ImportProposal::map() const
  {
    Parameters result;
    declare_import_parameters(result);
    for (const ImportGuess &guess : guesses)
      if (!guess.is_open)
        result.set(guess.path, guess.value, "proposal");
    return result;
  }



  std::string ImportProposal::text() const
  {
    std::string text = comment(
      "A proposal for " + file.filename().string() +
        ": every line was guessed, with the reason above it. Look "
        "through it" +
        (is_complete() ? "" : ", complete the lines that begin with '# set'") +
        ", then: slipstep import THIS_FILE",
      "#");
    for (const std::string name :
         {"Raw file", "Columns", "Constants", "Convention", "Test"})
      {
        std::string lines;
        for (const ImportGuess &guess : guesses)
          if (guess.path.rfind(name + "/", 0) == 0)
            lines += comment(guess.reason, "  #") +
                     (guess.is_open ? "  # set " : "  set ") +
                     guess.path.substr(name.size() + 1) + " = " + guess.value +
                     '\n';
        if (!lines.empty())
          text += "subsection " + name + '\n' + lines + "end\n";
      }
    return text;
  }
} // namespace SlipStep
