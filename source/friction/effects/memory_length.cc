// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// The slip rate to which the contact has adapted by slip.
    const ContactMemory adapted_rate =
      register_memory({"adapted_rate_mm_per_s"});

    /// Friction grows with the logarithm of speed, but follows it only over a
    /// slip length. After a step of speed from V_1 to V_2 there is no jump, and
    /// \f$V_m = V_2 + (V_1 - V_2) e^{-\lambda/L}\f$; at rest V_m stays. Or V_m
    /// takes the place of the slip rate in the flow rule (overstress, perzyna),
    /// whose jump then spreads over the length: r after a step of speed is that
    /// of steady sliding at V_m. Ruina has the memory for the evolution of a
    /// state; that the direct effect has it, and both forms, are chosen.
    class MemoryLength : public StrengthEffect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name    = "memory_length";
        info.words   = "friction that follows the speed over a slip length";
        info.formula = "G = 1 + a ln(1 + V_m/V_0), d V_m/d lambda = (slip rate "
                       "- V_m)/L; or V_m in the flow rule";
        info.latex  = R"(G = 1 + a \ln\left(1 + \frac{V_m}{V_0}\right), \quad )"
                      R"(\frac{dV_m}{d\lambda} = \frac{\dot\lambda - V_m}{L})";
        info.source = "chosen; memory by slip as in Ruina (1983), J. Geophys. "
                      "Res. 88, 10359-10370";
        info.parameters = {
          {{"Form", "", "factor", one_of("factor|flow")},
           "'factor' is G; 'flow' has no G, but the flow rule (overstress or "
           "perzyna) feels V_m instead of the slip rate"},
          {{"Growth", "a", "0", Quantity(Dimension::number, 0.)},
           "growth of the strength per e-fold of the speed"},
          {{"Speed", "V_0", "1", positive(Dimension::speed)},
           "speed from which the strength grows with its logarithm"},
          {{"Slip length", "L", "0.1", positive(Dimension::length)},
           "slip over which friction follows the speed"}};
        info.neutral_settings = {{"Growth", "0"}, {"Form", "factor"}};
        info.typical_settings = {{"Growth", "0.3"},
                                 {"Speed", "0.1 mm/s"},
                                 {"Slip length", "0.02 mm"}};
        info.search = {"jumps of speed spread over a slip length", search};
        return info;
      }

      MemoryLength(const EffectSection &section, const CoefficientBasis &)
        : StrengthEffect({adapted_rate})
        , a(section.number("Growth"))
        , V_0(section.number("Speed"))
        , L(section.number("Slip length"))
        , is_in_flow_rule(section.text("Form") == "flow")
      {
        if (is_in_flow_rule && a > 0.)
          section.reject("Growth",
                         "with Form = flow it is the flow rule that says "
                         "how friction grows: must be 0");
      }

      virtual bool remembers_rate() const override
      {
        return is_in_flow_rule;
      }

      virtual Rate flow_rate(const ContactState &start,
                             const double        slip,
                             const double        time_step) const override
      {
        return rate_after(start, slip, time_step);
      }

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        if (is_in_flow_rule)
          return StrengthEffect::strength_factor(step);
        const Rate rate = rate_after(step.start, step.slip, step.time_step);
        Strength   factor;
        factor.value  = 1. + a * std::log1p(rate.value / V_0);
        factor.d_slip = a * rate.derivative / (V_0 + rate.value);
        return factor;
      }

      virtual void remember(const SlipStepData &step,
                            ContactState       &end) const override
      {
        end[adapted_rate] =
          step.normal_traction > 0. ?
            rate_after(step.start, step.slip, step.time_step).value :
            0.;
      }

    private:
      // By its slip length: Form = factor, without one, is the overstress by
      // another formula.
      static TrialFormula search(const Circumstances &now)
      {
        const double path = now.range.longest_path;
        if (!now.has("overstress") && !now.has("perzyna"))
          return TrialFormula::none(
            "there is no effect of speed that could spread");
        if (!(now.range.fastest > 1.5 * now.range.slowest))
          return TrialFormula::none("the speed hardly varies");
        TrialFormula formula;
        formula.is_one_sided = true;
        formula.texts        = {{"Form", "flow"}};
        formula.parameters   = {{"Slip length", 1e-5 * path, 0.3 * path, true}};
        formula.shapes       = {[=](const double strength) {
          return Values{
            {"Slip length", std::clamp(1e-3 * strength, 1.1e-5, 0.29) * path}};
        }};
        return formula;
      }

      // V_m at the end, exact for a constant slip rate, and its derivative with
      // respect to slip, the time step being kept.
      Rate rate_after(const ContactState &start,
                      const double        slip,
                      const double        time_step) const
      {
        const double decay  = std::exp(-slip / L);
        const double share  = -std::expm1(-slip / L);
        const double before = start[adapted_rate];
        const double now    = slip / time_step;
        return {before * decay + now * share,
                share / time_step + (now - before) * decay / L};
      }

      const double a, V_0, L;
      const bool   is_in_flow_rule;
    };

    const RegisterEffect memory_length_registration =
      register_effect<MemoryLength>();
  } // namespace
} // namespace SlipStep
