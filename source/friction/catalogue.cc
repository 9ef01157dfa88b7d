#include <slipstep/friction/law.h>
#include <slipstep/utilities/pattern_words.h>

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
          case ExclusiveSlot::none:
            break;
        }
      return "combines with all others";
    }



    void print_parameter(std::ostream            &out,
                         const Parameters::Entry &entry,
                         const std::string       &section,
                         const bool               as_markdown)
    {
      const std::string key     = entry.path.substr(section.size());
      const std::string allowed = allowed_in_words(*entry.pattern);
      if (as_markdown)
        out << "| " << key << " | " << entry.default_value << " | " << allowed
            << " | " << entry.documentation << " |\n";
      else
        out << "    set " << key << " = " << entry.default_value << "   # "
            << allowed << '\n';
    }
  } // namespace



  void print_effects(std::ostream &out, const bool as_markdown)
  {
    Parameters parameters;
    FrictionLaw::declare_parameters(parameters);

    for (const auto &item : effect_registry())
      {
        const EffectInfo &info    = item.second;
        const std::string section = "Friction/" + info.name + "/";
        if (as_markdown)
          out << "## " << info.name << "\n\n    " << info.formula
              << "\n\n* source: " << info.source
              << "\n* neutral when: " << info.neutral << "\n* "
              << slot_words(info.slot)
              << "\n\n| key | default | allowed | meaning |\n"
                 "|---|---|---|---|\n";
        else
          out << info.name << "\n    " << info.formula
              << "\n    source:  " << info.source
              << "\n    neutral: " << info.neutral << "\n    "
              << slot_words(info.slot) << '\n';
        for (const std::string &path : parameters.paths(section))
          print_parameter(out, parameters.entry(path), section, as_markdown);
        out << '\n';
      }
    if (!as_markdown)
      out << "Switch effects on with 'set Effects = ...' in subsection "
             "Friction.\n";
  }
} // namespace SlipStep
