// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>


namespace SlipStep
{
  namespace
  {
    /// Asperities that pass with the slip rate excite a damped oscillator, the
    /// tool or a layer of the surface; what it absorbs is friction: the power
    /// that a driven oscillator of quality Q takes at x times its own
    /// frequency, a bump over the logarithm of speed, 1/Q wide at half its
    /// height where that is narrow. That the rise of friction is in proportion
    /// to that power is chosen. Beyond the bump friction falls with speed:
    /// where by more than overstress and stiffness hold against, sliding is
    /// unstable there.
    class Resonance : public StrengthEffect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name    = "resonance";
        info.words   = "higher friction about one speed, that of a resonance";
        info.formula = "G = 1 + s / (1 + Q^2 (x - 1/x)^2), x = lambda / V_r";
        info.latex = R"(G = 1 + \frac{s}{1 + Q^2 \left(x - \frac1x\right)^2}, )"
                     R"(\quad x = \frac{\lambda}{V_r})";
        info.source     = "Landau and Lifshitz, Mechanics, section 26; use for "
                          "friction chosen";
        info.parameters = {
          {{"Rise", "s", "0.05", Quantity(Dimension::number, 0., 100.)},
           "share by which the strength is higher at the resonance"},
          {{"Speed", "V_r", "0.5 mm/s", positive(Dimension::speed)},
           "slip rate of the resonance"},
          {{"Quality", "Q", "1", Quantity(Dimension::number, 0.1, 1000.)},
           "quality of the oscillator: the larger, the narrower is the bump"}};
        info.neutral_settings = {{"Rise", "0"}};
        info.typical_settings = {{"Rise", "0.3"},
                                 {"Speed", "0.2 mm/s"},
                                 {"Quality", "1.5"}};
        info.search = {"one speed high, slower and faster ones not", search};
        info.search.along   = "log10 speed";
        info.search.held_by = "overstress";
        return info;
      }

      Resonance(const EffectSection &section, const CoefficientBasis &)
        : s(section.number("Rise"))
        , V_r(section.number("Speed"))
        , Q(section.number("Quality"))
      {}

      virtual bool depends_on_rate() const override
      {
        return true;
      }

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        // The same for x and 1/x, the smaller of which does not overflow.
        const double x      = step.slip_rate() / V_r;
        const double y      = x > 1. ? 1. / x : x;
        const double square = y * y, off = Q * (square - 1.);
        const double total = square + off * off;
        Strength     factor;
        factor.value  = 1. + s * square / total;
        factor.d_rate = s * 2. * y * Q * Q * (1. - square * square) /
                        (total * total) * (x > 1. ? -square : 1.) / V_r;
        return factor;
      }

    private:
      static TrialFormula search(const Circumstances &now)
      {
        const double slowest = now.range.slowest, fastest = now.range.fastest;
        // Within less it is any other function of speed.
        if (!(fastest > 10. * slowest))
          return TrialFormula::none(
            "speeds differ by less than a factor of ten");
        TrialFormula formula;
        formula.is_one_sided = true;
        // A resonance outside of what was tested is a slope of another name.
        formula.parameters = {{"Rise", 0., 3., false},
                              {"Speed", slowest, fastest, true},
                              {"Quality", 0.3, 10., true}};
        for (const double V : ladder(2. * slowest, 0.5 * fastest, 5))
          formula.add_shape("Rise",
                            1e-4,
                            2.9,
                            {{"Speed", V}, {"Quality", 0.7}});
        return formula;
      }

      const double s, V_r, Q;
    };

    const RegisterEffect resonance_registration = register_effect<Resonance>();
  } // namespace
} // namespace SlipStep
