// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/text_table.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <sstream>

namespace SlipStep
{
  namespace
  {
    bool begins_character(const char c)
    {
      return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    }

    /// The end of a name tells more than its beginning, which is a path.
    std::string cut_name(const std::string &name, const std::size_t width)
    {
      std::size_t n_dropped = text_width(name);
      if (n_dropped <= width)
        return name;
      n_dropped -= width - 1;
      std::size_t begin = 0;
      while (begin < name.size() &&
             (n_dropped > 0 || !begins_character(name[begin])))
        n_dropped -= begins_character(name[begin++]);
      return "…" + name.substr(begin);
    }

    constexpr std::size_t margin = 2, gap = 3;
  } // namespace



  std::size_t text_width(const std::string &text)
  {
    return count_if(text, begins_character);
  }



  std::string cut_text(const std::string &text, const std::size_t widest)
  {
    if (text_width(text) <= widest)
      return text;
    std::size_t end = 0;
    for (std::size_t n = 0; end < text.size(); ++end)
      if (begins_character(text[end]) && ++n == widest)
        break;
    return text.substr(0, end) + "…";
  }



  TableLine table_head(const std::string &names)
  {
    return dealii::Utilities::split_string_list(names, '|');
  }



  std::string text_table(const TableLines &lines, const std::size_t widest)
  {
    std::vector<std::size_t> widths(lines[0].size(), 0);
    for (const TableLine &line : lines)
      for (std::size_t i = 0; i < line.size(); ++i)
        widths[i] = std::max(widths[i], text_width(line[i]));
    std::size_t total = 0;
    for (const std::size_t width : widths)
      total += width + (total > 0 ? gap : 0);
    if (total + margin > widest)
      {
        const std::size_t excess =
          std::min(total + margin - widest,
                   widths[0] - std::min<std::size_t>(widths[0], 8));
        widths[0] -= excess;
        total -= excess;
      }

    std::string text;
    for (std::size_t n = 0; n < lines.size(); ++n)
      {
        for (std::size_t i = 0; i < lines[n].size(); ++i)
          {
            const std::string cell =
              i == 0 ? cut_name(lines[n][i], widths[i]) : lines[n][i];
            const std::string space(widths[i] - text_width(cell), ' ');
            text += std::string(i == 0 ? margin : gap, ' ') +
                    (i == 0 ? cell + space : space + cell);
          }
        text.erase(text.find_last_not_of(' ') + 1);
        text += '\n';
        if (n == 0)
          text += std::string(margin, ' ') + std::string(total, '-') + '\n';
      }
    return text;
  }



  std::string table_paragraph(const TableLines &lines)
  {
    return lines.size() > 1 ? "\n" + text_table(lines, terminal_width) : "";
  }



  std::string wrapped_text(const std::string &text,
                           const std::size_t  indent,
                           const std::size_t  widest)
  {
    std::istringstream words(text);
    std::string        wrapped, line;
    for (std::string word; words >> word;)
      {
        if (!line.empty() &&
            indent + text_width(line) + 1 + text_width(word) > widest)
          {
            wrapped += std::string(indent, ' ') + line + '\n';
            line.clear();
          }
        line += (line.empty() ? "" : " ") + word;
      }
    if (!line.empty())
      wrapped += std::string(indent, ' ') + line + '\n';
    return wrapped;
  }
} // namespace SlipStep
