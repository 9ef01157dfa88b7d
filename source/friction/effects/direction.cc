// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// Friction against a preferred direction n of the surface differs from
    /// friction along it:
    /// \f[ G = 1 + d\,\frac{1 - \cos\varphi}{2}, \f]
    /// where \f$\varphi\f$ is the angle between slip and n: 1 forward, 1 + d in
    /// reverse strokes, halfway across. Chosen, for laid or combed surfaces.
    class Direction : public StrengthEffect
    {
    public:
      Direction(const Parameters &parameters, const CoefficientBasis &)
        : d(parameters.number("Friction/direction/Change"))
      {
        const double angle =
          parameters.number("Friction/direction/Forward angle");
        n[0] = std::cos(angle);
        n[1] = std::sin(angle);
      }

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        Strength factor;
        factor.value       = 1. + d * (1. - n * step.direction) / 2.;
        factor.d_direction = -d / 2. * n;
        return factor;
      }

      static EffectInfo info()
      {
        EffectInfo info;
        info.name  = "direction";
        info.words = "friction that differs between forward and back strokes";
        info.formula =
          "G = 1 + d (1 - cos(phi)) / 2, phi: from the forward angle to slip";
        info.latex      = "G = 1 + d\\,\\frac{1 - \\cos\\varphi}{2}";
        info.source     = "chosen";
        info.neutral    = "Change = 0";
        info.parameters = {
          {"Change",
           "d",
           "0.1",
           Quantity(Dimension::number, -0.99, 100.),
           "share by which the strength differs in reverse strokes, negative "
           "if it is less"},
          {"Forward angle",
           "",
           "0",
           Quantity(Dimension::angle, -360., 360.),
           "angle of the forward direction n in the contact plane, from its "
           "first axis to its second"}};
        info.neutral_settings = {{"Change", "0"}};
        info.typical_settings = {{"Change", "0.5"},
                                 {"Forward angle", "20 deg"}};
        info.search           = {"an offset on reverse strokes", search};
        return info;
      }

    private:
      static TrialFormula search(const Circumstances &)
      {
        TrialFormula formula;
        formula.set_proportional("Friction/direction/Change", 1., -0.8, 3.);
        return formula;
      }

      const double         d;
      dealii::Tensor<1, 2> n;
    };

    const RegisterEffect direction_registration = register_effect<Direction>();
  } // namespace
} // namespace SlipStep
