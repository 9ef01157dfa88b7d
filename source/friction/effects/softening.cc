// SPDX-License-Identifier: LGPL-2.1-or-later
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

      static EffectInfo info()
      {
        EffectInfo info;
        info.name    = "softening";
        info.words   = "friction that falls after the first slip and stays low";
        info.formula = "d mu/d lambda = -kappa (exp(a (mu - mu_k)) - 1)";
        info.latex   = "\\frac{d\\mu}{d\\lambda} = -\\kappa \\left(e^{a(\\mu - "
                       "\\mu_k)} - 1\\right)";
        info.source  = "source paper, eq. 2, first term";
        info.neutral = "Rate = 0 1/mm";
        info.parameters = {
          {"Rate",
           "kappa",
           "0.045",
           Quantity(Dimension::per_length, 0.),
           "rate of softening with slip (eq. 2 of the source paper); the "
           "static-to-kinetic transition takes a slip of about 1/(kappa a)"},
          {"Steepness",
           "a",
           "1",
           Quantity(Dimension::number, 0., 1e4, true),
           "steepness of softening in terms of mu (eq. 2 of the source paper)"},
          {"Kinetic coefficient",
           "mu_k",
           "0.098",
           Quantity(Dimension::number, 0., 100., true),
           "kinetic coefficient of friction, reached after long sliding, at the "
           "'Speed of the coefficients'; at most the static coefficient"}};
        info.neutral_settings = {{"Rate", "0"}};
        info.typical_settings = {{"Rate", "5"}, {"Steepness", "3"}};
        info.search       = {"exponential in slip, never comes back", search};
        info.search.along = "path";
        return info;
      }

    private:
      // A fall from above the friction that the model has.
      static TrialFormula search(const Circumstances &now)
      {
        const std::string static_key = "Friction/Static coefficient";
        const std::string kinetic_key =
          "Friction/softening/Kinetic coefficient";
        const std::string rate      = "Friction/softening/Rate";
        const std::string steepness = "Friction/softening/Steepness";
        const double      mu        = now.number(static_key);
        const double      path      = now.range.longest_path;
        // Next to an exponential only the product of both is felt.
        const double least_steep = 0.1 / mu, steepest = 30. / mu;
        TrialFormula formula;
        formula.is_one_sided = true;
        formula.parameters   = {
            {static_key, 0.2 * mu, 5. * mu, false},
            {kinetic_key, 0.1 * mu, 5. * mu, false},
            {rate,
             0.1 / (path * steepest),
             1e4 / (path * least_steep),
             true,
             true,
             true},
            {steepness, least_steep, steepest, true, true, true}};
        for (const double length : ladder(0.003 * path, 0.5 * path, 5))
          formula.shapes.push_back([=](const double strength) {
            const double fall = std::clamp(just_noticed * strength, 1e-4, 2.);
            return Values{{static_key, mu * (1. + fall)},
                          {kinetic_key, mu},
                          {rate, mu / length},
                          {steepness, 1. / mu}};
          });
        return formula;
      }

      // Beyond, a product with no slip or no time would not be 0.
      static constexpr double largest_exponent = 500.;

      const double kappa;
      const double a;
      const double mu_k;
    };

    const RegisterEffect softening_registration = register_effect<Softening>();
  } // namespace
} // namespace SlipStep
