// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/csv.h>
#include <slipstep/utilities/encoding.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/nearest_name.h>
#include <slipstep/utilities/text.h>

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <fstream>
#include <limits>
#include <set>
#include <utility>

namespace SlipStep
{
  std::string_view without_blanks(std::string_view text)
  {
    const char *const blanks = " \t\r";
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    return text.substr(0, text.find_last_not_of(blanks) + 1);
  }



  std::string read_text(const std::filesystem::path &file)
  {
    std::ifstream in(file, std::ios::binary | std::ios::ate);
    if (!in || std::filesystem::is_directory(file))
      throw InputError(file.string() + ": this file cannot be read");
    std::string text(static_cast<std::size_t>(in.tellg()), '\0');
    in.seekg(0);
    if (!text.empty() && !in.read(text.data(), text.size()))
      throw InputError(file.string() + ": this file cannot be read");
    if (boost::algorithm::starts_with(text, "\xFF\xFE") ||
        boost::algorithm::starts_with(text, "\xFE\xFF"))
      throw InputError(file.string() +
                       ": this text is in UTF-16; save it as UTF-8");
    if (boost::algorithm::starts_with(text, "\xEF\xBB\xBF"))
      text.erase(0, 3);
    // Old Macintoshes end lines with CR alone.
    if (text.find('\n') == std::string::npos)
      std::replace(text.begin(), text.end(), '\r', '\n');
    return to_utf8(text);
  }



  namespace
  {
    // A delimiter inside quotes separates nothing.
    std::size_t length_of_cell(const std::string_view rest,
                               const char             delimiter)
    {
      const std::size_t first =
        rest.find_first_not_of(delimiter == '\t' ? " \r" : " \t\r");
      const std::size_t quote = first < rest.size() && rest[first] == '"' ?
                                  rest.find('"', first + 1) :
                                  std::string_view::npos;
      const std::size_t from  = quote == std::string_view::npos ? 0 : quote;
      return std::min(delimiter == ' ' ? rest.find_first_of(" \t", from) :
                                         rest.find(delimiter, from),
                      rest.size());
    }
  } // namespace



  std::vector<std::string_view> cells_of(const std::string_view line,
                                         const char             delimiter,
                                         std::vector<std::string_view> cells)
  {
    cells.clear();
    std::string_view rest = delimiter == ' ' ? without_blanks(line) : line;
    for (bool is_last = false; !is_last;)
      {
        const std::size_t length = length_of_cell(rest, delimiter);
        std::string_view  cell   = without_blanks(rest.substr(0, length));
        if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"')
          cell = without_blanks(cell.substr(1, cell.size() - 2));
        cells.push_back(cell);
        is_last = length == rest.size();
        rest.remove_prefix(is_last ? length : length + 1);
        if (delimiter == ' ')
          rest = without_blanks(rest);
      }
    return cells;
  }



  namespace
  {
    bool is_gap(const std::string_view cell)
    {
      // Most are numbers, but for those as Windows has them: "-1.#IND00"; and
      // but for ">6.3", out of range.
      const bool is_none =
        cell.find(".#") != std::string_view::npos ||
        (!cell.empty() && (cell[0] == '>' || cell[0] == '<'));
      if (is_none || cell.empty() ||
          std::isdigit(static_cast<unsigned char>(cell.back())) != 0)
        return is_none || cell.empty();
      // "---", "**", "--.--"
      if (cell.find_first_not_of("-*.?#_~") == std::string_view::npos)
        return true;
      if (cell.size() > 9)
        return false;
      // As loggers and spreadsheets have them.
      static const std::set<std::string> gaps = {
        "nan",      "na",       "n/a",       "null",    "none",      "nil",
        "#n/a",     "#na",      "#nv",       "#value!", "#num!",     "#div/0!",
        "overflow", "overload", "overrange", "ovrflw",  "ovld",      "ol",
        "ovl",      "ovr",      "over",      "under",   "underflow", "error",
        "err",      "invalid",  "missing",   "bad"};
      return gaps.count(lower_case(cell)) > 0;
    }

