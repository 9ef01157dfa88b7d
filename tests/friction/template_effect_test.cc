// SPDX-License-Identifier: LGPL-2.1-or-later

// The template of an effect; source/friction/effects/README.md says what to do
// with it. It is compiled here, so every_effect_test.cc tries it like any
// other.

#include <slipstep/friction/effect.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// What happens, in a sentence, and the formula:
    /// \f[ G = 1 + w \tanh\frac{D}{L}, \f]
    /// what its letters are, where it is from (paper, equation) and what about
    /// it is chosen.
    // Derive from Effect instead if the yield level stays as it is and mu
    // evolves, or r_s, or the flow rule is another one.
    class Template : public StrengthEffect
    {
    public:
      // What parameters of single keys allow, declare() says; what they must
      // not be together is checked here:
      //   parameters.reject("Friction/template/Length", "must be ...");
      Template(const Parameters &parameters, const CoefficientBasis &)
        : w(parameters.number("Friction/template/Change"))
        , L(parameters.number("Friction/template/Length"))
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

      static EffectInfo info()
      {
        EffectInfo info;
        info.name    = "template";
        info.words   = "what it does, for who knows no formulas";
        info.formula = "G = 1 + w tanh(D / L), D: slip path";
        info.latex   = "G = 1 + w \\tanh\\frac{D}{L}";
        info.source  = "Author (year), Journal volume, page";
        info.neutral = "Change = 0";
        // Key, symbol, default, range with unit, meaning; the defaults run.
        info.parameters = {{"Change",
                            "w",
                            "0.1",
                            Quantity(Dimension::number, -0.9, 10.),
                            "share by which the strength changes"},
                           {"Length",
                            "L",
                            "1",
                            Quantity(Dimension::length, 0., 1e30, true),
                            "slip path after which most has changed"}};
        // Values for the tests: with the first it does nothing, with the second
        // much, within 0.05 mm of slip, 1 s and 2 to 6 MPa.
        info.neutral_settings = {{"Change", "0"}};
        info.typical_settings = {{"Change", "0.5"}, {"Length", "0.01 mm"}};
        info.search = {"how it shows in measured tests, beside others", search};
        return info;
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
        const std::string change = "Friction/template/Change";
        const std::string length = "Friction/template/Length";
        const double      path   = now.range.longest_path;
        TrialFormula      formula;
        formula.parameters = {{change, -0.8, 3., false},
                              {length, 0.01 * path, 10. * path, true}};
        for (const double L : ladder(0.03 * path, 3. * path, 5))
          formula.shapes.push_back([=](const double strength) {
            return Values{{change,
                           std::clamp(just_noticed * strength, -0.7, 2.9)},
                          {length, L}};
          });
        return formula;
      }

      const double w;
      const double L;
    };

    const RegisterEffect template_registration = register_effect<Template>();
  } // namespace
} // namespace SlipStep
