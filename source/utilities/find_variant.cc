// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/find_variant.h>
#include <slipstep/utilities/nearest_name.h>
#include <slipstep/utilities/pattern_words.h>

#include <algorithm>

namespace SlipStep
{
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
