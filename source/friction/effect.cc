// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>
#include <slipstep/utilities/text.h>

namespace SlipStep
{
  namespace
  {
    // Function-local, so that it exists before the first effect registers,
    // whatever the order in which translation units are initialised.
    std::map<std::string, EffectInfo> &mutable_registry()
    {
      static std::map<std::string, EffectInfo> registry;
      return registry;
    }
  } // namespace



  EffectKey::EffectKey(const std::string                   &key,
                       const std::string                   &symbol,
                       const std::string                   &default_value,
                       const dealii::Patterns::PatternBase &pattern)
    : key(key)
    , symbol(symbol)
    , default_value(default_value)
    , pattern(pattern.clone())
  {}



  Quantity positive(const Dimension dimension, const double maximum)
  {
    return Quantity(dimension, 0., maximum, true);
  }



  dealii::Patterns::Selection one_of(const std::string &words)
  {
    return dealii::Patterns::Selection(words);
  }



  std::string EffectInfo::section() const
  {
    return "Friction/" + name + "/";
  }



  EffectSection EffectInfo::section_of(const Parameters &parameters) const
  {
    return {parameters, section()};
  }



  void EffectInfo::declare(Parameters &all) const
  {
    for (const EffectParameter &parameter : parameters)
      all.declare(section() + parameter.key,
                  parameter.default_value,
                  *parameter.pattern,
                  parameter.symbol.empty() ?
                    capitalised(parameter.meaning) + "." :
                    parameter.symbol + ": " + parameter.meaning + ".");
  }



  const std::map<std::string, EffectInfo> &effect_registry()
  {
    return mutable_registry();
  }



  const EffectInfo *
  find_effect(const std::vector<std::string>                &names,
              const std::function<bool(const EffectInfo &)> &is_it)
  {
    for (const std::string &name : names)
      if (const EffectInfo &info = effect_registry().at(name); is_it(info))
        return &info;
    return nullptr;
  }



  const EffectInfo *effect_of_order(const std::vector<std::string> &names)
  {
    return find_effect(names, [](const EffectInfo &info) {
      return !info.test_number.empty();
    });
  }



  RegisterEffect::RegisterEffect(EffectInfo info)
  {
    if (info.neutral.empty() && !info.neutral_settings.empty())
      info.neutral = info.neutral_settings[0].first + " = " +
                     info.neutral_settings[0].second;
    info.search.complete_paths(info.section());
    const bool is_new = mutable_registry().emplace(info.name, info).second;
    Assert(is_new,
           dealii::ExcMessage("Two effects are named '" + info.name + "'."));
    (void)is_new;
  }
} // namespace SlipStep
