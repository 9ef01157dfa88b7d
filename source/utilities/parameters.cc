// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/exceptions.h>
#include <deal.II/base/utilities.h>

#include <slipstep/utilities/paths.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/parameter_printer.h>
#include <slipstep/utilities/parameter_reader.h>
#include <slipstep/utilities/parameters.h>
#include <slipstep/utilities/pattern_words.h>
#include <slipstep/utilities/variants.h>
#include <slipstep/utilities/text.h>

#include <boost/algorithm/string/predicate.hpp>


namespace SlipStep
{
  using dealii::Utilities::trim;

  namespace
  {
    // What stands before the path in a message: "case.prm:12: ", "--set ".
    std::string introduction(const std::string &origin)
    {
      if (origin.empty())
        return "";
      return origin +
             (boost::algorithm::starts_with(origin, "--") ? " " : ": ");
    }



    std::string place(const std::string &origin)
    {
      return origin.empty() ? "" : origin + ": ";
    }



    std::string sections_of(const std::string &path)
    {
      return path.substr(0, path.size() - name_of_key(path).size());
    }



    std::vector<std::string> section_names(const std::string &path)
    {
      std::vector<std::string> names =
        dealii::Utilities::split_string_list(path, '/');
      names.pop_back();
      return names;
    }



    // The paths that end in @p path, capitals ignored.
    std::vector<std::string> endings(const std::string              &path,
                                     const std::vector<std::string> &candidates)
    {
      std::vector<std::string> found;
      for (const std::string &candidate : candidates)
        if (is_same_word(candidate, path))
          return {candidate};
        else if (candidate.size() > path.size() &&
                 is_same_word(candidate.substr(candidate.size() - path.size() -
                                               1),
                              "/" + path))
          found.push_back(candidate);
      return found;
    }



    // Looked for, in this order: the path in other capitals or with sections
    // left out, the name with an ending that is missing, the same name in
    // another section, a similar name in the section, a similar path.
    std::string nearest_path(const std::string              &path,
                             const std::vector<std::string> &candidates)
    {
      constexpr std::size_t most_shown = 4;

      std::vector<std::string> same = endings(path, candidates);
      // A whole path inside a section.
      for (std::size_t slash = path.find('/');
           same.empty() && slash != std::string::npos;
           slash = path.find('/', slash + 1))
        for (const std::string &candidate : candidates)
          if (candidate.find('/') != std::string::npos &&
              is_same_word(candidate, path.substr(slash + 1)))
            same = {candidate};
      constexpr std::size_t most_missing = 2;
      for (const std::string &candidate : candidates)
        if (same.empty() && candidate.size() > path.size() &&
            candidate.size() <= path.size() + most_missing &&
            path.find('/') != std::string::npos &&
            is_same_word(candidate.substr(0, path.size()), path))
          return candidate;
      if (same.empty())
        {
          same                   = endings(name_of_key(path), candidates);
          const std::string near = nearest_name(path, same);
          if (!near.empty())
            return near;
        }
      if (!same.empty() && same.size() <= most_shown)
        return list_text(same, "or");

      std::vector<std::string> siblings;
      std::string              section;
      for (const std::string &candidate : candidates)
        if (is_same_word(sections_of(candidate), sections_of(path)))
          {
            section = sections_of(candidate);
            siblings.push_back(name_of_key(candidate));
          }
      const std::string sibling = nearest_name(name_of_key(path), siblings);
      return sibling.empty() ? nearest_name(path, candidates) :
                               section + sibling;
    }
  } // namespace



  void Parameters::declare(const std::string                   &path,
                           const std::string                   &default_value,
                           const dealii::Patterns::PatternBase &pattern,
                           const std::string                   &documentation)
  {
    AssertThrow(index_of_path.count(path) == 0,
                dealii::ExcMessage("Parameter declared twice: " + path));
    AssertThrow(pattern.match(default_value),
                dealii::ExcMessage("The default of " + path +
                                   " is not allowed: " +
                                   why_not_allowed(pattern, default_value)));
    Assert(path.find_first_of("#=\n") == std::string::npos,
           dealii::ExcMessage("Not a name for a parameter: " + path));
    stop_sharing();
    index_of_path[path] = entries.size();
    entries.push_back(
      {path,
       trim(default_value),
       std::shared_ptr<const dealii::Patterns::PatternBase>(pattern.clone()),
       documentation,
       "",
       0});
    in_section(path, [&](const std::string &key) {
      values->declare_entry(key, trim(default_value), pattern, documentation);
    });
  }



  // A value of this case alone is put beside what it shares.
  void Parameters::set_value(const std::string &path, const std::string &value)
  {
    if (values.use_count() > 1)
      {
        own_values[path] = value;
        return;
      }
    in_section(path, [&](const std::string &key) { values->set(key, value); });
    own_values.erase(path);
  }



