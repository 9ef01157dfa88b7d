// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/synthetic_tests/hidden_effects.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/nearest_name.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <map>

namespace SlipStep
{
  namespace Planting
  {
    std::size_t place_among(const std::vector<std::string> &names,
                            const std::string              &what,
                            const std::string              &wanted)
    {
      const auto found = std::find(names.begin(), names.end(), wanted);
      if (found == names.end())
        throw InputError(what + " \"" + wanted + "\": allowed is one of: " +
                         boost::algorithm::join(names, ", ") +
                         did_you_mean(wanted, names));
      return found - names.begin();
    }



    std::string to_string(const Formula formula)
    {
      static const char *const names[] = {
        "catalogue", "alternative", "outside", "third", "joint"};
      return names[static_cast<unsigned int>(formula)];
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
      const std::string hint = did_you_mean(name, names);
      throw InputError(
        "there is no effect \"" + name + "\" to be hidden (" +
        to_string(formula) + ")" +
        (hint.empty() ? "; known are: " + boost::algorithm::join(names, ", ") :
                        hint));
    }
  } // namespace Planting
} // namespace SlipStep
