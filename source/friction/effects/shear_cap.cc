// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// No surface transmits more than the softer body can bear in shear:
    /// \f$f_n\mu\f$ becomes \f$\tau_c \tanh(f_n\mu/\tau_c)\f$, which is
    /// \f[ G = \frac{\tanh x}{x}, \qquad x = \frac{f_n\mu}{\tau_c}. \f]
    /// That friction levels off when asperities merge is from Wanheim, Bay and
    /// Petersen (1974), Wear 28, 251; the hyperbolic tangent is chosen. Other
    /// factors and the ratio r multiply what is capped.
    class ShearCap : public StrengthEffect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name    = "shear_cap";
        info.words   = "a limit of the shear stress at high pressure";
        info.formula = "f_n mu -> tau_c tanh(f_n mu / tau_c)";
        info.latex   = R"(f_n \mu \to \tau_c \tanh\frac{f_n \mu}{\tau_c})";
        info.source =
          "Wanheim, Bay and Petersen (1974), Wear 28, 251-258; form chosen";
        info.neutral    = "Shear limit -> infinity";
        info.parameters = {
          {{"Shear limit", "tau_c", "100", positive(Dimension::stress)},
           "shear traction that f_n mu tends to under high pressure, about the "
           "yield stress in shear of the softer body"}};
        info.neutral_settings = {{"Shear limit", "1e12"}};
        info.typical_settings = {{"Shear limit", "0.7"}};
        info.search           = {"only high pressures bend", search};
        info.search.along     = "pressure";
        return info;
      }

      ShearCap(const EffectSection &section, const CoefficientBasis &)
        : tau_c(section.number("Shear limit"))
      {}

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        const double x     = step.normal_traction * step.coefficient / tau_c;
        double       value = 1. - x * x / 3., slope = -2. * x / 3.;
        if (x > 1e-3)
          {
            const double t = std::tanh(x);
            value          = t / x;
            slope          = (1. - t * t - value) / x;
          }
        Strength factor;
        factor.value         = value;
        factor.d_normal      = slope * step.coefficient / tau_c;
        factor.d_coefficient = slope * step.normal_traction / tau_c;
        return factor;
      }

    private:
      // tanh(x) / x is about 1 - x^2 / 3.
      static TrialFormula search(const Circumstances &now)
      {
        const double largest = now.friction() * now.range.highest;
        TrialFormula formula;
        formula.is_one_sided = true;
        formula.parameters   = {
            {"Shear limit", 0.2 * largest, 100. * largest, true}};
        formula.shapes.push_back([=](const double strength) {
          const double fall = just_noticed * std::max(strength, 1e-3);
          return Values{{"Shear limit",
                         std::clamp(largest / std::sqrt(3. * fall),
                                    0.25 * largest,
                                    90. * largest)}};
        });
        return formula;
      }

      const double tau_c;
    };

    const RegisterEffect shear_cap_registration = register_effect<ShearCap>();
  } // namespace
} // namespace SlipStep
