#include <slipstep/friction/effect.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// The coefficient recovers towards the static one with time:
    /// \f[ \frac{d\mu}{dt} = \xi \left(e^{b(\mu_s-\mu)} - 1\right). \f]
    /// At rest the closed form is
    /// \f$\mu(t) = \mu_s + \frac1b \ln\left[1 - \left(1 -
    /// e^{-b(\mu_s-\mu_0)}\right) e^{-b\xi t}\right]\f$.
    /// Eq. 2 of the source paper, second term.
    class Healing : public Effect
    {
    public:
      Healing(const Parameters &parameters, const CoefficientBasis &basis)
        : xi(parameters.number("Friction/healing/Rate"))
        , b(parameters.number("Friction/healing/Steepness"))
        , mu_s(basis.static_coefficient)
      {}

      virtual Rate
      coefficient_rate_per_time(const double coefficient) const override
      {
        const double growth =
          std::expm1(std::min(b * (mu_s - coefficient), largest_exponent));
        return {xi * growth, -xi * b * (growth + 1.)};
      }

      static void declare(Parameters &parameters)
      {
        parameters.declare("Friction/healing/Rate",
                           "0",
                           Quantity(Dimension::per_time, 0.),
                           "Rate xi of recovery with time (eq. 2 of the source "
                           "paper). 0 or more, in 1/s.");
        parameters.declare("Friction/healing/Steepness",
                           "1",
                           Quantity(Dimension::number, 0., 1e4, true),
                           "Steepness b of recovery in terms of mu (eq. 2 of "
                           "the source paper): a large value makes the "
                           "coefficient grow with the logarithm of the time at "
                           "rest. More than 0, no unit.");
      }

    private:
      // Beyond, a product with no slip or no time would not be 0.
      static constexpr double largest_exponent = 500.;

      const double xi;
      const double b;
      const double mu_s;
    };

    const RegisterEffect healing_registration(
      {"healing",
       ExclusiveSlot::none,
       "d mu/dt = xi (exp(b (mu_s - mu)) - 1)",
       "source paper, eq. 2, second term",
       "Rate = 0 1/s",
       &Healing::declare,
       [](const Parameters &parameters, const CoefficientBasis &basis) {
         return std::make_unique<Healing>(parameters, basis);
       },
       {{"Rate", "0"}},
       {{"Rate", "1e-3"}, {"Steepness", "100"}}});
  } // namespace
} // namespace SlipStep
