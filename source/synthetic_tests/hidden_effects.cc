// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/synthetic_tests/hidden_effects.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/nearest_name.h>

namespace SlipStep
{
  namespace Planting
  {
    std::string to_string(const Formula formula)
    {
      return formula == Formula::catalogue   ? "catalogue" :
             formula == Formula::alternative ? "alternative" :
                                               "outside";
    }



    const std::vector<HiddenEffectKind> &hidden_effects(const Formula formula)
    {
      static const std::vector<HiddenEffectKind> catalogue =
        catalogue_effects();
      static const std::vector<HiddenEffectKind> alternative =
        alternative_effects();
      static const std::vector<HiddenEffectKind> outside = outside_effects();
      return formula == Formula::catalogue   ? catalogue :
             formula == Formula::alternative ? alternative :
                                               outside;
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
