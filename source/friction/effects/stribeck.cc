// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// Slow surfaces touch, fast ones are borne by the lubricant; the
    /// exponential is Bo and Pavelescu's. Where friction falls with speed by
    /// more than the overstress and the viscous effect let it rise, sliding is
    /// unstable: then a step may end sticking or sliding, and the answer
    /// depends on the steps taken.
    class Stribeck : public StrengthEffect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name       = "stribeck";
        info.words      = "higher friction at slow speeds, as with a lubricant";
        info.formula    = "G = 1 + s exp(-(lambda / V_s)^q)";
        info.latex      = R"(G = 1 + s\,e^{-(\lambda/V_s)^q})";
        info.source     = "Stribeck (1902), Z. VDI 46, 1341; Bo and Pavelescu "
                          "(1982), Wear 82, 277";
        info.parameters = {
          {{"Rise", "s", "0.05", Quantity(Dimension::number, 0., 100.)},
           "share by which the strength at rest exceeds that at high speed"},
          {{"Speed",
            "V_s",
            "0.5 mm/s",
            Quantity(Dimension::speed, 0., 1e30, true, true)},
           "speed at which the rise has fallen to 37 %"},
          {{"Exponent", "q", "1", Quantity(Dimension::number, 1., 10.)},
           "exponent of the speed; less than 1 would fall infinitely fast from "
           "rest"}};
        info.neutral_settings = {{"Rise", "0"}};
        info.typical_settings = {{"Rise", "0.1"},
                                 {"Speed", "2 mm/s"},
                                 {"Exponent", "1.5"}};
        info.search         = {"slow speeds high, no memory of holds", search};
        info.search.along   = "log10 speed";
        info.search.held_by = "overstress";
        return info;
      }

      Stribeck(const EffectSection &section, const CoefficientBasis &)
        : s(section.number("Rise"))
        , V_s(section.number("Speed"))
        , q(section.number("Exponent"))
      {}

      virtual bool depends_on_rate() const override
      {
        return true;
      }

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        Strength     factor;
        const double x = step.slip_rate() / V_s, power = std::pow(x, q);
        factor.value = 1.;
        // Beyond, the exponential is nothing.
        if (power < 700.)
          {
            const double rise = s * std::exp(-power);
            factor.value += rise;
            factor.d_rate = -rise * q * std::pow(x, q - 1.) / V_s;
          }
        return factor;
      }

    private:
      static TrialFormula search(const Circumstances &now)
      {
        const double slowest = now.range.slowest, fastest = now.range.fastest;
        TrialFormula formula;
        formula.is_one_sided = true;
        formula.parameters   = {{"Rise", 0., 3., false},
                                {"Speed", 0.1 * slowest, 10. * fastest, true},
                                {"Exponent", 1., 3., false, true, false}};
        for (const double V : ladder(0.7 * slowest, 1.5 * fastest, 6))
          formula.add_shape("Rise",
                            1e-4,
                            2.9,
                            {{"Speed", V}, {"Exponent", 1.2}});
        return formula;
      }

      const double s, V_s, q;
    };

    const RegisterEffect stribeck_registration = register_effect<Stribeck>();
  } // namespace
} // namespace SlipStep