    /// Independent of the locale, unlike strtod. Exponents may begin with a D,
    /// as Fortran has those of double precision.
    bool read_number(std::string_view cell, double &value)
    {
      if (cell.size() > 1 && cell[0] == '+' && cell[1] != '-')
        cell.remove_prefix(1);
      const char *const end    = cell.data() + cell.size();
      const auto [stop, error] = std::from_chars(cell.data(), end, value);
      if (error == std::errc() && stop != end && (*stop == 'D' || *stop == 'd'))
        {
          std::string plain(cell);
          plain[stop - cell.data()] = 'e';
          return read_number(plain, value);
        }
      return error == std::errc() && stop == end && !cell.empty();
    }

    // Only where they part three digits each, before the decimals.
    bool take_out_marks(const std::string_view cell,
                        const char             mark,
                        std::string           &plain)
    {
      const auto is_digit = [&](const std::size_t i) {
        return i < cell.size() &&
               std::isdigit(static_cast<unsigned char>(cell[i])) != 0;
      };
      plain.clear();
      bool has_mark = false;
      for (std::size_t i = 0; i < cell.size(); ++i)
        if (cell[i] != mark)
          plain += cell[i];
        else if (i > 0 && is_digit(i - 1) && is_digit(i + 1) &&
                 is_digit(i + 2) && is_digit(i + 3) && !is_digit(i + 4) &&
                 plain.find_first_of(".,eEdD") == std::string::npos &&
                 (has_mark || i <= 4))
          has_mark = true;
        else
          return false;
      return true;
    }

    bool read_number_with_comma(const std::string_view cell, double &value)
    {
      std::array<char, 64> copy;
      if (cell.size() > copy.size())
        return false;
      std::replace_copy(cell.begin(), cell.end(), copy.begin(), ',', '.');
      return read_number({copy.data(), cell.size()}, value);
    }
  } // namespace



  CsvTable::CsvTable(const std::filesystem::path &file, const CsvFormat &format)
    : file(file)
    , format(format)
    , text(std::make_shared<const std::string>(read_text(file)))
    , next(text->data())
  {
    read_header();
  }



  CsvTable::CsvTable(const std::filesystem::path    &file,
                     const std::vector<std::string> &required,
                     const std::vector<std::string> &optional,
                     const CsvFormat                &format)
    : CsvTable(file, format)
  {
    std::map<std::string, std::size_t> wanted;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (std::count(required.begin(), required.end(), names[i]) +
            std::count(optional.begin(), optional.end(), names[i]) >
          0)
        if (!wanted.emplace(names[i], i).second)
          reject_header(i, "column '" + names[i] + "' is given twice");
    for (const std::string &name : required)
      if (wanted.count(name) == 0)
        fail(header_text.data(),
             "column '" + name + "' is missing (the header has: " +
               header_words() + ")" + did_you_mean(name, names));
    read(wanted);
  }



  bool CsvTable::next_line(std::string_view &line)
  {
    const char *const end = text->data() + text->size();
    while (next != end)
      {
        line                           = line_at(next);
        next                           = behind(line);
        const std::string_view content = without_blanks(line);
        if (content.empty())
          continue;
        // With its cell's quotes or without them; a name may be "#".
        const bool is_comment =
          any_of(format.comment_marks, [&](const std::string &mark) {
            return boost::algorithm::starts_with(content, mark) ||
                   (content.front() == '"' && mark != "#" &&
                    boost::algorithm::starts_with(content.substr(1), mark));
          });
        if (!is_comment)
          return true;
        for (const auto *first : {&names, &unit_names})
          refuse_other_header(content, *first);
        read_comment(content);
      }
    return false;
  }



  namespace
  {
    // "Load" of "Load [N]" and "Load (kN)".
    std::string_view without_unit(const std::string_view name)
    {
      return name.empty() || (name.back() != ']' && name.back() != ')') ?
               name :
               without_blanks(name.substr(0, name.find_last_of("[(")));
    }
  } // namespace



