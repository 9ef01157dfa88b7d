#include <slipstep/friction/effect.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// The coefficient falls from static to kinetic with the slip path:
    /// \f[ \frac{d\mu}{d\lambda} = -\kappa
    ///     \left(e^{a(\mu-\mu_k)} - 1\right). \f]
    /// In sliding alone the closed form is
    /// \f$\mu(s) = \mu_k - \frac1a \ln\left[1 - \left(1 -
    /// e^{-a(\mu_0-\mu_k)}\right) e^{-a\kappa s}\right]\f$: the length of the
    /// transition is 1/(kappa a). Eq. 2 of the source paper, first term.
    class Softening : public Effect
    {
    public:
      Softening(const Parameters &parameters, const CoefficientBasis &basis)
        : kappa(parameters.number("Friction/softening/Rate"))
        , a(parameters.number("Friction/softening/Steepness"))
        , mu_k(parameters.number("Friction/softening/Kinetic coefficient") *
               basis.scale)
      {
        if (mu_k > basis.static_coefficient * (1. + 1e-12))
          parameters.reject("Friction/softening/Kinetic coefficient",
                            "must not exceed the static coefficient (" +
                              parameters.text("Friction/Static coefficient") +
                              "); take effect run_in for friction that rises "
                              "with slip");
      }

      virtual Rate
      coefficient_rate_per_slip(const double coefficient) const override
      {
        const double growth =
          std::expm1(std::min(a * (coefficient - mu_k), largest_exponent));
        return {-kappa * growth, -kappa * a * (growth + 1.)};
      }

      static void declare(Parameters &parameters)
      {
        parameters.declare("Friction/softening/Rate",
                           "0.045",
                           Quantity(Dimension::per_length, 0.),
                           "Rate kappa of softening with slip (eq. 2 of the "
                           "source paper). The static-to-kinetic transition "
                           "takes a slip of about 1/(kappa a). 0 or more, in "
                           "1/mm.");
        parameters.declare("Friction/softening/Steepness",
                           "1",
                           Quantity(Dimension::number, 0., 1e4, true),
                           "Steepness a of softening in terms of mu (eq. 2 of "
                           "the source paper). More than 0, no unit.");
        parameters.declare(
          "Friction/softening/Kinetic coefficient",
          "0.098",
          Quantity(Dimension::number, 0., 100., true),
          "Kinetic coefficient of friction mu_k, reached after "
          "long sliding, at the 'Speed of the coefficients'. "
          "More than 0, at most the static coefficient, no "
          "unit.");
      }

    private:
      // Beyond, a product with no slip or no time would not be 0.
      static constexpr double largest_exponent = 500.;

      const double kappa;
      const double a;
      const double mu_k;
    };

    const RegisterEffect softening_registration(
      {"softening",
       ExclusiveSlot::none,
       "d mu/d lambda = -kappa (exp(a (mu - mu_k)) - 1)",
       "source paper, eq. 2, first term",
       "Rate = 0 1/mm",
       &Softening::declare,
       [](const Parameters &parameters, const CoefficientBasis &basis) {
         return std::make_unique<Softening>(parameters, basis);
       },
       {{"Rate", "0"}},
       {{"Rate", "5"}, {"Steepness", "3"}}});
  } // namespace
} // namespace SlipStep
