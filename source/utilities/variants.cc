// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/nearest_name.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/variants.h>

#include <boost/algorithm/string/find.hpp>
#include <boost/algorithm/string/finder.hpp>
#include <boost/algorithm/string/iter_find.hpp>
#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cctype>
#include <set>

namespace SlipStep
{
  namespace
  {
    // File systems take 255 bytes.
    constexpr std::size_t longest_folder = 200;

    // Each has a process and a folder of its own.
    constexpr std::size_t most_variants = 10000;

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
      // Hidden folders and "..".
      if (folder.empty() || folder.front() == '.' || folder.front() == '-')
        folder.insert(0, "_");
      // What the results of a sweep have beside its members.
      static const auto taken = dealii::Utilities::split_string_list(
        "report report.html used_parameters.prm point compare refine calibrate "
        "diagnose",
        ' ');
      if (holds(taken, folder))
        folder += "_";
      return folder;
    }
  } // namespace



  void add_variant(std::vector<Variant> &variants,
                   const std::string    &label,
                   const std::string    &origin)
  {
    const std::string folder = folder_name(label);
    if (folder.size() > longest_folder)
      throw InputError(origin + ": the variant \"" + excerpt(label) +
                       "\" has " + std::to_string(folder.size()) +
                       " letters, more than a folder's name can have; "
                       "allowed are " +
                       std::to_string(longest_folder));
    for (const Variant &other : variants)
      {
        if (other.label == label)
          throw InputError(origin + ": the variant \"" + label +
                           "\" is given twice");
        if (other.folder == folder)
          throw InputError(origin + ": the variants \"" + other.label +
                           "\" and \"" + label + "\" would share the folder " +
                           folder);
      }
    variants.push_back({label, folder, {}});
  }



  std::string name_of_key(const std::string &path)
  {
    return path.substr(path.rfind('/') + 1);
  }



  namespace
  {
    // "softening/Rate 0.1, subloading/Rate 500": two keys of one name.
    std::string
    label_with_sections(const std::vector<Variant::Override> &overrides)
    {
      std::vector<std::string> pieces;
      for (const Variant::Override &setting : overrides)
        {
          const std::size_t key     = setting.path.rfind('/');
          const std::size_t section = key == std::string::npos || key == 0 ?
                                        std::string::npos :
                                        setting.path.rfind('/', key - 1);
          pieces.push_back(setting.path.substr(section + 1) + " " +
                           setting.value);
        }
      return boost::algorithm::join(pieces, ", ");
    }
  } // namespace



  std::vector<Variant>
  variants_of_values(const Parameters               &known,
                     const std::string              &path,
                     const std::vector<std::string> &values,
                     const std::string              &origin,
                     const bool                      is_alone)
  {
    const std::string    name = name_of_key(path);
    std::vector<Variant> variants;
    for (const std::string &value : values)
      {
        known.check(path, value, origin);
        // A bare number says nothing in a legend.
        const bool is_bare =
          value.find_first_not_of("0123456789.+-eE") == std::string::npos;
        add_variant(variants,
                    is_bare || !is_alone ? name + " " + value : value,
                    origin);
        variants.back().overrides.push_back({path, value, origin});
      }
    return variants;
  }



  std::vector<Variant> product(const std::vector<Variant> &slow,
                               const std::vector<Variant> &fast,
                               const std::string          &origin)
  {
    std::set<std::string> swept;
    for (const Variant &variant : slow)
      for (const Variant::Override &setting : variant.overrides)
        swept.insert(setting.path);
    for (const Variant &variant : fast)
      for (const Variant::Override &setting : variant.overrides)
        if (swept.count(setting.path) > 0)
          throw InputError(origin + ": " + setting.path + " is swept twice");
    if (slow.size() * fast.size() > most_variants)
      throw InputError(
        origin + ": " + std::to_string(slow.size()) + " times " +
        std::to_string(fast.size()) + " values are more runs than the " +
        std::to_string(most_variants) + " that a sweep may have");
    std::set<std::string> names;
    for (const std::string &path : swept)
      names.insert(name_of_key(path));
    const bool is_ambiguous =
      !fast.empty() && any_of(fast[0].overrides, [&](const auto &setting) {
        return names.count(name_of_key(setting.path)) > 0;
      });
    std::vector<Variant> variants;
    for (const Variant &one : slow)
      for (const Variant &other : fast)
        {
          std::vector<Variant::Override> overrides = one.overrides;
          overrides.insert(overrides.end(),
                           other.overrides.begin(),
                           other.overrides.end());
          add_variant(variants,
                      is_ambiguous ? label_with_sections(overrides) :
                                     one.label + ", " + other.label,
                      origin);
          variants.back().overrides = overrides;
        }
    return variants;
  }



  namespace
  {
    // The label of combined values has a piece for each of them.
    void take_out(Variant &variant, const std::size_t number)
    {
      std::vector<std::string> pieces;
      boost::algorithm::iter_split(pieces,
                                   variant.label,
                                   boost::algorithm::first_finder(", "));
      if (pieces.size() == variant.overrides.size() && pieces.size() > 1)
        {
          pieces.erase(pieces.begin() + number);
          variant.label  = boost::algorithm::join(pieces, ", ");
          variant.folder = folder_name(variant.label);
        }
      variant.overrides.erase(variant.overrides.begin() + number);
    }
  } // namespace



  std::vector<Variant> without_key(const std::vector<Variant> &variants,
                                   const std::string          &path,
                                   const std::string          &but_those_from)
  {
    std::vector<Variant> result;
    const auto says_the_same = [](const Variant &a, const Variant &b) {
      return std::equal(a.overrides.begin(),
                        a.overrides.end(),
                        b.overrides.begin(),
                        b.overrides.end(),
                        [](const auto &one, const auto &other) {
                          return one.path == other.path &&
                                 one.value == other.value;
                        });
    };
    for (Variant variant : variants)
      {
        bool has_changed = false;
        for (std::size_t i = variant.overrides.size(); i-- > 0;)
          if (variant.overrides[i].path == path &&
              variant.overrides[i].origin != but_those_from)
            {
              take_out(variant, i);
              has_changed = true;
            }
        const bool is_told =
          has_changed && any_of(result, [&](const Variant &other) {
            return says_the_same(variant, other);
          });
        if (!is_told)
          result.push_back(variant);
      }
    const bool says_nothing =
      result.size() == 1 && result.front().overrides.empty() &&
      any_of(variants,
             [](const Variant &variant) { return !variant.overrides.empty(); });
    return says_nothing ? std::vector<Variant>() : result;
  }



  const Variant &find_variant(const std::vector<Variant>  &variants,
                              const std::string           &name,
                              const std::filesystem::path &file)
  {
    constexpr std::size_t most_shown = 12;

    std::vector<std::string> labels;
    for (const Variant &variant : variants)
      {
        if (variant.label == name || variant.folder == name)
          return variant;
        labels.push_back(variant.label);
      }
    std::string known = labels.empty() ? "it has none" : "it has ";
    for (std::size_t i = 0; i < std::min(labels.size(), most_shown); ++i)
      known += (i > 0 ? ", \"" : "\"") + excerpt(labels[i]) + "\"";
    if (labels.size() > most_shown)
      known += " and " + std::to_string(labels.size() - most_shown) + " more";
    const std::string nearest = did_you_mean(name, labels);
    throw InputError("--variant " + excerpt(name) + ": " + file.string() +
                     " has no such variant" + nearest +
                     (nearest.empty() ? "; " + known : " (" + known + ")"));
  }
} // namespace SlipStep
