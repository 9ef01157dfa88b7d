// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/paths.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/nearest_name.h>
#include <slipstep/utilities/parameter_reader.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/variants.h>

#include <algorithm>

namespace SlipStep
{
  namespace
  {
    // A key that is swept: "Key" and "Values", "Key 2" and "Values 2", ...
    struct SweptKey
    {
      std::string key, key_origin;
      std::string values, values_origin;
    };



    // The sections that define a sweep, as far as one file gives them.
    struct SweepText
    {
      bool                             has_variants = false;
      bool                             has_sweep    = false;
      std::map<unsigned int, SweptKey> keys; ///< by their numbers
      std::vector<Variant>             variants;
    };



    // Values are separated by commas, or by ';' if one contains a comma.
    std::vector<std::string> separate_values(const SweptKey &swept)
    {
      const char separator =
        swept.values.find(';') == std::string::npos ? ',' : ';';
      const std::string hint = decimal_comma_hint(swept.values);
      if (separator == ',' && !hint.empty() &&
          swept.values.find(", ") != std::string::npos)
        throw InputError(
          swept.values_origin + ": Sweep/Values = " + excerpt(swept.values) +
          ": " + hint + " (commas separate values; write a blank after each)");
      const auto values =
        dealii::Utilities::split_string_list(swept.values, separator);
      if (values.empty())
        throw InputError(swept.values_origin + ": Sweep/Values is empty");
      return values;
    }



    class CaseReader
    {
    public:
      explicit CaseReader(const Parameters &known)
        : known(known)
      {}

      /// Read a file, after everything that it includes.
      void read_file(const std::filesystem::path &file)
      {
        FileState state;
        state.file                   = file;
        const auto        statements = read_prm_statements(file);
        const auto        canonical  = std::filesystem::canonical(file);
        const std::size_t n_before   = errors.size();
        open_files.push_back(canonical);
        try
          {
            read_statements(state, statements);
            // What is wrong in it has been told.
            if (errors.size() == n_before)
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
                           ": subsection " +
                           excerpt(state.sections.back().name) +
                           ", begun here, is never closed by an \"end\"");
      }

      void read_statement(FileState &state, const PrmStatement &statement)
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

      void open_section(FileState &state, const PrmStatement &statement) const
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

      void check_section(FileState &state, const PrmStatement &statement) const
      {
        SweepText &sweep  = state.sweep;
        const bool is_top = state.sections.empty();
        const bool is_in_variants =
          !is_top && state.sections.front().name == "Variants";
        const std::string path =
          path_of(state, statement.name, is_in_variants ? 2 : 0);

        if (is_top && statement.name == "Variants")
          sweep.has_variants = true;
        else if (is_top && statement.name == "Sweep")
          sweep.has_sweep = true;
        else if (is_in_variants && state.sections.size() == 1)
          add_variant(sweep.variants, statement.name, statement.where);
        else if (known.paths(path + "/").empty() &&
                 is_section_outside(state, statement.name))
          throw MissingEnd(
            statement.where + ": an \"end\" is missing before subsection " +
            statement.name + ": " + state.sections.back().in_words());
        else if (!is_top && state.sections.front().name == "Sweep")
          throw InputError(statement.where +
                           ": Sweep has no subsections, only "
                           "\"set Key = ...\" and \"set Values = ...\"");
        else if (known.paths(path + "/").empty() && is_in_variants &&
                 state.sections.size() == 2)
          throw InputError(statement.where + ": unknown section " +
                           excerpt(path) +
                           "; if it is a variant, an \"end\" is missing: " +
                           state.sections.back().in_words());
        else
          known.check_section(path, statement.where);
        if (sweep.has_variants && sweep.has_sweep)
          throw InputError(statement.where +
                           ": both Variants and Sweep are given; a case "
                           "has one of them");
      }

      // Whether the file would go on with this section, were those closed that
      // are open.
      bool is_section_outside(const FileState   &state,
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
            const bool is_in_variants =
              !outer.sections.empty() &&
              outer.sections.front().name == "Variants";
            if (!known.paths(path_of(outer, name, is_in_variants ? 2 : 0) + "/")
                   .empty())
              return true;
          }
        return false;
      }

