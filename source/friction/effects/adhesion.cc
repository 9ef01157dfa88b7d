// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/largest_coefficient.h>

namespace SlipStep
{
  namespace
  {
    /// Bonds that need no pressure add to the strength of a closed contact; the
    /// linear law with a constant is Derjaguin's.
    class Adhesion : public StrengthEffect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name    = "adhesion";
        info.words   = "surfaces that stick even without pressure";
        info.formula = "tau_y = f_n mu G_1 G_2 ... + min(c, m f_n)";
        info.latex   = R"(\tau_y = f_n \mu\,G_1 G_2 \cdots + \min(c, m f_n))";
        info.source =
          "Bowden and Tabor (1950); Derjaguin (1934), Z. Phys. 88, 661-675";
        info.parameters = {
          {{"Strength", "c", "0.01", Quantity(Dimension::stress, 0.)},
           "shear strength of the adhesive bonds, lost when "
           "the contact opens"},
          largest_coefficient()};
        info.neutral_settings = {{"Strength", "0 MPa"}};
        info.typical_settings = {{"Strength", "0.3"},
                                 {"Largest coefficient", "0.05"}};
        info.search           = {"only low pressures rise, as 1/p", search};
        info.search.along     = "pressure";
        return info;
      }

      Adhesion(const EffectSection &section, const CoefficientBasis &)
        : c(section.number("Strength"))
        , m(section.number("Largest coefficient"))
      {}

      virtual Strength
      additive_strength(const SlipStepData &step) const override
      {
        Strength strength;
        strength.value = c;
        return bounded(strength, m, step);
      }

    private:
      static TrialFormula search(const Circumstances &now)
      {
        const double unit = now.friction() * now.range.lowest;
        TrialFormula formula;
        formula.is_one_sided = true;
        formula.set_proportional("Strength", unit, 0., 2. * unit);
        return formula;
      }

      const double c, m;
    };

    const RegisterEffect adhesion_registration = register_effect<Adhesion>();
  } // namespace
} // namespace SlipStep
