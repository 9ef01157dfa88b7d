#include <slipstep/utilities/csv.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cctype>
#include <fstream>
#include <utility>

namespace SlipStep
{
  namespace
  {
    const char *const blanks = " \t\r";

    std::string trim(const std::string &text)
    {
      const auto begin = text.find_first_not_of(blanks);
      if (begin == std::string::npos)
        return "";
      return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
    }

    /// The cells of a line and the index at which each one's text begins.
    std::vector<std::pair<std::string, std::size_t>>
    split(const std::string &line)
    {
      std::vector<std::pair<std::string, std::size_t>> cells;
      for (std::size_t begin = 0; begin <= line.size();)
        {
          const std::size_t end  = std::min(line.find(',', begin), line.size());
          const std::string cell = line.substr(begin, end - begin);
          const auto        skip = cell.find_first_not_of(blanks);
          cells.emplace_back(trim(cell),
                             begin + (skip == std::string::npos ? 0 : skip));
          begin = end + 1;
        }
      return cells;
    }

    /// Independent of the locale, unlike strtod.
    bool read_number(const std::string &text, double &value)
    {
      const char *begin = text.data();
      const char *end   = begin + text.size();
      if (text.size() > 1 && text[0] == '+' && text[1] != '-')
        ++begin;
      const auto [stop, error] = std::from_chars(begin, end, value);
      return error == std::errc() && stop == end && begin != end;
    }
  } // namespace



  std::string exact_text(const double value)
  {
    std::array<char, 32> buffer;
    const auto           result =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return std::string(buffer.data(), result.ptr);
  }



  CsvTable::CsvTable(const std::filesystem::path    &file,
                     const std::vector<std::string> &required,
                     const std::vector<std::string> &optional)
    : file(file)
  {
    std::ifstream in(file);
    if (!in || std::filesystem::is_directory(file))
      throw InputError(file.string() + ": this file cannot be read");

    bool        header_seen = false;
    std::string line;
    while (std::getline(in, line))
      {
        ++line_number;
        if (line_number == 1 && line.compare(0, 3, "\xEF\xBB\xBF") == 0)
          line.erase(0, 3);
        const std::string content = trim(line);
        if (content.empty())
          continue;
        if (content[0] == '#')
          {
            const auto  colon = content.find(':');
            std::string key   = trim(content.substr(1, colon - 1));
            for (char &c : key)
              c = std::tolower(static_cast<unsigned char>(c));
            if (colon != std::string::npos && !key.empty())
              comment_values[key] = trim(content.substr(colon + 1));
          }
        else if (!header_seen)
          {
            read_header(line, required, optional);
            header_seen = true;
          }
        else
          read_row(line);
      }
    if (!header_seen)
      fail(std::max<std::size_t>(line_number, 1),
           1,
           "the header line with the names of the columns is missing");
  }



  void CsvTable::read_header(const std::string              &line,
                             const std::vector<std::string> &required,
                             const std::vector<std::string> &optional)
  {
    const auto cells = split(line);
    n_cells          = cells.size();
    for (std::size_t i = 0; i < cells.size(); ++i)
      {
        const std::string &name = cells[i].first;
        const bool         is_wanted =
          std::count(required.begin(), required.end(), name) +
            std::count(optional.begin(), optional.end(), name) >
          0;
        if (!is_wanted)
          continue;
        if (!cell_of.emplace(name, i).second)
          fail(line_number,
               cells[i].second + 1,
               "column '" + name + "' is given twice");
        values[name];
      }

    for (const std::string &name : required)
      if (!has(name))
        {
          std::string found;
          for (const auto &cell : cells)
            found += (found.empty() ? "" : ", ") + cell.first;
          fail(line_number,
               1,
               "column '" + name + "' is missing (the header has: " + found +
                 ")");
        }
  }



  void CsvTable::read_row(const std::string &line)
  {
    const auto cells = split(line);
    if (cells.size() != n_cells)
      fail(line_number,
           cells[std::min(cells.size() - 1, n_cells)].second + 1,
           "this row has " + std::to_string(cells.size()) +
             " cells, the header has " + std::to_string(n_cells));

    line_of_row.push_back(line_number);
    for (const auto &[name, i] : cell_of)
      {
        double value = 0.;
        if (!read_number(cells[i].first, value))
          fail(line_number,
               cells[i].second + 1,
               cells[i].first.empty() ?
                 "the value of " + name + " is missing" :
                 "'" + cells[i].first + "' is not a number (" + name + ")");
        values[name].push_back(value);
        begin_of_cell.push_back(cells[i].second);
      }
  }



  const std::map<std::string, std::string> &CsvTable::comments() const
  {
    return comment_values;
  }



  bool CsvTable::has(const std::string &column) const
  {
    return cell_of.count(column) > 0;
  }



  const std::vector<double> &
  CsvTable::operator[](const std::string &column) const
  {
    static const std::vector<double> none;
    const auto                       found = values.find(column);
    return found == values.end() ? none : found->second;
  }



  std::size_t CsvTable::size() const
  {
    return line_of_row.size();
  }



  void CsvTable::reject(const std::size_t  row,
                        const std::string &column,
                        const std::string &why) const
  {
    const auto position = std::distance(cell_of.begin(), cell_of.find(column));
    fail(line_of_row.at(row),
         begin_of_cell.at(row * cell_of.size() + position) + 1,
         why);
  }



  void CsvTable::fail(const std::size_t  line,
                      const std::size_t  column,
                      const std::string &why) const
  {
    throw InputError(file.string() + ":" + std::to_string(line) + ":" +
                     std::to_string(column) + ": " + why);
  }
} // namespace SlipStep
