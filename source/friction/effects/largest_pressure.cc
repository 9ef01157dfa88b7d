// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>

#include <algorithm>

namespace SlipStep
{
  namespace
  {
    /// The largest normal traction that the contact has met.
    const ContactMemory largest_pressure =
      register_memory({"largest_pressure_MPa"});

    /// Asperities that were flattened stay so: below the largest pressure so
    /// far the true area of contact is larger than that pressure would make it.
    /// That areas do not go back is in chapter I of the source; that friction
    /// follows in proportion is chosen. G is 1 as long as the pressure grows; a
    /// < 0 is a surface that heavy loads smooth.
    class LargestPressure : public StrengthEffect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name    = "largest_pressure";
        info.words   = "a memory of the largest pressure that the contact met";
        info.formula = "G = 1 + a (1 - f_n / f_max), f_max: largest f_n so far";
        info.latex   = R"(G = 1 + a \left(1 - \frac{f_n}{f_{max}}\right))";
        info.source  = "area of contact as in Bowden and Tabor (1950), The "
                       "Friction and Lubrication of Solids; form chosen";
        info.parameters = {
          {{"Change", "a", "0.1", Quantity(Dimension::number, -0.99, 100.)},
           "share by which the strength per pressure is higher after the load "
           "is gone, negative if it is less"}};
        info.neutral_settings = {{"Change", "0"}};
        info.typical_settings = {{"Change", "0.5"}};
        info.search = {"differs after a higher pressure, never before", search};
        return info;
      }

      LargestPressure(const EffectSection &section, const CoefficientBasis &)
        : StrengthEffect({largest_pressure})
        , a(section.number("Change"))
      {}

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        const double before = step.start[largest_pressure];
        Strength     factor;
        factor.value = 1.;
        if (step.normal_traction < before)
          {
            factor.value    = 1. + a * (1. - step.normal_traction / before);
            factor.d_normal = -a / before;
          }
        return factor;
      }

      virtual void remember(const SlipStepData &step,
                            ContactState       &end) const override
      {
        end[largest_pressure] =
          std::max(step.start[largest_pressure], step.normal_traction);
      }

    private:
      static TrialFormula search(const Circumstances &now)
      {
        if (!(now.range.largest_pressure > 1.1 * now.range.lowest))
          return TrialFormula::none("the pressure hardly varies");
        TrialFormula formula;
        formula.set_proportional("Change", 1., -0.9, 3.);
        return formula;
      }

      const double a;
    };

    const RegisterEffect largest_pressure_registration =
      register_effect<LargestPressure>();
  } // namespace
} // namespace SlipStep
