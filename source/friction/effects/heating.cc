// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// Temperature of the contact above that of its surroundings.
    const ContactMemory contact_heat =
      register_memory({"temperature_rise_degC"});

    /// Friction heats the contact, and a warm contact is weaker. T is the
    /// temperature above that of the surroundings; over a step it is integrated
    /// exactly for a constant heat flow. That the heat of sliding governs
    /// friction is Blok's; one temperature per point and the form of G are
    /// chosen. In steady sliding \f$T = h t_c |f_t| \lambda\f$.
    class Heating : public StrengthEffect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name    = "heating";
        info.words   = "friction that falls as fast sliding heats the contact";
        info.formula = "G = 1 / (1 + beta T), dT/dt = h |f_t| lambda - T / t_c";
        info.latex   = R"(G = \frac{1}{1 + \beta T}, \quad )"
                       R"(\dot T = h |f_t| \lambda - \frac{T}{t_c})";
        info.source =
          "Blok (1937), Proc. Inst. Mech. Eng. 2, 222-235; form chosen";
        info.parameters = {
          {{"Weakening",
            "beta",
            "1e-3",
            Quantity(Dimension::per_temperature, 0.)},
           "weakening with temperature"},
          {{"Heating", "h", "10", Quantity(Dimension::heating, 0.)},
           "temperature that the contact gains per work of friction and area"},
          {{"Cooling time", "t_c", "10", positive(Dimension::time)},
           "time in which the temperature falls to 37 %"}};
        info.neutral_settings = {{"Weakening", "0 1/degC"}};
        info.typical_settings = {{"Weakening", "0.02"},
                                 {"Heating", "50"},
                                 {"Cooling time", "2 s"}};
        info.search = {"falls inside a fast run, recovers in a pause, repeats",
                       search};
        info.search.along = "temperature";
        return info;
      }

      Heating(const EffectSection &section, const CoefficientBasis &)
        : StrengthEffect({contact_heat})
        , beta(section.number("Weakening"))
        , h(section.number("Heating"))
        , t_c(section.number("Cooling time"))
      {}

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        Strength factor;
        factor.value = 1. / (1. + beta * temperature_rise(step));
        factor.d_work =
          -beta * factor.value * factor.value * rise_per_work(step);
        return factor;
      }

      virtual void remember(const SlipStepData &step,
                            ContactState       &end) const override
      {
        end[contact_heat] = temperature_rise(step);
      }

    private:
      // Only the product of weakening and heating is felt.
      static TrialFormula search(const Circumstances &now)
      {
        constexpr double weakening = 1e-3;
        const double     power =
          now.friction() * now.range.highest * now.range.fastest;
        const double shortest =
          std::min(now.range.longest_test,
                   now.range.longest_path / now.range.fastest);
        TrialFormula formula;
        formula.is_one_sided = true;
        formula.settings     = {{"Weakening", weakening}};
        formula.parameters   = {{"Heating",
                                 1e-6 /
                                   (weakening * power * now.range.longest_test),
                                 1e3 / (weakening * power * shortest),
                                 true},
                                {"Cooling time",
                                 0.003 * shortest,
                                 3. * now.range.longest_test,
                                 true,
                                 false,
                                 true}};
        for (const double t : ladder(0.1 * shortest, now.range.longest_test, 6))
          formula.shapes.push_back([=](const double strength) {
            return Values{{"Heating",
                           std::clamp(just_noticed * strength, 1e-4, 10.) /
                             (weakening * power * std::min(t, shortest))},
                          {"Cooling time", t}};
          });
        return formula;
      }

      // Of heat that flows during the step, some is gone at its end.
      double rise_per_work(const SlipStepData &step) const
      {
        return -h * t_c / step.time_step * std::expm1(-step.time_step / t_c);
      }

      double temperature_rise(const SlipStepData &step) const
      {
        return step.start[contact_heat] * std::exp(-step.time_step / t_c) +
               rise_per_work(step) * step.work;
      }

      const double beta, h, t_c;
    };

    const RegisterEffect heating_registration = register_effect<Heating>();
  } // namespace
} // namespace SlipStep
