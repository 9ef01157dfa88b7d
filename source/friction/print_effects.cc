// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/law.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/nearest_name.h>
#include <slipstep/utilities/pattern_words.h>
#include <slipstep/utilities/text.h>

#include <algorithm>

namespace SlipStep
{
  namespace
  {
    const char *slot_words(const ExclusiveSlot slot)
    {
      switch (slot)
        {
          case ExclusiveSlot::normal_ratio:
            return "only one effect can define the normal ratio";
          case ExclusiveSlot::overstress:
            return "only one effect can define the flow rule";
          case ExclusiveSlot::anisotropy:
            return "only one effect can define the cone";
          case ExclusiveSlot::elastic_core:
            return "only one effect can define the elastic core";
          case ExclusiveSlot::none:
            break;
        }
      return "combines with all others";
    }



    void print_parameter(std::ostream          &out,
                         const EffectParameter &parameter,
                         const bool             as_markdown)
    {
      const std::string allowed = allowed_in_words(*parameter.pattern);
      if (as_markdown)
        out << "| " << parameter.key << " | " << parameter.symbol << " | "
            << parameter.default_value << " | " << allowed << " | "
            << parameter.meaning << " |\n";
      else
        out << "    set " << parameter.key << " = " << parameter.default_value
            << "   # " << parameter.symbol
            << (parameter.symbol.empty() ? "" : ": ") << allowed << '\n';
    }



    std::vector<std::string> effect_names()
    {
      std::vector<std::string> names;
      for (const auto &item : effect_registry())
        names.push_back(item.first);
      return names;
    }
  } // namespace



  void print_effects(std::ostream                   &out,
                     const bool                      as_markdown,
                     const std::vector<std::string> &names)
  {
    for (const std::string &name : names)
      if (effect_registry().count(name) == 0)
        throw InputError(
          "there is no effect " + name +
          (name == "compliance" ?
             ": with this name a diagnosis means Loading/Machine stiffness, "
             "see slipstep parameters Loading" :
             did_you_mean(name, effect_names())));
    for (const auto &item : effect_registry())
      {
        const EffectInfo &info = item.second;
        if (!names.empty() &&
            std::find(names.begin(), names.end(), info.name) == names.end())
          continue;
        if (as_markdown)
          out << "## " << info.name << "\n\n"
              << capitalised(info.words) << ".\n\n\\f[ " << info.latex
              << " \\f]\n\n* in text: `" << info.formula
              << "`\n* source: " << info.source
              << "\n* neutral when: " << info.neutral << "\n* "
              << slot_words(info.slot)
              << "\n\n| key | symbol | default | allowed | meaning |\n"
                 "|---|---|---|---|---|\n";
        else
          out << info.name << ": " << info.words << "\n    " << info.formula
              << "\n    source:  " << info.source
              << "\n    neutral: " << info.neutral << "\n    "
              << slot_words(info.slot) << '\n';
        for (const EffectParameter &parameter : info.parameters)
          print_parameter(out, parameter, as_markdown);
        out << '\n';
      }
    if (!as_markdown)
      out << "Switch effects on with 'set Effects = ...' in subsection "
             "Friction.\n";
  }
} // namespace SlipStep
