// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/raw_files.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

namespace SlipStep
{
  namespace
  {
    namespace fs = std::filesystem;

    const char *const wildcards = "*?";

    bool matches_from(const std::string        &name,
                      const std::size_t         at,
                      const std::string        &pattern,
                      const std::size_t         next,
                      std::vector<std::string> &found)
    {
      if (next == pattern.size())
        return at == name.size();
      if (pattern[next] != '*' && pattern[next] != '?')
        return at < name.size() && name[at] == pattern[next] &&
               matches_from(name, at + 1, pattern, next + 1, found);
      const std::size_t least = pattern[next] == '?' ? 1 : 0;
      const std::size_t most  = pattern[next] == '?' ? 1 : name.size() - at;
      for (std::size_t n = least; n <= most && at + n <= name.size(); ++n)
        {
          found.push_back(name.substr(at, n));
          if (matches_from(name, at + n, pattern, next + 1, found))
            return true;
          found.pop_back();
        }
      return false;
    }
  } // namespace



  bool has_wildcards(const std::string &name)
  {
    return name.find_first_of(wildcards) != std::string::npos;
  }



  bool matches_pattern(const std::string                  &name,
                       const std::string                  &pattern,
                       std::map<std::string, std::string> &found)
  {
    std::vector<std::string> parts;
    if (!matches_from(name, 0, pattern, 0, parts))
      return false;
    for (std::size_t i = 0; i < parts.size(); ++i)
      found[std::to_string(i + 1)] = parts[i];
    return true;
  }



  std::vector<RawFile> files_of_pattern(const fs::path &pattern)
  {
    const fs::path folder =
      pattern.has_parent_path() ? pattern.parent_path() : fs::path(".");
    if (has_wildcards(folder.string()))
      throw InputError(pattern.string() +
                       ": wildcards are for names of files, not of folders");
    if (!fs::is_directory(folder))
      throw InputError(folder.string() + ": there is no such folder");
    std::vector<RawFile> files;
    for (const auto &entry : fs::directory_iterator(folder))
      {
        RawFile file{pattern.has_parent_path() ? entry.path() :
                                                 entry.path().filename(),
                     {}};
        if (entry.is_regular_file() &&
            matches_pattern(entry.path().filename().string(),
                            pattern.filename().string(),
                            file.found))
          files.push_back(file);
      }
    if (files.empty())
      throw InputError(pattern.string() + ": no file has a name like this");
    sort(files, [](const auto &a, const auto &b) { return a.file < b.file; });
    return files;
  }



  std::vector<fs::path> named_files(const Parameters  &parameters,
                                    const std::string &key)
  {
    std::vector<fs::path> files;
    for (const std::string &name : parameters.list(key))
      {
        const fs::path  file = parameters.resolve(name);
        std::error_code error;
        if (fs::exists(file, error))
          files.push_back(file);
        else if (has_wildcards(name))
          for (const RawFile &found :
               parameters.attempt(key, [&] { return files_of_pattern(file); }))
            files.push_back(found.file);
        else
          parameters.reject(key, "there is no " + excerpt(file.string(), 300));
      }
    return files;
  }



  std::string filled_in(const std::string                        &text,
                        const std::map<std::string, std::string> &values)
  {
    std::string result;
    for (std::size_t at = 0; at < text.size();)
      {
        const std::size_t open = text.find('{', at);
        result += text.substr(at, open - at);
        if (open == std::string::npos)
          break;
        const std::size_t close = text.find('}', open);
        if (close == std::string::npos)
          throw InputError("a } is missing");
        const std::string name  = text.substr(open + 1, close - open - 1);
        const auto        value = values.find(name);
        if (value == values.end())
          {
            std::string known;
            for (const auto &[key, ignored] : values)
              known += (known.empty() ? "{" : ", {") + key + "}";
            throw InputError("nothing is known as {" + name + "}" +
                             (known.empty() ? "" : " (known: " + known + ")"));
          }
        result += value->second;
        at = close + 1;
      }
    return result;
  }



  CsvFormat raw_format(const Parameters &map)
  {
    const std::string delimiter = map.text("Raw file/Delimiter");
    const std::string mark      = map.text("Raw file/Decimal mark");
    const std::string thousands = map.text("Raw file/Thousands mark");
    CsvFormat         format;
    format.delimiter      = delimiter == "tab"       ? '\t' :
                            delimiter == "comma"     ? ',' :
                            delimiter == "semicolon" ? ';' :
                            delimiter == "blanks"    ? ' ' :
                                                       '\0';
    format.decimal_mark   = mark == "point" ? '.' : mark == "comma" ? ',' : 0;
    format.thousands_mark = thousands == "point"      ? '.' :
                            thousands == "comma"      ? ',' :
                            thousands == "blank"      ? ' ' :
                            thousands == "apostrophe" ? '\'' :
                                                        '\0';
    if (thousands == "point" || thousands == "comma")
      {
        const char other = thousands == "point" ? ',' : '.';
        if (format.decimal_mark != 0 && format.decimal_mark != other)
          map.reject("Raw file/Thousands mark",
                     "decimals have this mark (Raw file/Decimal mark)");
        format.decimal_mark = other;
      }
    format.header_line = map.integer("Raw file/Header line");
    format.units_line  = map.integer("Raw file/Units line");
    format.has_header  = map.boolean("Raw file/Has header");
    if (format.units_line > 0 && format.units_line == format.header_line &&
        format.has_header)
      map.reject("Raw file/Units line", "this is the header line");
    for (const std::string &comment : map.list("Raw file/Comment marks"))
      format.comment_marks.push_back(comment);
    format.may_have_gaps = true;
    return format;
  }
} // namespace SlipStep
