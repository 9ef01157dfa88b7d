#include <slipstep/friction/effect.h>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// Slow surfaces touch, fast ones are borne by the lubricant:
    /// \f[ G = 1 + s\,e^{-(\lambda/V_s)^q}. \f]
    /// Stribeck (1902), Z. VDI 46, 1341; the exponential is from Bo and
    /// Pavelescu (1982), Wear 82, 277. Where friction falls with speed by more
    /// than the overstress and the viscous effect let it rise, sliding is
    /// unstable: then a step may end sticking or sliding, and the answer
    /// depends on the steps taken.
    class Stribeck : public StrengthEffect
    {
    public:
      Stribeck(const Parameters &parameters, const CoefficientBasis &)
        : s(parameters.number("Friction/stribeck/Rise"))
        , V_s(parameters.number("Friction/stribeck/Speed"))
        , q(parameters.number("Friction/stribeck/Exponent"))
      {}

      virtual bool depends_on_rate() const override
      {
        return true;
      }

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        Strength     factor;
        const double x = step.slip_rate() / V_s, power = std::pow(x, q);
        factor.value = 1.;
        // Beyond, the exponential is nothing.
        if (power < 700.)
          {
            const double rise = s * std::exp(-power);
            factor.value += rise;
            factor.d_rate = -rise * q * std::pow(x, q - 1.) / V_s;
          }
        return factor;
      }

      static void declare(Parameters &parameters)
      {
        parameters.declare("Friction/stribeck/Rise",
                           "0.05",
                           Quantity(Dimension::number, 0., 100.),
                           "Share s by which the strength at rest exceeds that "
                           "at high speed. From 0 to 100, no unit.");
        parameters.declare("Friction/stribeck/Speed",
                           "0.5 mm/s",
                           Quantity(Dimension::speed, 0., 1e30, true, true),
                           "Speed V_s at which the rise has fallen to 37 %. "
                           "More than 0, with its unit.");
        parameters.declare("Friction/stribeck/Exponent",
                           "1",
                           Quantity(Dimension::number, 1., 10.),
                           "Exponent q of the speed. From 1 (less would fall "
                           "infinitely fast from rest) to 10, no unit.");
      }

    private:
      const double s;
      const double V_s;
      const double q;
    };

    const RegisterEffect stribeck_registration(
      {"stribeck",
       ExclusiveSlot::none,
       "G = 1 + s exp(-(lambda / V_s)^q)",
       "Stribeck (1902), Z. VDI 46, 1341; Bo and Pavelescu (1982), Wear 82, 277",
       "Rise = 0",
       &Stribeck::declare,
       [](const Parameters &parameters, const CoefficientBasis &basis) {
         return std::make_unique<Stribeck>(parameters, basis);
       },
       {{"Rise", "0"}},
       {{"Rise", "0.1"}, {"Speed", "2 mm/s"}, {"Exponent", "1.5"}}});
  } // namespace
} // namespace SlipStep