  void Parameters::stop_sharing()
  {
    if (values.use_count() == 1 && own_values.empty())
      return;
    std::vector<std::string> texts;
    for (const Entry &entry : entries)
      texts.push_back(text(entry.path));
    values = std::make_shared<dealii::ParameterHandler>();
    own_values.clear();
    for (std::size_t i = 0; i < entries.size(); ++i)
      in_section(entries[i].path, [&](const std::string &key) {
        values->declare_entry(key,
                              entries[i].default_value,
                              *entries[i].pattern,
                              entries[i].documentation);
        values->set(key, texts[i]);
      });
  }



  const dealii::ParameterHandler &Parameters::handler()
  {
    stop_sharing();
    return *values;
  }



  void
  Parameters::in_section(const std::string                              &path,
                         const std::function<void(const std::string &)> &action)
  {
    const std::vector<std::string> sections = section_names(path);
    for (const std::string &section : sections)
      values->enter_subsection(section);
    action(name_of_key(path));
    for (std::size_t i = 0; i < sections.size(); ++i)
      values->leave_subsection();
  }



  void Parameters::read(const std::filesystem::path &file)
  {
    const CaseText text = read_case_text(file, *this);
    for (const Assignment &assignment : text.assignments)
      {
        Entry &entry = entries[index_of_path.at(assignment.path)];
        set_value(entry.path, as_meant(*entry.pattern, assignment.value));
        entry.origin = assignment.origin;
        entry.layer  = n_layers + assignment.layer;
      }
    n_layers += text.n_layers;
    variant_list = text.variants;
    file_read    = file;
  }



  void Parameters::check_path(const std::string &path,
                              const std::string &origin) const
  {
    if (index_of_path.count(path) != 0)
      return;
    if (!paths(path + "/").empty())
      throw InputError(place(origin) + path + " is a section, not a key");
    const std::string nearest = nearest_path(path, paths());
    throw InputError(place(origin) + "unknown key " + excerpt(path) +
                     (nearest.empty() ?
                        "; \"slipstep parameters\" lists the known ones" :
                        "; did you mean " + nearest + "?"));
  }



  std::vector<std::string> Parameters::sections() const
  {
    std::vector<std::string> found = {"Variants", "Sweep"};
    for (const Entry &entry : entries)
      for (std::size_t slash = entry.path.find('/'); slash != std::string::npos;
           slash             = entry.path.find('/', slash + 1))
        {
                      const std::string section = entry.path.substr(0, slash);
                      if (!holds(found, section))
            found.push_back(section);
        }
    return found;
  }



  void Parameters::check_section(const std::string &path,
                                 const std::string &origin) const
  {
    if (!paths(path + "/").empty())
      return;
    const std::string nearest = nearest_path(path, sections());
    if (index_of_path.count(path) != 0)
      throw InputError(place(origin) + path +
                       " is a key, not a section; write \"set\"");
    throw InputError(place(origin) + "unknown section " + excerpt(path) +
                     (nearest.empty() ?
                        "; \"slipstep parameters\" lists the known ones" :
                        "; did you mean " + nearest + "?"));
  }



  void Parameters::check(const std::string &path,
                         const std::string &value,
                         const std::string &origin) const
  {
    check_path(path, origin);
    const auto       &pattern = *entry(path).pattern;
    const std::string why =
      value.find_first_of("#\n") == std::string::npos ?
        why_not_allowed(pattern, as_meant(pattern, value)) :
        "a value cannot contain # or a line break";
    if (!why.empty())
      throw InputError(introduction(origin) + path + " =" +
                       (value.empty() ? "" : " ") + excerpt(value) + ": " +
                       why);
  }



  void Parameters::set(const std::string &path,
                       const std::string &value,
                       const std::string &origin)
  {
    const std::string trimmed = trim(value);
    check(path, trimmed, origin);
    Entry &entry = entries[index_of_path.at(path)];
    set_value(path, as_meant(*entry.pattern, trimmed));
    entry.origin = origin;
    entry.layer  = ++n_layers;

    variant_list = without_key(variant_list, path);
  }



  const Parameters::Entry &Parameters::entry(const std::string &path) const
  {
    const auto found = index_of_path.find(path);
    AssertThrow(found != index_of_path.end(),
                dealii::ExcMessage("Undeclared parameter: " + path));
    return entries[found->second];
  }



  std::string Parameters::text(const std::string &path) const
  {
    entry(path);
    const auto own = own_values.find(path);
    return own != own_values.end() ?
             own->second :
             values->get(section_names(path), name_of_key(path));
  }



  double Parameters::number(const std::string &path) const
  {
    const Entry &found = entry(path);
    if (const auto quantity =
          dynamic_cast<const Quantity *>(found.pattern.get()))
      return quantity->value(text(path));
    return dealii::Utilities::string_to_double(text(path));
  }



  int Parameters::integer(const std::string &path) const
  {
    return dealii::Utilities::string_to_int(text(path));
  }



  bool Parameters::boolean(const std::string &path) const
  {
    Assert(dynamic_cast<const dealii::Patterns::Bool *>(
             entry(path).pattern.get()),
           dealii::ExcMessage("Not declared as true or false: " + path));
    return dealii::Patterns::Tools::Convert<bool>::to_value(text(path));
  }



