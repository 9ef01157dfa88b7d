// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// The coefficient falls from static to kinetic with the slip path. In
    /// sliding alone the closed form is \f$\mu(s) = \mu_k - \frac1a \ln\left[1
    /// - \left(1 - e^{-a(\mu_0-\mu_k)}\right) e^{-a\kappa s}\right]\f$: the
    /// length of the transition is 1/(kappa a).
    class Softening : public CoefficientEffect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name    = "softening";
        info.words   = "friction that falls after the first slip and stays low";
        info.formula = "d mu/d lambda = -kappa (exp(a (mu - mu_k)) - 1)";
        info.latex   = R"(\frac{d\mu}{d\lambda} = )"
                       R"(-\kappa \left(e^{a(\mu - \mu_k)} - 1\right))";
        info.source  = "source paper, eq. 2, first term";
        info.parameters = {
          {{"Rate", "kappa", "0.045", Quantity(Dimension::per_length, 0.)},
           "rate of softening with slip (eq. 2 of the source paper); the "
           "static-to-kinetic transition takes a slip of about 1/(kappa a)"},
          {{"Steepness", "a", "1", positive(Dimension::number, 1e8)},
           "steepness of softening in terms of mu (eq. 2 of the source paper)"},
          {{"Kinetic coefficient",
            "mu_k",
            "0.098",
            positive(Dimension::number, 100.)},
           "kinetic coefficient of friction, reached after long sliding, at the "
           "'Speed of the coefficients'; at most the static coefficient",
           "Friction/Static coefficient"}};
        info.neutral_settings = {{"Rate", "0 1/mm"}};
        info.typical_settings = {{"Rate", "5"}, {"Steepness", "3"}};
        info.search       = {"exponential in slip, never comes back", search};
        info.search.along = "path";
        return info;
      }

      Softening(const EffectSection &section, const CoefficientBasis &basis)
        : kappa(section.number("Rate"))
        , a(section.number("Steepness"))
        , mu_k(section.number("Kinetic coefficient") * basis.scale)
      {
        if (mu_k > basis.static_coefficient * (1. + 1e-12))
          section.reject("Kinetic coefficient",
                         "must not exceed the static coefficient (" +
                           section.all.text("Friction/Static coefficient") +
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

    private:
      // A fall from above the friction that the model has.
      static TrialFormula search(const Circumstances &now)
      {
        const double mu   = now.number("Friction/Static coefficient");
        const double path = now.range.longest_path;
        // Next to an exponential only the product of both is felt.
        const double least_steep = 0.1 / mu, steepest = 30. / mu;
        TrialFormula formula;
        formula.is_one_sided = true;
        formula.parameters   = {
            {"Friction/Static coefficient", 0.2 * mu, 5. * mu, false},
            {"Kinetic coefficient", 0.1 * mu, 5. * mu, false},
            {"Rate",
             0.1 / (path * steepest),
             1e4 / (path * least_steep),
             true,
             true,
             true},
            {"Steepness", least_steep, steepest, true, true, true}};
        for (const double length : ladder(0.003 * path, 0.5 * path, 5))
          formula.shapes.push_back([=](const double strength) {
            const double fall = std::clamp(just_noticed * strength, 1e-4, 2.);
            return Values{{"Friction/Static coefficient", mu * (1. + fall)},
                          {"Kinetic coefficient", mu},
                          {"Rate", mu / length},
                          {"Steepness", 1. / mu}};
          });
        return formula;
      }

      // Beyond, a product with no slip or no time would not be 0.
      static constexpr double largest_exponent = 500.;

      const double kappa, a, mu_k;
    };

    const RegisterEffect softening_registration = register_effect<Softening>();
  } // namespace
} // namespace SlipStep
