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



  EffectParameter::EffectParameter(const std::string &key,
                                   const std::string &symbol,
                                   const std::string &default_value,
                                   const dealii::Patterns::PatternBase &pattern,
                                   const std::string                   &meaning)
    : key(key)
    , symbol(symbol)
    , default_value(default_value)
    , pattern(pattern.clone())
    , meaning(meaning)
  {}



  std::string EffectInfo::section() const
  {
    return "Friction/" + name + "/";
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



  RegisterEffect::RegisterEffect(const EffectInfo &info)
  {
    const bool is_new = mutable_registry().emplace(info.name, info).second;
    Assert(is_new,
           dealii::ExcMessage("Two effects are named '" + info.name + "'."));
    (void)is_new;
  }
} // namespace SlipStep
