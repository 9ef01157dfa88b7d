// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <slipstep/utilities/encoding.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/nearest_name.h>
#include <slipstep/utilities/parameter_reader.h>
#include <slipstep/utilities/text.h>

#include <boost/algorithm/string/replace.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace SlipStep
{
  std::string place(const std::filesystem::path &file, const unsigned int line)
  {
    return file.string() + ":" + std::to_string(line);
  }



  namespace
  {
    using dealii::Utilities::trim;

    // Split off the first word; the rest is trimmed.
    std::string first_word(std::string &text)
    {
      const std::size_t length =
        std::min(text.find_first_of(" \t"), text.size());
      const std::string word = text.substr(0, length);
      text                   = trim(text.substr(length));
      return word;
    }



    PrmStatement parse_statement(const std::string &text,
                                 const std::string &where,
                                 const unsigned int line)
    {
      using Kind             = PrmStatement::Kind;
      std::string       rest = text;
      const std::string word = lower_case(first_word(rest));
      const std::size_t sign = rest.find('=');
      if (word == "subsection" && !rest.empty())
        return {Kind::subsection, rest, "", line, where};
      if (word == "end" && rest.empty())
        return {Kind::end, "", "", line, where};
      if (word == "include" && !rest.empty())
        return {Kind::include, "", rest, line, where};
      if (word == "set" && sign != std::string::npos && sign > 0)
        return {Kind::set,
                trim(rest.substr(0, sign)),
                trim(rest.substr(sign + 1)),
                line,
                where};
      const std::vector<std::string> words = {"set",
                                              "subsection",
                                              "end",
                                              "include"};
      return {Kind::wrong,
              "",
              where + ": \"" + excerpt(text) + "\" is not understood" +
                (holds(words, word) ? "" : did_you_mean(word, words)) +
                " (a line is one of: set KEY = VALUE, subsection NAME, end, "
                "include FILE, # comment)",
              line,
              where};
    }



    // Whatever ends the lines: LF, CR LF, or CR alone.
    std::string with_line_feeds(std::istream &in)
    {
      std::ostringstream all;
      all << in.rdbuf();
      std::string text = all.str();
      boost::replace_all(text, "\r\n", "\n");
      std::replace(text.begin(), text.end(), '\r', '\n');
      return text;
    }
  } // namespace



  std::vector<PrmStatement>
  read_prm_statements(const std::filesystem::path &file)
  {
    if (std::filesystem::is_directory(file))
      throw InputError(file.string() + " is a folder, not a .prm file");
    if (!std::filesystem::exists(file))
      throw InputError(file.string() + ": no such file");
    if (file.extension() != ".prm")
      throw InputError(file.string() +
                       ": not a .prm file (its name must end in .prm)");
    std::ifstream in(file);
    if (!in)
      throw InputError(file.string() + ": cannot be opened for reading");

    std::istringstream        lines(with_line_feeds(in));
    std::vector<PrmStatement> statements;
    std::string               text, line;
    unsigned int              n_lines = 0, first_line = 0;
    bool                      is_continued = false;
    while (std::getline(lines, line))
      {
        ++n_lines;
        if (line.find('\0') != std::string::npos)
          throw InputError(place(file, n_lines) +
                           ": not a .prm file (it is not text)");
        if (n_lines == 1 && line.compare(0, 3, "\xEF\xBB\xBF") == 0)
          line.erase(0, 3);
        const std::size_t comment = line.find('#');
        const bool        is_only_comment =
          comment != std::string::npos && trim(line.substr(0, comment)).empty();
        // Names of the file appear in JSON, HTML and pictures.
        if (!is_utf8(line))
          throw InputError(place(file, n_lines) +
                           ": this line is not UTF-8 text; save the file in "
                           "that encoding");
        line = trim(line.substr(0, comment));
        // A comment between continued lines does not end them.
        if (is_continued && is_only_comment)
          continue;
        if (!is_continued)
          {
            text.clear();
            first_line = n_lines;
          }
        is_continued = !line.empty() && line.back() == '\\';
        if (is_continued)
          line = trim(line.substr(0, line.size() - 1));
        text += (text.empty() || line.empty() ? "" : " ") + line;
        if (!is_continued && !text.empty())
          statements.push_back(
            parse_statement(text, place(file, first_line), first_line));
      }
    if (is_continued)
      throw InputError(place(file, n_lines) +
                       ": the file ends after a \\ that continues the line");
    return statements;
  }
} // namespace SlipStep