  // Some instruments repeat the header, and change it when a range changes.
  // What stands below would be read by the first one.
  void
  CsvTable::refuse_other_header(const std::string_view          line,
                                const std::vector<std::string> &first) const
  {
    const auto here = cells_of(line, format.delimiter);
    if (!format.has_header || here.size() != first.size())
      return;
    std::size_t n_known = 0, other = here.size();
    for (std::size_t i = 0; i < here.size(); ++i)
      {
        n_known += any_of(first, [&](const std::string &name) {
          return !name.empty() && without_unit(here[i]) == without_unit(name);
        });
        if (here[i] != first[i] && other == here.size())
          other = i;
      }
    if (other < here.size() && 2 * n_known > here.size())
      fail(here[other].data(),
           "the header is repeated with '" + std::string(here[other]) +
             "' in place of '" + first[other] +
             "': the rows below it are of other columns or units. Put them "
             "into a file of their own");
  }



  void CsvTable::read_comment(const std::string_view line)
  {
    const auto colon = line.find(':');
    if (line.front() != '#' || colon == std::string_view::npos)
      return;
    const std::string key =
      lower_case(without_blanks(line.substr(1, colon - 1)));
    if (key.empty())
      return;
    const std::string value(without_blanks(line.substr(colon + 1)));
    const auto [old, is_new] = comment_values.emplace(key, value);
    if (!is_new && old->second != value)
      contradictions.emplace(key, value);
  }



  void CsvTable::read_header()
  {
    next                    = begin_of_line(format.header_line);
    const char *const begin = next;
    std::string_view  line;
    if (format.header_line > 0 && format.has_header)
      {
        // Told where it is, even if it looks like a comment.
        line = line_at(next);
        next = behind(line);
        line.remove_prefix(std::min(line.find_first_not_of('#'), line.size()));
      }
    else
      next_line(line);
    if (without_blanks(line).empty())
      fail(begin,
           format.has_header ?
             "the header line with the names of the columns is missing" :
             "there are no rows");
    choose_delimiter(line);
    header_text = line;
    for (const std::string_view cell : cells_of(line, format.delimiter))
      names.emplace_back(cell);
    n_cells = names.size();
    if (!format.has_header)
      {
        next = begin;
        comment_values.clear();
        contradictions.clear();
        for (std::size_t i = 0; i < n_cells; ++i)
          names[i] = "column " + std::to_string(i + 1);
      }
    unit_names.resize(n_cells);
    if (format.units_line > 0)
      read_units();
  }



  void CsvTable::read_units()
  {
    std::string_view line = line_at(begin_of_line(format.units_line));
    if (without_blanks(line).empty())
      fail(line.data(),
           "line " + std::to_string(format.units_line) +
             " is said to have the units of the columns, but it is empty");
    next = std::max(next, behind(line));
    if (line.front() == '#')
      line.remove_prefix(1);
    const auto cells = cells_of(line, format.delimiter);
    for (std::size_t i = 0; i < cells.size(); ++i)
      {
        std::string_view cell  = cells[i];
        double           value = 0.;
        if (read_number(cell, value) || read_number_with_comma(cell, value))
          fail(cell.data(),
               "line " + std::to_string(format.units_line) +
                 " is said to have the units of the columns, but '" +
                 std::string(cell) + "' is a number");
        if (cell.size() > 1 && ((cell.front() == '[' && cell.back() == ']') ||
                                (cell.front() == '(' && cell.back() == ')')))
          cell = without_blanks(cell.substr(1, cell.size() - 2));
        if (i < n_cells)
          unit_names[i] = cell == "-" ? "" : std::string(cell);
        else if (!cell.empty())
          fail(cell.data(),
               "the line of units has more cells than the header, which has " +
                 std::to_string(n_cells));
      }
  }



  void CsvTable::choose_delimiter(const std::string_view line)
  {
    if (format.delimiter != '\0')
      return;
    // What is left to separate cells.
    format.delimiter = ' ';
    for (const char delimiter : {'\t', ';', ','})
      if (line.find(delimiter) != std::string_view::npos)
        {
          format.delimiter = delimiter;
          return;
        }
  }