      void close_section(FileState &state, const PrmStatement &statement) const
      {
        if (state.sections.empty())
          throw InputError(
            statement.where +
            ": \"end\" without a subsection that it could close");
        state.sections.pop_back();
      }

      void set_key(FileState &state, const PrmStatement &statement) const
      {
        const std::string path = path_of(state, statement.name);
        if (!state.sections.empty() && known.paths(path).empty() &&
            !known.paths(statement.name).empty())
          throw InputError(
            statement.where + ": unknown key " + excerpt(path) + "; for " +
            statement.name +
            ", an \"end\" is missing: " + state.sections.back().in_words());
        known.check(path, statement.value, statement.where);
        const auto inserted = state.line_of_key.emplace(path, statement.line);
        if (!inserted.second)
          throw InputError(statement.where + ": " + path +
                           " is given twice, first in line " +
                           std::to_string(inserted.first->second));
        state.assignments.push_back(
          {path, statement.value, statement.where, 0});
      }

      // "Key", "Values", or with a number from 2 behind it.
      void set_sweep_key(FileState &state, const PrmStatement &statement) const
      {
        const std::size_t blank    = statement.name.find(' ');
        const std::string word     = statement.name.substr(0, blank);
        const bool        is_key   = word == "Key";
        unsigned int      number   = 1;
        bool              is_known = is_key || word == "Values";
        if (blank != std::string::npos)
          {
            const std::string digits =
              dealii::Utilities::trim(statement.name.substr(blank));
            is_known =
              is_known && !digits.empty() && digits.size() < 4 &&
              digits.find_first_not_of("0123456789") == std::string::npos &&
              digits != "0" && digits != "1";
            if (is_known)
              number = std::stoi(digits);
          }
        if (!is_known)
          throw InputError(
            statement.where + ": unknown key Sweep/" + statement.name +
            did_you_mean(statement.name,
                         {"Key", "Values", "Key 2", "Values 2"}) +
            " Known are Key and Values, Key 2 and Values 2, and so on");
        SweptKey    &swept  = state.sweep.keys[number];
        std::string &value  = is_key ? swept.key : swept.values;
        std::string &origin = is_key ? swept.key_origin : swept.values_origin;
        if (!origin.empty())
          throw InputError(statement.where + ": Sweep/" + statement.name +
                           " is given twice, first at " + origin);
        value  = statement.value;
        origin = statement.where;
        if (value.empty())
          throw InputError(statement.where + ": Sweep/" + statement.name +
                           " is empty; to run a case without the sweep that it "
                           "includes, write an empty subsection Variants");
        if (is_key)
          known.check_path(value, statement.where);
      }

      void add_override(FileState &state, const PrmStatement &statement) const
      {
        if (state.sections.size() < 2)
          throw InputError(statement.where +
                           ": in Variants, \"set\" stands in a "
                           "subsection named after the variant");
        const std::string path = path_of(state, statement.name, 2);
        known.check(path, statement.value, statement.where);
        Variant &variant = state.sweep.variants.back();
        for (const Variant::Override &other : variant.overrides)
          if (other.path == path)
            throw InputError(statement.where + ": " + path +
                             " is given twice in this variant, first at " +
                             other.origin);
        variant.overrides.push_back({path, statement.value, statement.where});
      }

      static std::filesystem::path included_file(const FileState    &state,
                                                 const PrmStatement &statement)
      {
        try
          {
            return (state.file.parent_path() / with_home(statement.value))
              .lexically_normal();
          }
        catch (const InputError &error)
          {
            throw InputError(statement.where + ": include " + error.what());
          }
      }

