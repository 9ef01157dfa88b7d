#include <slipstep/friction/effect.h>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// Friction grows less than in proportion to the pressure (gamma > 0),
    /// or more (gamma < 0):
    /// \f[ G = \left(\frac{f_n}{p_0}\right)^{-\gamma}. \f]
    /// Elastic asperities on each other give gamma = 1/3 when alone and less
    /// when they carry smaller ones: Archard (1957), Proc. R. Soc. Lond. A 243,
    /// 190.
    class Pressure : public StrengthEffect
    {
    public:
      Pressure(const Parameters &parameters, const CoefficientBasis &)
        : gamma(parameters.number("Friction/pressure/Exponent"))
        , p_0(parameters.number("Friction/pressure/Reference pressure"))
      {}

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        Strength factor;
        factor.value    = std::pow(step.normal_traction / p_0, -gamma);
        factor.d_normal = -gamma * factor.value / step.normal_traction;
        return factor;
      }

      static void declare(Parameters &parameters)
      {
        parameters.declare("Friction/pressure/Exponent",
                           "0.1",
                           Quantity(Dimension::number, -1., 0.9),
                           "Exponent gamma of the pressure, negative if the "
                           "coefficient grows with it. From -1 to 0.9, no "
                           "unit.");
        parameters.declare("Friction/pressure/Reference pressure",
                           "5.8",
                           Quantity(Dimension::stress, 0., 1e30, true),
                           "Pressure p_0 at which the coefficients were "
                           "measured. More than 0, in MPa.");
      }

    private:
      const double gamma;
      const double p_0;
    };

    const RegisterEffect pressure_registration(
      {"pressure",
       ExclusiveSlot::none,
       "G = (f_n / p_0)^-gamma",
       "Archard (1957), Proc. R. Soc. Lond. A 243, 190-205",
       "Exponent = 0",
       &Pressure::declare,
       [](const Parameters &parameters, const CoefficientBasis &basis) {
         return std::make_unique<Pressure>(parameters, basis);
       },
       {{"Exponent", "0"}},
       {{"Exponent", "0.3"}, {"Reference pressure", "3"}}});
  } // namespace
} // namespace SlipStep
