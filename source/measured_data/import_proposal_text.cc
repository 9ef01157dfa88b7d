// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/import_record.h>
#include <slipstep/measured_data/import_proposal.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>

namespace SlipStep
{
  namespace
  {
    // A map takes the rest of a line behind # for a remark, and * for any
    // letters; ? stands for one letter.
    std::string name_in_map(const std::filesystem::path &file)
    {
      std::string name = file.filename().string();
      std::replace_if(
        name.begin(),
        name.end(),
        [](const char c) { return c == '#' || c == '*'; },
        '?');
      return name;
    }



    void add_guesses_of_header(const RecordLayout       &layout,
                               std::vector<ImportGuess> &guesses)
    {
      const auto guess = [&](const std::string &key,
                             const std::string &value,
                             const std::string &reason) {
        guesses.push_back({"Raw file/" + key, value, reason, false});
      };
      if (layout.header_line == 0 || layout.has_unclear_header)
        {
          guess("Has header",
                "false",
                layout.header_line == 0 ?
                  "no line of names before the rows" :
                  "line " + std::to_string(layout.header_line) +
                    " has not as many names as rows have cells");
          guess("Header line",
                std::to_string(layout.first_row),
                "where the rows begin");
        }
      else
        guess("Header line",
              std::to_string(layout.header_line),
              "the last line of words before the rows");
      if (layout.units_line > 0 && !layout.has_unclear_header)
        guess("Units line",
              std::to_string(layout.units_line),
              "most of its cells are units");
    }
  } // namespace



  std::vector<ImportGuess> guesses_of_layout(const std::filesystem::path &file,
                                             const RecordLayout &layout)
  {
    std::vector<ImportGuess> guesses;
    const auto               guess = [&](const std::string &path,
                           const std::string &value,
                           const std::string &reason,
                           const bool         is_open = false) {
      guesses.push_back({path, value, reason, is_open});
    };
    guess("Raw file/Name",
          name_in_map(file),
          counted(layout.n_rows, "row") + " of " +
            counted(layout.n_cells, "cell") + ", the first is line " +
            std::to_string(layout.first_row));
    guess("Raw file/Delimiter",
          layout.delimiter == '\t' ? "tab" :
          layout.delimiter == ';'  ? "semicolon" :
          layout.delimiter == ','  ? "comma" :
                                     "blanks",
          "makes the most numbers of the rows");
    const std::string mark = layout.decimal_mark == ',' ? "comma" : "point";
    if (layout.decimal_mark != '\0')
      guess("Raw file/Decimal mark",
            mark,
            layout.has_doubtful_marks ?
              "all numbers with a " + mark +
                " have three digits behind it: does it separate thousands?" :
              "as the numbers have it");
    if (layout.thousands_mark != '\0')
      guess("Raw file/Thousands mark",
            layout.thousands_mark == '.' ? "point" :
            layout.thousands_mark == ',' ? "comma" :
                                           "apostrophe",
            layout.has_doubtful_marks ?
              "three digits stand behind each, where there is one" :
              "numbers have a second mark",
            layout.has_doubtful_marks);
    add_guesses_of_header(layout, guesses);
    if (!layout.comment_marks.empty())
      guess("Raw file/Comment marks",
            boost::algorithm::join(layout.comment_marks, ", "),
            "lines between or behind the rows begin like this");
    return guesses;
  }



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
    std::string text = commented(
      "A proposal for " + file.filename().string() +
      ": every line was guessed, with the reason above it. Look "
      "through it" +
      (is_complete() ? "" : ", complete the lines that begin with '# set'") +
      ", then: slipstep import THIS_FILE");
    for (const std::string name :
         {"Raw file", "Columns", "Constants", "Convention", "Test"})
      {
        std::string lines;
        for (const ImportGuess &guess : guesses)
          if (guess.path.rfind(name + "/", 0) == 0)
            lines += commented(guess.reason, "  ") +
                     (guess.is_open ? "  # set " : "  set ") +
                     guess.path.substr(name.size() + 1) + " = " + guess.value +
                     '\n';
        if (!lines.empty())
          text += "subsection " + name + '\n' + lines + "end\n";
      }
    return text;
  }
} // namespace SlipStep
