// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>

namespace SlipStep
{
  namespace
  {
    /// A Newtonian film adds a strength in proportion to the slip rate:
    /// \f[ \tau_y = f_n \mu\,G_1 G_2 \cdots + c_v \lambda. \f]
    /// Of a film of thickness h and viscosity \f$\eta\f$,
    /// \f$c_v = \eta/h\f$: Reynolds (1886), Phil. Trans. R. Soc. 177, 157. As
    /// part of the yield level it is multiplied by r.
    class Viscous : public StrengthEffect
    {
    public:
      Viscous(const Parameters &parameters, const CoefficientBasis &)
        : c_v(parameters.number("Friction/viscous/Drag"))
      {}

      virtual bool depends_on_rate() const override
      {
        return true;
      }

      virtual Strength
      additive_strength(const SlipStepData &step) const override
      {
        Strength strength;
        strength.value  = c_v * step.slip_rate();
        strength.d_rate = c_v;
        return strength;
      }

      static EffectInfo info()
      {
        EffectInfo info;
        info.name       = "viscous";
        info.words      = "a drag in proportion to speed, as of a fluid film";
        info.formula    = "tau_y = f_n mu G_1 G_2 ... + c_v lambda";
        info.latex      = "\\tau_y = f_n \\mu\\,G_1 G_2 \\cdots + c_v \\lambda";
        info.source     = "Reynolds (1886), Phil. Trans. R. Soc. 177, 157-234";
        info.neutral    = "Drag = 0 MPa s/mm";
        info.parameters = {{"Drag",
                            "c_v",
                            "0.01",
                            Quantity(Dimension::drag, 0.),
                            "strength per slip rate"}};
        info.neutral_settings = {{"Drag", "0"}};
        info.typical_settings = {{"Drag", "0.2"}};
        info.search = {"linear in V, its share shrinks with pressure", search};
        info.search.along = "log10 speed";
        return info;
      }

    private:
      static TrialFormula search(const Circumstances &now)
      {
        const double unit =
          now.friction() * now.range.highest / now.range.fastest;
        TrialFormula formula;
        formula.is_one_sided = true;
        formula.set_proportional("Friction/viscous/Drag", unit, 0., 3. * unit);
        return formula;
      }

      const double c_v;
    };

    const RegisterEffect viscous_registration = register_effect<Viscous>();
  } // namespace
} // namespace SlipStep