  std::vector<std::string> Parameters::list(const std::string &path) const
  {
    return dealii::Utilities::split_string_list(text(path), ',');
  }



  std::vector<std::string> Parameters::paths(const std::string &prefix) const
  {
    std::vector<std::string> found;
    for (const Entry &entry : entries)
      if (boost::algorithm::starts_with(entry.path, prefix))
        found.push_back(entry.path);
    return found;
  }



  std::vector<std::string> Parameters::find(const std::string &name,
                                            const std::string &origin) const
  {
    std::vector<std::string> known = paths();
    for (const std::string &section : sections())
      if (!paths(section + "/").empty())
        known.push_back(section);
    const std::vector<std::string> found = endings(name, known);
    if (found.size() != 1)
      {
        std::string near = nearest_path(name, known);
        if (near.empty())
          {
            std::vector<std::string> names;
            for (const std::string &path : known)
              names.push_back(name_of_key(path));
            near = nearest_name(name, names);
          }
        throw InputError(place(origin) +
                         (found.empty() ? "there is no key or section " :
                                          "more than one is called ") +
                         excerpt(name) +
                         (near.empty() ? "" : "; did you mean " + near + "?"));
      }
    return index_of_path.count(found.front()) ? found :
                                                paths(found.front() + "/");
  }



  std::string Parameters::origin(const std::string &path) const
  {
    const Entry &found = entry(path);
    if (found.layer > 0)
      return introduction(found.origin) + path;
    return (file_read.empty() ? "" : file_read.string() + ": ") + path;
  }



  void Parameters::reject(const std::string &path, const std::string &why) const
  {
    const Entry      &found = entry(path);
    const std::string value = text(path);
    const std::string hint  = decimal_comma_hint(value);
    // Of lists nobody knows; a marked column comes last.
    const bool is_comma_told =
      !hint.empty() && why.find_first_of("\n") == std::string::npos &&
      why.find("decimals begin with a point") == std::string::npos &&
      dynamic_cast<const dealii::Patterns::Anything *>(found.pattern.get());
    throw InputError(origin(path) + " =" + (value.empty() ? "" : " ") +
                     excerpt(value) +
                     (found.layer > 0 ? "" : " (the default)") + ": " + why +
                     (is_comma_told ? "; " + hint : ""));
  }



  std::filesystem::path Parameters::resolve(const std::string &file_name) const
  {
    return (file_read.parent_path() / with_home(file_name)).lexically_normal();
  }



  void Parameters::sweep(const std::string              &path,
                         const std::vector<std::string> &values,
                         const std::string              &origin)
  {
    check_path(path, origin);
    variant_list = without_key(variant_list, path, origin);
    const std::vector<Variant> more =
      variants_of_values(*this, path, values, origin, variant_list.empty());
    variant_list =
      variant_list.empty() ? more : product(variant_list, more, origin);
  }



  bool Parameters::keep_variant(const std::string &name)
  {
    for (const Variant &variant : variant_list)
      if (variant.label == name || variant.folder == name)
        {
          variant_list = {Variant(variant)};
          return true;
        }
    return false;
  }



  Parameters Parameters::with_variant(const Variant &variant) const
  {
    Parameters result = *this;
    result.variant_list.clear();
    for (const Variant::Override &setting : variant.overrides)
      result.set(setting.path, setting.value, setting.origin);
    return result;
  }



  void Parameters::rewrite(
    const std::string                                     &path,
    const std::function<std::string(const std::string &)> &rewritten)
  {
    set_value(path, rewritten(text(path)));
    for (Variant &variant : variant_list)
      for (Variant::Override &setting : variant.overrides)
        if (setting.path == path)
          setting.value = rewritten(setting.value);
  }



  void Parameters::print(std::ostream                   &out,
                         const Format                    format,
                         const std::set<std::string>    &omitted_sections,
                         const std::set<std::string>    &disabled_sections,
                         const std::vector<std::string> &only) const
  {
    std::vector<PrintedParameter> shown;
    for (const Entry &entry : entries)
      if (none_of(omitted_sections,
                  [&](const std::string &section) {
                    return boost::algorithm::starts_with(entry.path,
                                                         section + "/");
                  }) &&
          (only.empty() || holds(only, entry.path)))
        shown.push_back({entry, text(entry.path)});
    print_parameters(out, format, shown, variant_list, disabled_sections);
  }



  void Parameters::print_changes(std::ostream     &out,
                                 const Parameters &other) const
  {
    std::vector<PrintedParameter> shown;
    for (const Entry &entry : entries)
      if (text(entry.path) != other.text(entry.path))
        shown.push_back({entry, text(entry.path)});
    if (variant_list.empty() && !other.variant_list.empty())
      out << "subsection Variants\nend\n";
    print_settings(out, shown);
  }



  bool Parameters::has_values_of(const Parameters &other) const
  {
    return all_of(entries, [&](const Entry &entry) {
      return text(entry.path) == other.text(entry.path);
    });
  }
} // namespace SlipStep