  void CsvTable::read(const std::map<std::string, std::size_t> &wanted,
                      const std::string                        &clock_column,
                      const Clock                              &its_clock)
  {
    clock = its_clock;
    for (const auto &[name, position] : wanted)
      columns.push_back({name, position, {}, name == clock_column});
    sort(columns, [](const Column &a, const Column &b) {
      return a.position < b.position;
    });
    for (std::size_t i = 0; i < columns.size(); ++i)
      index_of_column[columns[i].name] = i;

    const char *const             end = text->data() + text->size();
    std::string_view              line;
    std::vector<std::string_view> cells;
    while (next_line(line))
      if (!format.may_be_cut || line.data() + line.size() != end)
        {
          cells = cells_of(line, format.delimiter, std::move(cells));
          begin_of_row.push_back(line.data());
          read_row(cells);
        }
  }



  void CsvTable::read_row(const std::vector<std::string_view> &cells)
  {
    // Spreadsheets like to end a row with delimiters, and LabVIEW has a cell
    // for a comment at the end of the header.
    const auto lacks_a_comment = [&]() {
      return cells.size() + 1 == n_cells && !names.empty() &&
             lower_case(names.back()) == "comment";
    };
    bool is_too_long = false;
    for (std::size_t n = n_cells; n < cells.size(); ++n)
      is_too_long = is_too_long || !cells[n].empty();
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (columns[i].position < cells.size())
        columns[i].values.push_back(read_cell(cells[columns[i].position], i));
    if ((cells.size() >= n_cells || lacks_a_comment()) && !is_too_long)
      return;
    fail(cells[std::min(cells.size() - 1, n_cells)].data(),
         "this row has " + std::to_string(cells.size()) +
           " cells, the header has " + std::to_string(n_cells) +
           (cells.size() > n_cells && format.delimiter == ',' ?
              " (numbers with a decimal comma need ';' or tabs between the "
              "columns)" :
              ""));
  }



  // What a map of an import can say of it.
  std::string CsvTable::why_no_number(const std::string_view cell) const
  {
    std::string plain;
    double      value = 0.;
    for (const char mark : {'.', ',', ' ', '\''})
      if (mark != format.thousands_mark && mark != format.decimal_mark &&
          cell.find(mark) != std::string_view::npos &&
          take_out_marks(cell, mark, plain) &&
          (read_number(plain, value) || read_number_with_comma(plain, value)))
        return std::string("; if '") + mark +
               "' separates thousands, a map of slipstep import says so: Raw "
               "file/Thousands mark";
    if (format.decimal_mark == '\0' && read_number_with_comma(cell, value))
      return "; if it has a decimal comma, a map of slipstep import says so: "
             "Raw file/Decimal mark = comma";
    if (cell.find_first_of("0123456789") < cell.find(':') &&
        cell.find(':') != std::string_view::npos)
      return "; if these are times of a clock, a map of slipstep import says "
             "so: Columns/Time = NAME in clock";
    const bool has_letter = any_of(cell, [](const char c) {
      return std::isalpha(static_cast<unsigned char>(c)) != 0;
    });
    if (begin_of_row.size() == 1 && has_letter && format.units_line == 0)
      return "; if this line has the units, a map of slipstep import says so: "
             "Raw file/Units line";
    const std::string_view first =
      cells_of(line_at(begin_of_row.back()), format.delimiter)[0];
    if (has_letter && !read_number(first, value) &&
        !read_number_with_comma(first, value))
      return "; if such lines are no rows, a map of slipstep import says what "
             "they begin with: Raw file/Comment marks";
    return "";
  }



