// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/import_columns.h>
#include <slipstep/measured_data/record_layout.h>
#include <slipstep/utilities/clock.h>
#include <slipstep/utilities/csv.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace SlipStep
{
  namespace
  {
    using Cells = std::vector<std::string_view>;

    bool is_digit_at(const std::string_view text, const std::size_t i)
    {
      return i < text.size() &&
             std::isdigit(static_cast<unsigned char>(text[i])) != 0;
    }

    std::vector<std::string> lines_of(const std::filesystem::path &file)
    {
      const std::string text = read_text(file);
      if (text.find('\0') != std::string::npos)
        throw InputError(file.string() +
                         ": this is no text; export the record as one");
      std::istringstream       in(text);
      std::vector<std::string> lines;
      for (std::string line; std::getline(in, line);)
        lines.push_back(line);
      return lines;
    }

    /// What a number is written with.
    struct NumberMarks
    {
      bool is_number   = false;
      char decimal     = '\0';
      char thousands   = '\0';
      bool is_doubtful = false; ///< the mark might part thousands
    };

    NumberMarks marks_of(const std::string_view cell)
    {
      NumberMarks marks;
      std::size_t i =
        cell.empty() || (cell[0] != '-' && cell[0] != '+') ? 0 : 1;
      const std::size_t begin = i;
      if (!is_digit_at(cell, i) &&
          !((cell[i] == '.' || cell[i] == ',') && is_digit_at(cell, i + 1)))
        return marks;
      std::string used;
      while (is_digit_at(cell, i) ||
             (i < cell.size() &&
              std::string(".,'").find(cell[i]) != std::string::npos))
        {
          if (!is_digit_at(cell, i))
            used += cell[i];
          ++i;
        }
      const std::size_t end = i;
      if (i < cell.size() &&
          std::string("eEdD").find(cell[i]) != std::string::npos)
        {
          i +=
            i + 1 < cell.size() && (cell[i + 1] == '-' || cell[i + 1] == '+') ?
              2 :
              1;
          if (!is_digit_at(cell, i))
            return marks;
          while (is_digit_at(cell, i))
            ++i;
        }
      if (i != cell.size())
        return marks;
      marks.is_number = true;
      if (used.empty())
        return marks;
      const char last  = used.back();
      const bool alike = used.find_first_not_of(last) == std::string::npos;
      if (alike && (used.size() > 1 || last == '\''))
        {
          marks.thousands = last;
          // Parts of a date have no three digits each.
          for (std::size_t at = cell.find(last); at < end;
               at             = std::min(cell.find(last, at + 1), end))
            if (std::min(cell.find(last, at + 1), end) != at + 4)
              return {};
        }
      else
        {
          marks.decimal        = last;
          marks.thousands      = alike ? '\0' : used.front();
          const std::size_t at = cell.find(last);
          marks.is_doubtful    = alike && end - at == 4 && at - begin <= 3 &&
                              at > begin && cell[begin] != '0';
        }
      return marks;
    }

    /// A table that one delimiter makes of the lines.
    struct TableFound
    {
      char              delimiter = '\0';
      std::size_t       n_cells = 0, n_rows = 0, first = 0;
      std::size_t       n_filled = 0;  ///< without those empty at the end
      double            quality  = 0.; ///< numbers in all rows
      std::vector<bool> is_row;
    };

    std::size_t n_filled_in(const Cells &cells)
    {
      return count_if(cells, [](const auto &cell) { return !cell.empty(); });
    }

    std::size_t n_numbers_in(const Cells &cells)
    {
      return count_if(cells,
                      [](const auto &c) { return marks_of(c).is_number; });
    }

    bool is_row(const Cells &cells)
    {
      const std::size_t n = n_numbers_in(cells);
      return n >= 2 && 3 * n >= n_filled_in(cells);
    }

    /// Rows of one number of cells.
    struct AlikeRows
    {
      std::vector<std::size_t> rows;
      std::size_t              n_numbers = 0, n_filled = 0, last_filled = 0;

      void add(const std::size_t line, const Cells &cells)
      {
        rows.push_back(line);
        n_numbers += n_numbers_in(cells);
        n_filled += n_filled_in(cells);
        std::size_t last = cells.size();
        while (last > 0 && cells[last - 1].empty())
          --last;
        last_filled = std::max(last_filled, last);
      }
    };

    // "Samples 200 200 200": lines of a header that begin with a word are no
    // rows of a table that is much longer and begins with a number.
    AlikeRows without_headers(const AlikeRows                &alike,
                              const std::vector<std::string> &lines,
                              const char                      delimiter)
    {
      AlikeRows result;
      for (const std::size_t row : alike.rows)
        if (const auto cells = cells_of(lines[row], delimiter);
            marks_of(cells[0]).is_number)
          result.add(row, cells);
      return result.rows.size() >= 0.9 * alike.rows.size() ? result : alike;
    }

    // LabVIEW has a column for comments, the last one, which some rows have and
    // some end before: no row is longer than without it.
    void leave_out_comment(Cells &cells, std::size_t &n_most)
    {
      if (lower_case(cells.back()) == "comment" && cells.size() > 2)
        n_most = cells.size() - 1;
      cells.resize(std::min(cells.size(), n_most));
    }

    TableFound table_of(const std::vector<std::string> &lines,
                        const char                      delimiter)
    {
      std::map<std::size_t, AlikeRows> found; // by number of cells
      std::size_t                      n_most = std::string::npos;
      for (std::size_t i = 0; i < lines.size(); ++i)
        {
          auto cells = cells_of(lines[i], delimiter);
          leave_out_comment(cells, n_most);
          if (lines[i][0] != '#' && is_row(cells))
            found[cells.size()].add(i, cells);
        }
      TableFound table;
      for (const auto &[n_cells, all] : found)
        {
          const AlikeRows alike = without_headers(all, lines, delimiter);
          // What cuts numbers in two has few of them whole.
          const double share   = double(alike.n_numbers) / alike.n_filled;
          const double quality = share * share * alike.n_numbers;
          if (alike.rows.size() < 2 || quality <= table.quality)
            continue;
          table = {delimiter,
                   n_cells,
                   alike.rows.size(),
                   alike.rows.front(),
                   alike.last_filled,
                   quality,
                   {}};
          table.is_row.assign(lines.size(), false);
          for (const std::size_t row : alike.rows)
            table.is_row[row] = true;
        }
      return table;
    }

    std::string_view without_brackets(const std::string_view unit)
    {
      const bool has_brackets =
        unit.size() > 2 && ((unit.front() == '[' && unit.back() == ']') ||
                            (unit.front() == '(' && unit.back() == ')'));
      return has_brackets ? unit.substr(1, unit.size() - 2) : unit;
    }

    // Also one that this program does not know.
    bool is_unit(const std::string_view cell)
    {
      static const std::set<std::string> others = {
        "%", "V", "mV", "rpm", "Hz", "deg", "kg", "lb", "lbs", "cN", "daN"};
      const std::string text(cell);
      return without_brackets(cell) != cell || others.count(text) > 0 ||
             dimension_of_unit(text).has_value();
    }

    // Mostly units and gaps.
    bool is_line_of_units(const Cells &cells)
    {
      std::size_t n_units = 0, n_others = 0;
      for (const std::string_view cell : cells)
        if (is_unit(cell))
          ++n_units;
        else if (!cell.empty() && cell != "-")
          ++n_others;
      return n_units >= 2 && n_others <= n_units / 2;
    }

    bool has_names(const Cells &cells)
    {
      return n_filled_in(cells) >= 2 && n_numbers_in(cells) == 0;
    }

    // Names may be behind a hash.
    std::string_view without_hash(std::string_view line)
    {
      line.remove_prefix(std::min(line.find_first_not_of('#'), line.size()));
      return line;
    }

    // "Cycle 1"
    bool is_word_alone(const std::string_view line, const char delimiter)
    {
      return delimiter != ' ' &&
             std::isalpha(static_cast<unsigned char>(line[0])) != 0 &&
             n_filled_in(cells_of(line, delimiter)) == 1;
    }

    void find_header(const std::vector<std::string> &lines,
                     const TableFound               &table,
                     RecordLayout                   &layout)
    {
      std::size_t line = layout.first_row - 1; // counted from 1: the one before
      const auto  go_up = [&]() {
        while (line > 0 && (without_blanks(lines[line - 1]).empty() ||
                            is_word_alone(lines[line - 1], layout.delimiter)))
          --line;
      };
      const auto cells = [&]() {
        return line == 0 ?
                 Cells() :
                 cells_of(without_hash(lines[line - 1]), layout.delimiter);
      };
      go_up();
      if (line > 0 && is_line_of_units(cells()) && line > 1)
        {
          const std::size_t units = line--;
          go_up();
          if (has_names(cells()))
            layout.units_line = units;
          else
            line = units;
        }
      if (!has_names(cells()))
        return;
      const Cells       header = cells();
      const std::size_t n_comments =
        lower_case(header.back()) == "comment" ? 1 : 0;
      layout.has_unclear_header = header.size() > layout.n_cells + n_comments ||
                                  header.size() < table.n_filled;
      layout.header_line = line;
      if (!layout.has_unclear_header || layout.delimiter != ' ')
        return;
      // "Time [s]   Normal load [N]"
      const std::string text(without_blanks(without_hash(lines[line - 1])));
      const std::regex  between("\\s\\s+|\t");
      layout.names = {
        std::sregex_token_iterator(text.begin(), text.end(), between, -1), {}};
      if (layout.names.size() != layout.n_cells)
        layout.names.clear();
      if (layout.units_line == 0)
        return;
      const Cells units =
        cells_of(without_hash(lines[layout.units_line - 1]), layout.delimiter);
      for (std::size_t i = 0;
           i < layout.names.size() && units.size() == layout.n_cells;
           ++i)
        layout.names[i] += " [" + std::string(without_brackets(units[i])) + "]";
    }



    void find_clock_column(const std::vector<std::string> &lines,
                           const TableFound               &table,
                           RecordLayout                   &layout)
    {
      const Cells first = cells_of(lines[table.first], layout.delimiter);
      for (std::size_t k = 0; k < layout.n_cells && layout.clock == 0; ++k)
        for (const std::string order : {"", "d/m", "m/d"})
          {
            if (first[k].find(':') == std::string_view::npos)
              continue;
            Clock       clock(order);
            std::size_t n_read = 0;
            for (std::size_t i = table.first; i < lines.size(); ++i)
              if (table.is_row[i])
                n_read += clock.seconds(cells_of(lines[i], layout.delimiter)[k])
                            .has_value();
            if (2 * n_read <= table.n_rows)
              continue;
            layout.clock = k + 1;
            layout.date_orders.push_back(order);
            if (order.empty())
              break;
          }
    }

    // "Test completed at 17:10": the words that such a line begins with.
    void find_other_lines(const std::vector<std::string> &lines,
                          const TableFound               &table,
                          RecordLayout                   &layout)
    {
      constexpr std::size_t most_marks = 5;
      std::set<std::string> marks;
      const std::size_t     begin =
        layout.header_line > 0 ? layout.header_line : table.first;
      for (std::size_t i = begin; i < lines.size(); ++i)
        {
          std::string_view line = without_blanks(lines[i]);
          line.remove_prefix(
            std::min(line.find_first_not_of('"'), line.size()));
          if (table.is_row[i] || i + 1 == layout.units_line || line.empty() ||
              line[0] == '#' ||
              std::isalpha(static_cast<unsigned char>(line[0])) == 0)
            continue;
          const std::string_view mark = without_blanks(
            line.substr(0, line.find_first_of("0123456789,;\t:\"")));
          if (!mark.empty() && marks.size() < most_marks)
            marks.emplace(mark);
        }
      layout.comment_marks.assign(marks.begin(), marks.end());
    }

    // Digits behind a mark that are always three are no decimals where some
    // numbers of a column have none, or where a number has two such marks.
    // Returns whether the former alone says so.
    bool find_thousands(const std::vector<std::size_t> &n_marked,
                        const std::vector<std::size_t> &n_whole,
                        std::map<char, std::size_t>    &doubtful,
                        std::map<char, std::size_t>    &decimals,
                        std::map<char, std::size_t>    &thousands)
    {
      bool are_mixed = false, is_guess = false;
      for (std::size_t k = 0; k < n_marked.size(); ++k)
        are_mixed = are_mixed || (n_marked[k] >= 2 && n_whole[k] > 0);
      for (const char mark : {'.', ','})
        if (doubtful[mark] > 0 && doubtful[mark] == decimals[mark] &&
            (thousands[mark] > 0 ||
             (are_mixed && decimals[mark == '.' ? ',' : '.'] == 0)))
          {
            is_guess = thousands[mark] == 0;
            thousands[mark] += decimals[mark];
            decimals[mark] = 0;
          }
      return is_guess;
    }

    void find_numbers(const std::vector<std::string> &lines,
                      const TableFound               &table,
                      RecordLayout                   &layout)
    {
      std::vector<std::size_t> n_numbers(layout.n_cells, 0),
        n_filled(layout.n_cells, 0);
      std::map<char, std::size_t> decimals, thousands, doubtful;
      std::vector<std::size_t>    n_whole(layout.n_cells, 0),
        n_marked(layout.n_cells, 0);
      bool has_large = false;
      for (std::size_t i = table.first; i < lines.size(); ++i)
        {
          if (!table.is_row[i])
            continue;
          const auto cells = cells_of(lines[i], layout.delimiter);
          for (std::size_t k = 0; k < layout.n_cells; ++k)
            {
              const NumberMarks marks = marks_of(cells[k]);
              n_filled[k] += !cells[k].empty();
              n_numbers[k] += marks.is_number;
              ++decimals[marks.decimal];
              ++thousands[marks.thousands];
              if (marks.is_doubtful)
                ++doubtful[marks.decimal];
              n_marked[k] += marks.is_doubtful;
              if (marks.is_number && marks.decimal == '\0' &&
                  marks.thousands == '\0')
                {
                  const double value =
                    std::abs(std::atof(std::string(cells[k]).c_str()));
                  n_whole[k] += value >= 1. && value < 1000.;
                  has_large = has_large || value >= 1000.;
                }
            }
        }
      // Where thousands had a mark, these would.
      const bool is_guess =
        !has_large &&
        find_thousands(n_marked, n_whole, doubtful, decimals, thousands);
      decimals.erase('\0');
      thousands.erase('\0');
      layout.decimal_mark = decimals[','] > decimals['.'] ? ',' :
                            decimals['.'] > 0             ? '.' :
                                                            '\0';
      for (const auto &[mark, n] : thousands)
        if (n > 0 && mark != layout.decimal_mark)
          layout.thousands_mark = mark;
      // 1.234 where other numbers have a decimal comma.
      if (layout.decimal_mark == ',' && decimals['.'] > 0)
        layout.thousands_mark = '.';
      if (layout.decimal_mark == '.' && decimals[','] > 0)
        layout.thousands_mark = ',';
      const char mark = layout.decimal_mark;
      layout.has_doubtful_marks =
        is_guess || (mark != '\0' && doubtful[mark] == decimals[mark]);
      for (std::size_t k = 0; k < layout.n_cells; ++k)
        if (n_numbers[k] >= 2 && 2 * n_numbers[k] > n_filled[k])
          layout.numbers.push_back(k);
    }
  } // namespace



  RecordLayout record_layout(const std::filesystem::path &file)
  {
    const std::vector<std::string> lines = lines_of(file);
    TableFound                     best;
    for (const char delimiter : {'\t', ';', ',', ' '})
      {
        const TableFound table = table_of(lines, delimiter);
        if (table.quality > best.quality)
          best = table;
      }
    if (best.n_rows < 2)
      throw InputError(file.string() +
                       ": there is no table of numbers in this file");
    RecordLayout layout;
    layout.delimiter = best.delimiter;
    layout.n_rows    = best.n_rows;
    layout.n_cells   = best.n_cells;
    layout.first_row = best.first + 1;
    find_header(lines, best, layout);
    find_other_lines(lines, best, layout);
    find_numbers(lines, best, layout);
    find_clock_column(lines, best, layout);
    return layout;
  }
} // namespace SlipStep
