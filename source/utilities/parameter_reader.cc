#include <deal.II/base/utilities.h>

#include <slipstep/utilities/decimal_comma.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/nearest_name.h>
#include <slipstep/utilities/parameter_reader.h>
#include <slipstep/utilities/pattern_words.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>

namespace SlipStep
{
  namespace
  {
    using dealii::Utilities::trim;

    std::string place(const std::filesystem::path &file,
                      const unsigned int           line)
    {
      return file.string() + ":" + std::to_string(line);
    }



    // Names of the file appear in JSON, HTML and pictures.
    bool is_utf8(const std::string &text)
    {
      unsigned int n_following = 0;
      for (const unsigned char c : text)
        if (n_following > 0)
          {
            if ((c & 0xC0) != 0x80)
              return false;
            --n_following;
          }
        else if (c >= 0xF8 || (c & 0xC0) == 0x80)
          return false;
        else
          n_following = c >= 0xF0 ? 3 : c >= 0xE0 ? 2 : c >= 0xC0 ? 1 : 0;
      return n_following == 0;
    }



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
      PrmStatement statement;
      statement.line   = line;
      std::string rest = text;
      std::string word = first_word(rest);
      if (word == "subsection" && !rest.empty())
        {
          statement.kind = PrmStatement::Kind::subsection;
          statement.name = rest;
        }
      else if (word == "end" && rest.empty())
        statement.kind = PrmStatement::Kind::end;
      else if (word == "include" && !rest.empty())
        {
          statement.kind  = PrmStatement::Kind::include;
          statement.value = rest;
        }
      else if (word == "set" && rest.find('=') != std::string::npos &&
               rest.front() != '=')
        {
          const std::size_t sign = rest.find('=');
          statement.kind         = PrmStatement::Kind::set;
          statement.name         = trim(rest.substr(0, sign));
          statement.value        = trim(rest.substr(sign + 1));
        }
      else
        {
          const std::vector<std::string> words = {"set",
                                                  "subsection",
                                                  "end",
                                                  "include"};
          const bool                     is_known =
            std::find(words.begin(), words.end(), word) != words.end();
          statement.kind  = PrmStatement::Kind::wrong;
          statement.value = where + ": \"" + excerpt(text) +
                            "\" is not understood" +
                            (is_known ? "" : did_you_mean(word, words)) +
                            " (a line is one of: set KEY = VALUE, subsection "
                            "NAME, end, include FILE, # comment)";
        }
      return statement;
    }
  } // namespace



  namespace
  {
    // Whatever ends the lines: LF, CR LF, or CR alone.
    std::string with_line_feeds(std::istream &in)
    {
      std::ostringstream all;
      all << in.rdbuf();
      std::string text;
      bool        is_after_cr = false;
      for (const char c : all.str())
        {
          if (c != '\n' || !is_after_cr)
            text += c == '\r' ? '\n' : c;
          is_after_cr = c == '\r';
        }
      return text;
    }
  } // namespace



  std::vector<PrmStatement> scan_prm_file(const std::filesystem::path &file)
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



  namespace
  {
    // The sections that define a sweep, as far as one file gives them.
    struct SweepText
    {
      bool                 has_variants = false;
      bool                 has_sweep    = false;
      std::string          key, key_origin;
      std::string          values, values_origin;
      std::vector<Variant> variants;
    };



    // A legend as a folder name: nothing that a shell or a URL would need
    // quoted.
    std::string folder_name(const std::string &label)
    {
      std::string folder;
      for (const char c : label)
        {
          const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) ||
                                c == '.' || c == '-' || c == '+' || c == '_';
          const char safe = is_plain ? c : (c == '/' ? '-' : '_');
          if (safe != '_' || folder.empty() || folder.back() != '_')
            folder += safe;
        }
      // Hidden folders, "..", and the report's own folder.
      if (folder.empty() || folder.front() == '.' || folder.front() == '-')
        folder.insert(0, "_");
      if (folder == "report")
        folder += "_";
      return folder;
    }



    class CaseReader
    {
    public:
      explicit CaseReader(const Parameters &known)
        : known(known)
      {}

      /// Read a file, after everything that it includes.
      void read_file(const std::filesystem::path &file);

      CaseText text;
      /// What is wrong, in the order of the lines.
      std::vector<std::string> errors;

    private:
      /// What follows in the file would be misread.
      class MissingEnd : public InputError
      {
        using InputError::InputError;
      };

      struct OpenSection
      {
        std::string  name;
        unsigned int line;
        /// Told already: what is in it is skipped.
        bool is_unknown = false;

        std::string in_words() const
        {
          return "subsection " + excerpt(name) + " is open since line " +
                 std::to_string(line);
        }
      };

      /// The state of reading one file.
      struct FileState
      {
        std::filesystem::path               file;
        std::vector<OpenSection>            sections;
        std::vector<Assignment>             assignments;
        std::map<std::string, unsigned int> line_of_key;
        SweepText                           sweep;
      };

      void read_statements(FileState                       &state,
                           const std::vector<PrmStatement> &statements);

      void read_statement(FileState &state, const PrmStatement &statement);

      void open_section(FileState &state, const PrmStatement &statement) const;

      void check_section(FileState &state, const PrmStatement &statement) const;

      bool is_section_outside(const FileState   &state,
                              const std::string &name) const;

      void close_section(FileState &state, const PrmStatement &statement) const;

      void set_key(FileState &state, const PrmStatement &statement) const;

      void set_sweep_key(FileState &state, const PrmStatement &statement) const;

      void add_override(FileState &state, const PrmStatement &statement) const;

      void include_file(FileState &state, const PrmStatement &statement);

      void finish_sweep(FileState &state);

      std::vector<Variant> variants_of_sweep(const SweepText &sweep,
                                             const FileState &state) const;

      static void add_variant(std::vector<Variant> &variants,
                              const std::string    &label,
                              const std::string    &origin);

      static std::string path_of(const FileState   &state,
                                 const std::string &name,
                                 const std::size_t  n_skipped_sections = 0);

      const Parameters                  &known;
      std::vector<std::filesystem::path> open_files;
    };



    std::string CaseReader::path_of(const FileState   &state,
                                    const std::string &name,
                                    const std::size_t  n_skipped_sections)
    {
      std::string path;
      for (std::size_t i = n_skipped_sections; i < state.sections.size(); ++i)
        path += state.sections[i].name + "/";
      return path + name;
    }



    void CaseReader::read_file(const std::filesystem::path &file)
    {
      FileState state;
      state.file            = file;
      const auto statements = scan_prm_file(file);
      const auto canonical  = std::filesystem::canonical(file);
      open_files.push_back(canonical);
      try
        {
          read_statements(state, statements);
          finish_sweep(state);
        }
      catch (const InputError &error)
        {
          errors.push_back(error.what());
        }
      ++text.n_layers;
      for (Assignment &assignment : state.assignments)
        {
          assignment.layer = text.n_layers;
          text.assignments.push_back(assignment);
        }
      open_files.pop_back();
    }



    void
    CaseReader::read_statements(FileState                       &state,
                                const std::vector<PrmStatement> &statements)
    {
      for (const PrmStatement &statement : statements)
        try
          {
            read_statement(state, statement);
          }
        catch (const MissingEnd &)
          {
            throw;
          }
        catch (const InputError &error)
          {
            errors.push_back(error.what());
          }
      if (!state.sections.empty())
        throw MissingEnd(place(state.file, state.sections.back().line) +
                         ": subsection " + excerpt(state.sections.back().name) +
                         ", begun here, is never closed by an \"end\"");
    }



    void CaseReader::read_statement(FileState          &state,
                                    const PrmStatement &statement)
    {
      using Kind           = PrmStatement::Kind;
      const auto &sections = state.sections;
      if (statement.kind == Kind::wrong)
        throw InputError(statement.value);
      else if (statement.kind == Kind::subsection)
        open_section(state, statement);
      else if (statement.kind == Kind::end)
        close_section(state, statement);
      else if (statement.kind == Kind::include)
        include_file(state, statement);
      else if (sections.empty())
        set_key(state, statement);
      else if (sections.back().is_unknown)
        return;
      else if (sections.front().name == "Sweep")
        set_sweep_key(state, statement);
      else if (sections.front().name == "Variants")
        add_override(state, statement);
      else
        set_key(state, statement);
    }



    void CaseReader::open_section(FileState          &state,
                                  const PrmStatement &statement) const
    {
      const bool is_inside_unknown =
        !state.sections.empty() && state.sections.back().is_unknown;
      try
        {
          if (!is_inside_unknown)
            check_section(state, statement);
          state.sections.push_back(
            {statement.name, statement.line, is_inside_unknown});
        }
      catch (const InputError &)
        {
          state.sections.push_back({statement.name, statement.line, true});
          throw;
        }
    }



    void CaseReader::check_section(FileState          &state,
                                   const PrmStatement &statement) const
    {
      const std::string where  = place(state.file, statement.line);
      SweepText        &sweep  = state.sweep;
      const bool        is_top = state.sections.empty();
      const bool        is_in_variants =
        !is_top && state.sections.front().name == "Variants";
      const std::string path =
        path_of(state, statement.name, is_in_variants ? 2 : 0);

      if (is_top && statement.name == "Variants")
        sweep.has_variants = true;
      else if (is_top && statement.name == "Sweep")
        sweep.has_sweep = true;
      else if (is_in_variants && state.sections.size() == 1)
        add_variant(sweep.variants, statement.name, where);
      else if (known.paths(path + "/").empty() &&
               is_section_outside(state, statement.name))
        throw MissingEnd(where + ": an \"end\" is missing before subsection " +
                         statement.name + ": " +
                         state.sections.back().in_words());
      else if (!is_top && state.sections.front().name == "Sweep")
        throw InputError(where + ": Sweep has no subsections, only "
                                 "\"set Key = ...\" and \"set Values = ...\"");
      else if (known.paths(path + "/").empty() && is_in_variants &&
               state.sections.size() == 2)
        throw InputError(where + ": unknown section " + excerpt(path) +
                         "; if it is a variant, an \"end\" is missing: " +
                         state.sections.back().in_words());
      else
        known.check_section(path, where);
      if (sweep.has_variants && sweep.has_sweep)
        throw InputError(where + ": both Variants and Sweep are given; a case "
                                 "has one of them");
    }



    // Whether the file would go on with this section, were those closed that
    // are open.
    bool CaseReader::is_section_outside(const FileState   &state,
                                        const std::string &name) const
    {
      if (state.sections.empty())
        return false;
      if (name == "Sweep" || name == "Variants")
        return true;
      FileState outer = state;
      while (!outer.sections.empty())
        {
          outer.sections.pop_back();
          const bool is_in_variants = !outer.sections.empty() &&
                                      outer.sections.front().name == "Variants";
          if (!known.paths(path_of(outer, name, is_in_variants ? 2 : 0) + "/")
                 .empty())
            return true;
        }
      return false;
    }



    void CaseReader::close_section(FileState          &state,
                                   const PrmStatement &statement) const
    {
      if (state.sections.empty())
        throw InputError(place(state.file, statement.line) +
                         ": \"end\" without a subsection that it could close");
      state.sections.pop_back();
    }



    void CaseReader::set_key(FileState          &state,
                             const PrmStatement &statement) const
    {
      const std::string where = place(state.file, statement.line);
      const std::string path  = path_of(state, statement.name);
      if (!state.sections.empty() && known.paths(path).empty() &&
          !known.paths(statement.name).empty())
        throw InputError(
          where + ": unknown key " + excerpt(path) + "; for " + statement.name +
          ", an \"end\" is missing: " + state.sections.back().in_words());
      known.check(path, statement.value, where);
      const auto inserted = state.line_of_key.emplace(path, statement.line);
      if (!inserted.second)
        throw InputError(where + ": " + path +
                         " is given twice, first in line " +
                         std::to_string(inserted.first->second));
      state.assignments.push_back({path, statement.value, where, 0});
    }



    void CaseReader::set_sweep_key(FileState          &state,
                                   const PrmStatement &statement) const
    {
      const std::string where  = place(state.file, statement.line);
      SweepText        &sweep  = state.sweep;
      const bool        is_key = statement.name == "Key";
      std::string      &value  = is_key ? sweep.key : sweep.values;
      std::string &origin = is_key ? sweep.key_origin : sweep.values_origin;
      if (!is_key && statement.name != "Values")
        throw InputError(where + ": unknown key Sweep/" + statement.name +
                         did_you_mean(statement.name, {"Key", "Values"}) +
                         " Known are Key and Values");
      if (!origin.empty())
        throw InputError(where + ": Sweep/" + statement.name +
                         " is given twice, first at " + origin);
      value  = statement.value;
      origin = where;
      if (is_key)
        known.check_path(value, where);
    }



    void CaseReader::add_override(FileState          &state,
                                  const PrmStatement &statement) const
    {
      const std::string where = place(state.file, statement.line);
      if (state.sections.size() < 2)
        throw InputError(where + ": in Variants, \"set\" stands in a "
                                 "subsection named after the variant");
      const std::string path = path_of(state, statement.name, 2);
      known.check(path, statement.value, where);
      Variant &variant = state.sweep.variants.back();
      for (const Variant::Override &other : variant.overrides)
        if (other.path == path)
          throw InputError(where + ": " + path +
                           " is given twice in this variant, first at " +
                           other.origin);
      variant.overrides.push_back({path, statement.value, where});
    }



    void CaseReader::include_file(FileState          &state,
                                  const PrmStatement &statement)
    {
      const std::string where = place(state.file, statement.line);
      if (!state.sections.empty())
        throw InputError(where +
                         ": \"include\" must stand outside of "
                         "subsections; an \"end\" is missing: " +
                         state.sections.back().in_words());
      const std::filesystem::path file =
        (state.file.parent_path() / statement.value).lexically_normal();
      std::error_code error;
      const auto canonical = std::filesystem::weakly_canonical(file, error);
      if (std::find(open_files.begin(), open_files.end(), canonical) !=
          open_files.end())
        throw InputError(where + ": " + file.string() +
                         " includes itself (a circle of includes)");
      const std::string what = where + ": include " + statement.value + ": ";
      if (!std::filesystem::exists(file))
        throw InputError(what + "no such file (looked for " + file.string() +
                         ")");
      if (!std::filesystem::is_regular_file(file))
        throw InputError(what + "not a file");

      const std::size_t n_before = text.assignments.size();
      read_file(file);
      for (std::size_t i = n_before; i < text.assignments.size(); ++i)
        {
          const Assignment &included = text.assignments[i];
          const auto        own      = state.line_of_key.find(included.path);
          if (own != state.line_of_key.end())
            throw InputError(where + ": " + included.path +
                             " is set before this include (line " +
                             std::to_string(own->second) + ") and in it (" +
                             included.origin + "); move the include up");
        }
    }



    void CaseReader::add_variant(std::vector<Variant> &variants,
                                 const std::string    &label,
                                 const std::string    &origin)
    {
      const std::string folder = folder_name(label);
      for (const Variant &other : variants)
        {
          if (other.label == label)
            throw InputError(origin + ": the variant \"" + label +
                             "\" is given twice");
          if (other.folder == folder)
            throw InputError(origin + ": the variants \"" + other.label +
                             "\" and \"" + label +
                             "\" would share the folder " + folder);
        }
      variants.push_back({label, folder, {}});
    }



    std::vector<Variant>
    CaseReader::variants_of_sweep(const SweepText &sweep,
                                  const FileState &state) const
    {
      if (sweep.key_origin.empty() || sweep.values_origin.empty())
        throw InputError(
          (sweep.key_origin.empty() && sweep.values_origin.empty() ?
             state.file.string() :
             sweep.key_origin + sweep.values_origin) +
          ": Sweep needs both \"set Key = ...\" and \"set Values = ...\"");
      const char separator =
        sweep.values.find(';') == std::string::npos ? ',' : ';';
      const std::string name = sweep.key.substr(sweep.key.rfind('/') + 1);
      const std::string hint = decimal_comma_hint(sweep.values);
      if (separator == ',' && !hint.empty() &&
          sweep.values.find(", ") != std::string::npos)
        throw InputError(
          sweep.values_origin + ": Sweep/Values = " + excerpt(sweep.values) +
          ": " + hint + " (commas separate; write a blank behind them)");

      std::vector<Variant> variants;
      for (const std::string &value :
           dealii::Utilities::split_string_list(sweep.values, separator))
        {
          known.check(sweep.key, value, sweep.values_origin);
          // A bare number says nothing in a legend.
          const bool is_bare =
            value.find_first_not_of("0123456789.+-eE") == std::string::npos;
          add_variant(variants,
                      is_bare ? name + " " + value : value,
                      sweep.values_origin);
          variants.back().overrides.push_back(
            {sweep.key, value, sweep.values_origin});
        }
      if (variants.empty())
        throw InputError(sweep.values_origin + ": Sweep/Values is empty");
      return variants;
    }



    void CaseReader::finish_sweep(FileState &state)
    {
      if (state.sweep.has_sweep)
        text.variants = variants_of_sweep(state.sweep, state);
      else if (state.sweep.has_variants)
        {
          // An empty section undoes the sweep of an included file.
          if (state.sweep.variants.empty() && text.variants.empty())
            throw InputError(state.file.string() +
                             ": Variants is empty; it needs a subsection for "
                             "each variant, named after it");
          text.variants = state.sweep.variants;
        }
    }
  } // namespace



  CaseText read_case_text(const std::filesystem::path &file,
                          const Parameters            &known)
  {
    constexpr std::size_t most_shown = 20;

    CaseReader reader(known);
    reader.read_file(file);
    std::string message;
    for (std::size_t i = 0; i < std::min(reader.errors.size(), most_shown); ++i)
      message += (i == 0 ? "" : "\n") + reader.errors[i];
    if (reader.errors.size() > most_shown)
      message +=
        "\nand " + std::to_string(reader.errors.size() - most_shown) + " more";
    if (!message.empty())
      throw InputError(message);
    return reader.text;
  }
} // namespace SlipStep
