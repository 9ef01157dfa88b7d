// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/synthetic_tests/hidden_effects.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/nearest_name.h>

#include <map>

namespace SlipStep
{
  namespace Planting
  {
    std::string to_string(const Formula formula)
    {
      switch (formula)
        {
          case Formula::catalogue:
            return "catalogue";
          case Formula::alternative:
            return "alternative";
          case Formula::outside:
            return "outside";
          case Formula::third:
            return "third";
          case Formula::joint:
            return "joint";
        }
      return "";
    }



    const std::vector<HiddenEffectKind> &hidden_effects(const Formula formula)
    {
      static const std::map<Formula, std::vector<HiddenEffectKind>> effects = {
        {Formula::catalogue, catalogue_effects},
        {Formula::alternative, other_formulas},
        {Formula::outside, outside_effects},
        {Formula::third, third_formulas},
        {Formula::joint, joint_effects}};
      return effects.at(formula);
    }



    const HiddenEffectKind &hidden_effect(const std::string &name,
                                          const Formula      formula)
    {
      std::vector<std::string> names;
      for (const HiddenEffectKind &kind : hidden_effects(formula))
        {
          if (kind.name == name)
            return kind;
          names.push_back(kind.name);
        }
      std::string known;
      for (const std::string &one : names)
        known += (known.empty() ? "" : ", ") + one;
      const std::string hint = did_you_mean(name, names);
      throw InputError("there is no effect \"" + name + "\" to be hidden (" +
                       to_string(formula) + ")" +
                       (hint.empty() ? "; known are: " + known : hint));
    }
  } // namespace Planting
} // namespace SlipStep
