#include <slipstep/friction/effect.h>

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



  const std::map<std::string, EffectInfo> &effect_registry()
  {
    return mutable_registry();
  }



  RegisterEffect::RegisterEffect(const EffectInfo &info)
  {
    const bool is_new = mutable_registry().emplace(info.name, info).second;
    Assert(is_new,
           dealii::ExcMessage("Two effects are named '" + info.name + "'."));
    (void)is_new;
  }
} // namespace SlipStep
