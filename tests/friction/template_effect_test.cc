// The template of an effect; source/friction/effects/README.md says what to do
// with it. It is compiled here, so every_effect_test.cc tries it like any
// other.

#include <slipstep/friction/effect.h>

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
        const double path = step.start.slip_path + step.slip;
        const double t    = std::tanh(path / L);
        Strength     factor;
        factor.value  = 1. + w * t;
        factor.d_slip = w * (1. - t * t) / L;
        return factor;
      }

      static void declare(Parameters &parameters)
      {
        parameters.declare("Friction/template/Change",
                           "0.1",
                           Quantity(Dimension::number, -0.9, 10.),
                           "Meaning w, and its formula. From -0.9 to 10, no "
                           "unit.");
        parameters.declare("Friction/template/Length",
                           "1",
                           Quantity(Dimension::length, 0., 1e30, true),
                           "Meaning L. More than 0, in mm.");
      }

    private:
      const double w;
      const double L;
    };

    const RegisterEffect template_registration(
      {"template",
       ExclusiveSlot::none,
       "G = 1 + w tanh(D / L), D: slip path",
       "Author (year), Journal volume, page",
       "Change = 0",
       &Template::declare,
       [](const Parameters &parameters, const CoefficientBasis &basis) {
         return std::make_unique<Template>(parameters, basis);
       },
       // Values for the tests: with the first it does nothing, with the second
       // much, within 0.05 mm of slip, 1 s and 2 to 6 MPa.
       {{"Change", "0"}},
       {{"Change", "0.5"}, {"Length", "0.01 mm"}}});
  } // namespace
} // namespace SlipStep
