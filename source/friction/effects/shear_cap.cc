#include <slipstep/friction/effect.h>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// No surface transmits more than the softer body can bear in shear:
    /// \f$f_n\mu\f$ becomes \f$\tau_c \tanh(f_n\mu/\tau_c)\f$, which is
    /// \f[ G = \frac{\tanh x}{x}, \qquad x = \frac{f_n\mu}{\tau_c}. \f]
    /// That friction levels off when asperities merge is from Wanheim, Bay and
    /// Petersen (1974), Wear 28, 251; the hyperbolic tangent is chosen. Other
    /// factors and the ratio r multiply what is capped.
    class ShearCap : public StrengthEffect
    {
    public:
      ShearCap(const Parameters &parameters, const CoefficientBasis &)
        : tau_c(parameters.number("Friction/shear_cap/Shear limit"))
      {}

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        const double x     = step.normal_traction * step.coefficient / tau_c;
        double       value = 1. - x * x / 3., slope = -2. * x / 3.;
        if (x > 1e-3)
          {
            const double t = std::tanh(x);
            value          = t / x;
            slope          = (1. - t * t - value) / x;
          }
        Strength factor;
        factor.value         = value;
        factor.d_normal      = slope * step.coefficient / tau_c;
        factor.d_coefficient = slope * step.normal_traction / tau_c;
        return factor;
      }

      static void declare(Parameters &parameters)
      {
        parameters.declare("Friction/shear_cap/Shear limit",
                           "100",
                           Quantity(Dimension::stress, 0., 1e30, true),
                           "Shear traction tau_c that f_n mu tends to under "
                           "high pressure, about the yield stress in shear of "
                           "the softer body. More than 0, in MPa.");
      }

    private:
      const double tau_c;
    };

    const RegisterEffect shear_cap_registration(
      {"shear_cap",
       ExclusiveSlot::none,
       "f_n mu -> tau_c tanh(f_n mu / tau_c)",
       "Wanheim, Bay and Petersen (1974), Wear 28, 251-258; form chosen",
       "Shear limit -> infinity",
       &ShearCap::declare,
       [](const Parameters &parameters, const CoefficientBasis &basis) {
         return std::make_unique<ShearCap>(parameters, basis);
       },
       {{"Shear limit", "1e12"}},
       {{"Shear limit", "0.7"}}});
  } // namespace
} // namespace SlipStep
