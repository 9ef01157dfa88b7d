// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// The coefficient recovers towards the static one with time. At rest the
    /// closed form is \f$\mu(t) = \mu_s + \frac1b \ln\left[1 - \left(1 -
    /// e^{-b(\mu_s-\mu_0)}\right) e^{-b\xi t}\right]\f$.
    class Healing : public CoefficientEffect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name = "healing";
        info.words =
          "contacts that strengthen at rest: a peak after every hold";
        info.formula = "d mu/dt = xi (exp(b (mu_s - mu)) - 1)";
        info.latex   = R"(\dot\mu = \xi \left(e^{b(\mu_s - \mu)} - 1\right))";
        info.source  = "source paper, eq. 2, second term";
        info.parameters = {
          {{"Rate", "xi", "0", Quantity(Dimension::per_time, 0.)},
           "rate of recovery with time (eq. 2 of the source paper)"},
          {{"Steepness", "b", "1", positive(Dimension::number, 1e8)},
           "steepness of recovery in terms of mu (eq. 2 of the source paper): a "
           "large value makes the coefficient grow with the logarithm of the "
           "time at rest"}};
        info.neutral_settings = {{"Rate", "0 1/s"}};
        info.typical_settings = {{"Rate", "1e-3"}, {"Steepness", "100"}};
        info.search           = {"a peak after a hold that grows with the "
                                           "logarithm of its time, gone after some slip",
                                 search,
                                 "",
                                 "Rate"};
        info.search.along     = "hold time";
        return info;
      }

      Healing(const EffectSection &section, const CoefficientBasis &basis)
        : xi(section.number("Rate"))
        , b(section.number("Steepness"))
        , mu_s(basis.static_coefficient)
      {}

      virtual Rate
      coefficient_rate_per_time(const double coefficient) const override
      {
        const double growth =
          std::expm1(std::min(b * (mu_s - coefficient), largest_exponent));
        return {xi * growth, -xi * b * (growth + 1.)};
      }

    private:
      // xi such that a share of the fall comes back in the longest rest.
      static double rate_of(const double fall,
                            const double steepness,
                            const double rest,
                            const double share)
      {
        return std::log(std::expm1(-steepness * fall) /
                        std::expm1(-steepness * fall * (1. - share))) /
               (steepness * rest);
      }

      // The peak after a rest fades as softening does.
      static TrialFormula search(const Circumstances &now)
      {
        if (!now.has("softening"))
          return TrialFormula::none("without softening nothing can recover");
        const double mu_s = now.number("Friction/Static coefficient");
        const double fall =
          std::max(mu_s - now.number("Friction/softening/Kinetic coefficient"),
                   0.01 * mu_s);
        const double rest = now.range.longest_rest > 0. ?
                              now.range.longest_rest :
                              now.range.longest_test;
        TrialFormula formula;
        formula.is_one_sided = true;
        formula.parameters   = {
            {"Rate", 1e-14, 1e2, true},
            {"Steepness", 0.3 / fall, 25. / fall, true, true, true}};
        for (const double x : {0.5, 3., 8.})
          for (const double share : {0.1, 0.5})
            formula.shapes.push_back([=](const double strength) {
              return Values{
                {"Rate",
                 rate_of(fall,
                         x / fall,
                         rest,
                         std::clamp(share * strength, 0.003, 0.97))},
                {"Steepness", x / fall}};
            });
        return formula;
      }

      // Beyond, a product with no slip or no time would not be 0.
      static constexpr double largest_exponent = 500.;

      const double xi, b, mu_s;
    };

    const RegisterEffect healing_registration = register_effect<Healing>();
  } // namespace
} // namespace SlipStep