      void include_file(FileState &state, const PrmStatement &statement)
      {
        if (!state.sections.empty())
          throw InputError(statement.where +
                           ": \"include\" must stand outside of "
                           "subsections; an \"end\" is missing: " +
                           state.sections.back().in_words());
        const std::filesystem::path file = included_file(state, statement);
        std::error_code             error;
        const auto canonical = std::filesystem::weakly_canonical(file, error);
        if (holds(open_files, canonical))
          throw InputError(statement.where + ": " + file.string() +
                           " includes itself (a circle of includes)");
        const std::string what =
          statement.where + ": include " + excerpt(statement.value) + ": ";
        if (!std::filesystem::exists(file, error))
          throw InputError(what + "no such file (looked for " +
                           excerpt(file.string(), 300) + ")");
        if (!std::filesystem::is_regular_file(file, error))
          throw InputError(what + "not a file");

        const std::size_t n_before = text.assignments.size();
        read_file(file);
        for (std::size_t i = n_before; i < text.assignments.size(); ++i)
          {
            const Assignment &included = text.assignments[i];
            const auto        own      = state.line_of_key.find(included.path);
            if (own != state.line_of_key.end())
              throw InputError(statement.where + ": " + included.path +
                               " is set before this include (line " +
                               std::to_string(own->second) + ") and in it (" +
                               included.origin + "); move the include up");
          }
      }

      void finish_sweep(FileState &state)
      {
        if (state.sweep.has_sweep)
          text.variants = variants_of_sweep(state.sweep, state);
        else if (!state.sweep.has_variants)
          require_no_value_for_included_sweep(state);
        else
          {
            // An empty section undoes the sweep of an included file.
            if (state.sweep.variants.empty() && text.variants.empty())
              throw InputError(state.file.string() +
                               ": Variants is empty; it needs a subsection for "
                               "each variant, named after it");
            text.variants = state.sweep.variants;
          }
      }

      // The file overrides what it includes, but a sweep decides on its keys.
      void require_no_value_for_included_sweep(const FileState &state) const
      {
        for (const Variant &variant : text.variants)
          for (const Variant::Override &swept : variant.overrides)
            if (const auto own = state.line_of_key.find(swept.path);
                own != state.line_of_key.end() &&
                swept.origin.rfind(state.file.string() + ":", 0) != 0)
              throw InputError(
                place(state.file, own->second) + ": " + swept.path +
                " is swept by an included file (" + swept.origin +
                "), so that this value would have no effect; sweep it here, or "
                "end that sweep with an empty subsection Variants");
      }

      // The first key changes last.
      std::vector<Variant> variants_of_sweep(const SweepText &sweep,
                                             const FileState &state) const
      {
        std::vector<Variant> variants;
        if (sweep.keys.empty())
          throw InputError(
            state.file.string() +
            ": Sweep needs both \"set Key = ...\" and \"set Values = ...\"");
        if (sweep.keys.begin()->first != 1)
          throw InputError(sweep.keys.begin()->second.key_origin +
                           ": Sweep has a further key, but no Key; this "
                           "section replaces the whole sweep of an included "
                           "file");
        for (const auto &[number, swept] : sweep.keys)
          {
            const std::string n =
              number == 1 ? "" : " " + std::to_string(number);
            if (swept.key_origin.empty() || swept.values_origin.empty())
              throw InputError(swept.key_origin + swept.values_origin +
                               ": Sweep needs both \"set Key" + n +
                               " = ...\" and \"set Values" + n + " = ...\"");
            const auto of_key = variants_of_values(known,
                                                   swept.key,
                                                   separate_values(swept),
                                                   swept.values_origin,
                                                   sweep.keys.size() == 1);
            variants          = variants.empty() ?
                                  of_key :
                                  product(variants, of_key, swept.key_origin);
          }
        return variants;
      }

      static std::string path_of(const FileState   &state,
                                 const std::string &name,
                                 const std::size_t  n_skipped_sections = 0)
      {
        std::string path;
        for (std::size_t i = n_skipped_sections; i < state.sections.size(); ++i)
          path += state.sections[i].name + "/";
        return path + name;
      }

      const Parameters                  &known;
      std::vector<std::filesystem::path> open_files;
    };
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
