// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// Friction grows less than in proportion to the pressure (gamma > 0), or
    /// more (gamma < 0). Elastic asperities on each other give gamma = 1/3 when
    /// alone and less when they carry smaller ones.
    class Pressure : public StrengthEffect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name       = "pressure";
        info.words      = "a friction coefficient that changes with pressure";
        info.formula    = "G = (f_n / p_0)^-gamma";
        info.latex      = R"(G = \left(\frac{f_n}{p_0}\right)^{-\gamma})";
        info.source     = "Archard (1957), Proc. R. Soc. Lond. A 243, 190-205";
        info.parameters = {
          {{"Exponent", "gamma", "0.1", Quantity(Dimension::number, -1., 0.9)},
           "exponent of the pressure, negative if the coefficient grows with "
           "it"},
          {{"Reference pressure", "p_0", "5.8", positive(Dimension::stress)},
           "pressure at which the coefficients were measured"}};
        info.neutral_settings = {{"Exponent", "0"}};
        info.typical_settings = {{"Exponent", "0.3"},
                                 {"Reference pressure", "3"}};
        info.search           = {"straight in ln p only", search};
        info.search.along     = "pressure";
        return info;
      }

      Pressure(const EffectSection &section, const CoefficientBasis &)
        : gamma(section.number("Exponent"))
        , p_0(section.number("Reference pressure"))
      {}

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        Strength factor;
        factor.value    = std::pow(step.normal_traction / p_0, -gamma);
        factor.d_normal = -gamma * factor.value / step.normal_traction;
        return factor;
      }

    private:
      static TrialFormula search(const Circumstances &now)
      {
        TrialFormula formula;
        formula.settings = {{"Reference pressure",
                             std::sqrt(now.range.lowest * now.range.highest)}};
        formula.set_proportional("Exponent", 1., -0.8, 0.8);
        return formula;
      }

      const double gamma, p_0;
    };

    const RegisterEffect pressure_registration = register_effect<Pressure>();
  } // namespace
} // namespace SlipStep