  double CsvTable::read_cell(const std::string_view cell,
                             const std::size_t      column)
  {
    double      value = 0.;
    const auto &name  = columns[column].name;
    if (format.may_have_gaps && is_gap(cell))
      return std::numeric_limits<double>::quiet_NaN();
    if (columns[column].has_clock)
      {
        if (const auto seconds = clock.seconds(cell))
          return *seconds;
        fail(
          cell.data(),
          "'" + std::string(cell) +
            "' is no time of a clock, as 23:59:59.5 "
            "or 2026-11-27 23:59:59.5 (" +
            name +
            "); which number of a date "
            "like 3/4/2026 is the month, a map of slipstep import says by 'in "
            "clock d/m' or 'in clock m/d'");
      }

    std::string_view number = cell;
    std::string      plain;
    if (format.thousands_mark != '\0')
      number = take_out_marks(cell, format.thousands_mark, plain) ?
                 std::string_view(plain) :
                 std::string_view();

    const char *other = nullptr;
    if (read_number(number, value))
      {
        if (number.find('.') != std::string_view::npos)
          {
            other = format.decimal_mark == ',' ? cell.data() : first_comma;
            if (first_point == nullptr)
              first_point = cell.data();
          }
      }
    // With commas between the cells, those within stand between quotes.
    else if ((format.delimiter != ',' || format.decimal_mark == ',') &&
             format.decimal_mark != '.' &&
             number.find(',') != std::string_view::npos &&
             read_number_with_comma(number, value))
      {
        other = first_point;
        if (first_comma == nullptr)
          first_comma = cell.data();
      }
    else
      fail(cell.data(),
           cell.empty() ?
             "the value of " + columns[column].name + " is missing" :
             "'" + std::string(cell) + "' is not a number (" + name + ")" +
               why_no_number(cell));
    if (other != nullptr)
      fail(cell.data(),
           "'" + std::string(cell) +
             "': decimal comma and decimal point in one file (" + name + ")");
    return value;
  }



  bool CsvTable::has(const std::string &column) const
  {
    return index_of_column.count(column) > 0;
  }



  const std::vector<double> &
  CsvTable::operator[](const std::string &column) const
  {
    static const std::vector<double> none;
    const auto                       found = index_of_column.find(column);
    return found == index_of_column.end() ? none :
                                            columns[found->second].values;
  }



  std::size_t CsvTable::line(const std::size_t row) const
  {
    return 1 + std::count(text->data(), begin_of_row.at(row), '\n');
  }



  void CsvTable::reject(const std::size_t  row,
                        const std::string &column,
                        const std::string &why) const
  {
    const std::string_view line  = line_at(begin_of_row.at(row));
    const auto             found = index_of_column.find(column);
    fail(found == index_of_column.end() ? line.data() :
                                          cells_of(line, format.delimiter)
                                            .at(columns[found->second].position)
                                            .data(),
         why);
  }



  std::string CsvTable::header_words() const
  {
    constexpr std::size_t longest = 200;

    const std::string words = boost::algorithm::join(names, ", ");
    std::size_t       end   = std::min(words.size(), longest);
    // Not within a character.
    while (end < words.size() && (words[end] & 0xC0) == 0x80)
      ++end;
    return readable_text(words.substr(0, end)) +
           (end < words.size() ? " ..." : "");
  }



  void CsvTable::reject_header(const std::size_t  position,
                               const std::string &why) const
  {
    fail(cells_of(header_text, format.delimiter).at(position).data(), why);
  }



  const char *CsvTable::begin_of_line(const std::size_t number) const
  {
    const char *begin = text->data();
    for (std::size_t n = 1; n < number; ++n)
      begin = behind(line_at(begin));
    return begin;
  }



  std::string_view CsvTable::line_at(const char *const begin) const
  {
    const std::string_view rest(begin, text->data() + text->size() - begin);
    return rest.substr(0, rest.find('\n'));
  }



  const char *CsvTable::behind(const std::string_view line) const
  {
    return std::min(line.data() + line.size() + 1, text->data() + text->size());
  }



  void CsvTable::fail(const char *place, const std::string &why) const
  {
    const char *const begin = text->data();
    const std::size_t line  = 1 + std::count(begin, place, '\n');
    const char       *start = place;
    while (start > begin && start[-1] != '\n')
      --start;
    throw InputError(file.string() + ":" + std::to_string(line) + ":" +
                     std::to_string(place - start + 1) + ": " + why);
  }
} // namespace SlipStep
