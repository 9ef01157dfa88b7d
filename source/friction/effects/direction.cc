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

      static void declare(Parameters &parameters)
      {
        parameters.declare("Friction/direction/Change",
                           "0.1",
                           Quantity(Dimension::number, -0.99, 100.),
                           "Share d by which the strength differs in reverse "
                           "strokes, negative if it is less. From -0.99 to "
                           "100, no unit.");
        parameters.declare(
          "Friction/direction/Forward angle",
          "0",
          Quantity(Dimension::angle, -360., 360.),
          "Angle of the forward direction n in the contact "
          "plane, from its first axis to its second. From -360 "
          "to 360, in deg.");
      }

    private:
      const double         d;
      dealii::Tensor<1, 2> n;
    };

    const RegisterEffect direction_registration(
      {"direction",
       ExclusiveSlot::none,
       "G = 1 + d (1 - cos(phi)) / 2, phi: from the forward angle to slip",
       "chosen",
       "Change = 0",
       &Direction::declare,
       [](const Parameters &parameters, const CoefficientBasis &basis) {
         return std::make_unique<Direction>(parameters, basis);
       },
       {{"Change", "0"}},
       {{"Change", "0.5"}, {"Forward angle", "20 deg"}}});
  } // namespace
} // namespace SlipStep
