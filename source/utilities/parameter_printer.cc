// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <slipstep/utilities/parameter_printer.h>
#include <slipstep/utilities/pattern_words.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/variants.h>

#include <nlohmann/json.hpp>

namespace SlipStep
{
  namespace
  {
    /// The tree of sections that a list of paths spans; sections in the order
    /// in which they were first met.
    struct ParameterSection
    {
      std::string                   name; ///< "" for the whole
      std::string                   path;
      std::vector<PrintedParameter> parameters;
      std::vector<ParameterSection> subsections;
    };



    ParameterSection &subsection(ParameterSection  &parent,
                                 const std::string &name)
    {
      for (ParameterSection &section : parent.subsections)
        if (section.name == name)
          return section;
      parent.subsections.push_back(
        {name, parent.path.empty() ? name : parent.path + "/" + name, {}, {}});
      return parent.subsections.back();
    }



    void print_setting(std::ostream      &out,
                       const std::string &indent,
                       const std::string &key,
                       const std::string &value)
    {
      out << indent << "set " << key << " =" << (value.empty() ? "" : " ")
          << value << '\n';
    }



    void print_prm_section(std::ostream                &out,
                           const ParameterSection      &section,
                           const std::string           &indent,
                           const std::set<std::string> &disabled_sections,
                           const bool                   explains = true)
    {
      bool is_first = true;
      for (const auto &[entry, value] : section.parameters)
        {
          if (explains)
            {
              out << (is_first ? "" : "\n");
              out << commented(entry.documentation + " [" +
                                 allowed_in_words(*entry.pattern) + "]",
                               indent,
                               80);
            }
          is_first = false;
          print_setting(out, indent, name_of_key(entry.path), value);
        }
      for (const ParameterSection &child : section.subsections)
        {
          out << (is_first || !explains ? "" : "\n");
          is_first = false;
          const std::string mark =
            disabled_sections.count(child.path) ? "# " : "";
          out << indent << mark << "subsection " << child.name << '\n';
          print_prm_section(
            out, child, indent + mark + "  ", disabled_sections, explains);
          out << indent << mark << "end\n";
        }
    }



    nlohmann::ordered_json json_section(const ParameterSection &section)
    {
      nlohmann::ordered_json object = nlohmann::ordered_json::object();
      for (const auto &[entry, value] : section.parameters)
        object[name_of_key(entry.path)] = {
          {"value", value},
          {"default", entry.default_value},
          {"documentation", entry.documentation},
          {"allowed", allowed_in_words(*entry.pattern)}};
      for (const ParameterSection &child : section.subsections)
        object[child.name] = json_section(child);
      return object;
    }



    nlohmann::ordered_json schema_of(const Parameters::Entry &entry)
    {
      nlohmann::ordered_json schema = {
        {"type", "string"},
        {"default", entry.default_value},
        {"description",
         entry.documentation + " [" + allowed_in_words(*entry.pattern) + "]"}};
      const std::vector<std::string> choices = choices_of(*entry.pattern);
      if (!choices.empty())
        schema["enum"] = choices;
      return schema;
    }



    nlohmann::ordered_json schema_of(const ParameterSection &section)
    {
      auto properties = nlohmann::ordered_json::object();
      for (const auto &[entry, value] : section.parameters)
        properties[name_of_key(entry.path)] = schema_of(entry);
      for (const ParameterSection &child : section.subsections)
        properties[child.name] = schema_of(child);
      return {{"type", "object"},
              {"additionalProperties", false},
              {"properties", properties}};
    }



    // A cell of a table: no bars, no line breaks.
    std::string cell(std::string text)
    {
      text = dealii::Utilities::replace_in_string(text, "|", "\\|");
      std::replace(text.begin(), text.end(), '\n', ' ');
      return text;
    }



    ParameterSection
    parameter_tree(const std::vector<PrintedParameter> &parameters)
    {
      ParameterSection root;
      for (const PrintedParameter &parameter : parameters)
        {
          ParameterSection *section = &root;
          const auto        names =
            dealii::Utilities::split_string_list(parameter.entry.path, '/');
          for (std::size_t i = 0; i + 1 < names.size(); ++i)
            section = &subsection(*section, names[i]);
          section->parameters.push_back(parameter);
        }
      return root;
    }



    void print_prm(std::ostream                &out,
                   const ParameterSection      &root,
                   const std::vector<Variant>  &variants,
                   const std::set<std::string> &disabled_sections)
    {
      print_prm_section(out, root, "", disabled_sections);
      if (variants.empty())
        return;
      out << "\nsubsection Variants\n";
      for (const Variant &variant : variants)
        {
          out << "  subsection " << variant.label << '\n';
          for (const Variant::Override &setting : variant.overrides)
            print_setting(out, "    ", setting.path, setting.value);
          out << "  end\n";
        }
      out << "end\n";
    }



    void print_schema(std::ostream &out, const ParameterSection &root)
    {
      nlohmann::ordered_json schema = {
        {"$schema", "http://json-schema.org/draft-07/schema#"},
        {"title", "slipstep"}};
      schema.update(schema_of(root));
      out << schema.dump(2) << '\n';
    }



    void print_markdown(std::ostream &out, const ParameterSection &root)
    {
      if (!root.parameters.empty())
        {
          if (!root.path.empty())
            out << "## " << root.path << "\n\n";
          out << "| Key | Default | Allowed | Meaning |\n"
              << "| --- | --- | --- | --- |\n";
          for (const auto &[entry, value] : root.parameters)
            out << "| " << cell(name_of_key(entry.path)) << " | "
                << (entry.default_value.empty() ?
                      "" :
                      "`" + cell(entry.default_value) + "`")
                << " | " << cell(allowed_in_words(*entry.pattern)) << " | "
                << cell(entry.documentation) << " |\n";
          out << '\n';
        }
      for (const ParameterSection &child : root.subsections)
        print_markdown(out, child);
    }
  } // namespace



  void print_settings(std::ostream                        &out,
                      const std::vector<PrintedParameter> &parameters)
  {
    print_prm_section(out, parameter_tree(parameters), "", {}, false);
  }



  void print_parameters(std::ostream                        &out,
                        const Parameters::Format             format,
                        const std::vector<PrintedParameter> &parameters,
                        const std::vector<Variant>          &variants,
                        const std::set<std::string>         &disabled_sections)
  {
    const ParameterSection root = parameter_tree(parameters);
    switch (format)
      {
        case Parameters::Format::prm:
          print_prm(out, root, variants, disabled_sections);
          break;
        case Parameters::Format::json:
          out << json_section(root).dump(2) << '\n';
          break;
        case Parameters::Format::schema:
          print_schema(out, root);
          break;
        case Parameters::Format::keys:
          for (const PrintedParameter &parameter : parameters)
            out << parameter.entry.path << '\n';
          break;
        case Parameters::Format::markdown:
          print_markdown(out, root);
          break;
      }
  }
} // namespace SlipStep
