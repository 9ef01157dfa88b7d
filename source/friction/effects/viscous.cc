// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/largest_coefficient.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// A film adds a strength that grows with the slip rate. It is Newtonian
    /// with \f$n_v = 1\f$: of a film of thickness h and viscosity \f$\eta\f$,
    /// \f$c_v = \eta/h\f$ (Reynolds). Else it is so below V_v only, and follows
    /// a power of the slip rate far above, as films that thin (or thicken) with
    /// shear do: Carreau's form with another power inside, which is chosen. A
    /// power alone would rise infinitely fast from rest. As part of the yield
    /// level it is multiplied by r.
    class Viscous : public StrengthEffect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name    = "viscous";
        info.words   = "a drag that grows with speed, as of a fluid film";
        info.formula = "tau_y = f_n mu G_1 G_2 ... + min(c_v lambda (1 + "
                       "lambda/V_v)^(n_v - 1), m f_n)";
        info.latex =
          R"(\tau_y = f_n \mu\,G_1 G_2 \cdots + \min\left(c_v \lambda \left(1 + )"
          R"(\frac{\lambda}{V_v}\right)^{n_v - 1}, m f_n\right))";
        info.source     = "Reynolds (1886), Phil. Trans. R. Soc. 177, 157-234; "
                          "Carreau (1972), Trans. Soc. Rheol. 16, 99-127";
        info.parameters = {
          {{"Drag", "c_v", "0.01", Quantity(Dimension::drag, 0.)},
           "strength per slip rate at low slip rates"},
          {{"Exponent", "n_v", "1", Quantity(Dimension::number, 0., 5.)},
           "power of the slip rate far above Speed: 1 for a Newtonian film, "
           "less for one that thins with shear"},
          {{"Speed", "V_v", "1", positive(Dimension::speed)},
           "slip rate from which the power is felt; for Exponents other than "
           "1"},
          largest_coefficient()};
        info.neutral_settings = {{"Drag", "0 MPa s/mm"}};
        info.typical_settings = {{"Drag", "0.2"},
                                 {"Exponent", "0.6"},
                                 {"Speed", "0.1 mm/s"}};
        info.search = {"linear in V, its share shrinks with pressure", search};
        info.search.other_forms = {search_power};
        info.search.along       = "log10 speed";
        return info;
      }

      Viscous(const EffectSection &section, const CoefficientBasis &)
        : c_v(section.number("Drag"))
        , n_v(section.number("Exponent"))
        , V_v(section.number("Speed"))
        , m(section.number("Largest coefficient"))
      {}

      virtual bool depends_on_rate() const override
      {
        return true;
      }

      virtual Strength
      additive_strength(const SlipStepData &step) const override
      {
        const double x     = step.slip_rate() / V_v;
        const double power = std::pow(1. + x, n_v - 1.);
        Strength     strength;
        strength.value  = c_v * step.slip_rate() * power;
        strength.d_rate = c_v * power * (1. + (n_v - 1.) * x / (1. + x));
        return bounded(strength, m, step);
      }

    private:
      // Far above its speed it is a power of the slip rate.
      static TrialFormula search_power(const Circumstances &now)
      {
        const double speed   = 0.3 * now.range.slowest;
        const double fastest = now.range.fastest;
        if (!(fastest > 1.5 * now.range.slowest))
          return TrialFormula::none("the speed hardly varies");
        const double strength = now.friction() * now.range.highest;
        const auto   drag_of  = [=](const double share, const double n) {
          return share * strength / fastest *
                 std::pow(1. + fastest / speed, 1. - n);
        };
        TrialFormula formula;
        formula.is_one_sided = true;
        formula.settings     = {{"Speed", speed}};
        formula.parameters   = {
            {"Drag", drag_of(1e-5, 2.), drag_of(3., 0.2), true},
            {"Exponent", 0.2, 2., false}};
        for (const double n : {0.5, 1.5})
          formula.shapes.push_back([=](const double strength) {
            return Values{
              {"Drag",
               drag_of(std::clamp(just_noticed * strength, 1e-4, 2.), n)},
              {"Exponent", n}};
          });
        return formula;
      }

      static TrialFormula search(const Circumstances &now)
      {
        const double unit =
          now.friction() * now.range.highest / now.range.fastest;
        TrialFormula formula;
        formula.is_one_sided = true;
        formula.set_proportional("Drag", unit, 0., 3. * unit);
        return formula;
      }

      const double c_v, n_v, V_v, m;
    };

    const RegisterEffect viscous_registration = register_effect<Viscous>();
  } // namespace
} // namespace SlipStep
