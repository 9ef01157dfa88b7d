// SPDX-License-Identifier: LGPL-2.1-or-later

// The template of an effect; source/friction/effects/README.md says what to do
// with it. It is compiled here, so every_effect_test.cc tries it like any
// other.

#include <slipstep/friction/effect.h>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// What happens, in a sentence, and what info() does not say: closed forms,
    /// limits, what about it is chosen.
    // Derive from Effect instead if the yield level stays as it is and mu
    // evolves, or r_s, or the flow rule is another one.
    class Template : public StrengthEffect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name    = "template";
        info.words   = "what it does, for who knows no formulas";
        info.formula = "G = 1 + w tanh(D / L), D: slip path";
        info.latex   = R"(G = 1 + w \tanh\frac{D}{L})";
        info.source  = "Author (year), Journal volume, page";
        // Key, symbol, default, range with unit; meaning. The defaults run.
        info.parameters = {
          {{"Change", "w", "0.1", Quantity(Dimension::number, -0.9, 10.)},
           "share by which the strength changes"},
          {{"Length", "L", "1", positive(Dimension::length)},
           "slip path after which most has changed"}};
        // Values for the tests: with the first it does nothing, with the second
        // much, within 0.05 mm of slip, 1 s and 2 to 6 MPa.
        info.neutral_settings = {{"Change", "0"}};
        info.typical_settings = {{"Change", "0.5"}, {"Length", "0.01 mm"}};
        info.search = {"how it shows in measured tests, beside others", search};
        return info;
      }

      // What parameters of single keys allow, info() says; what they must not
      // be together is checked here:
      //   section.reject("Length", "must be ...");
      Template(const EffectSection &section, const CoefficientBasis &)
        : w(section.number("Change"))
        , L(section.number("Length"))
      {}

      // A factor of f_n mu, with a derivative for each member of the step that
      // it depends on. (MPa that are added instead: additive_strength().)
      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        const double path = step.start.slip_path + step.path;
        const double t    = std::tanh(path / L);
        Strength     factor;
        factor.value  = 1. + w * t;
        factor.d_path = w * (1. - t * t) / L;
        return factor;
      }

    private:
      // How `slipstep diagnose` looks for it: bounds of the parameters to be
      // fitted, their natural end being told from a failure, and values to
      // start from, a ladder of lengths over what the tests cover. At strength
      // 1 they should change friction by about one per cent. (With one
      // parameter set_proportional() writes both; an effect that is not looked
      // for sets info.search.why_not instead.)
      static TrialFormula search(const Circumstances &now)
      {
        const double path = now.range.longest_path;
        TrialFormula formula;
        formula.parameters = {{"Change", -0.8, 3., false},
                              {"Length", 0.01 * path, 10. * path, true}};
        for (const double L : ladder(0.03 * path, 3. * path, 5))
          formula.add_shape("Change", -0.7, 2.9, {{"Length", L}});
        return formula;
      }

      const double w, L;
    };

    const RegisterEffect template_registration = register_effect<Template>();
  } // namespace
} // namespace SlipStep
