// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>
#include <slipstep/utilities/roots.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// The slip rate grows exponentially with the overstress r - r_s, and
    /// without bound as r approaches r_m. The residual is the logarithm of the
    /// formula, \f$\ln(1 + \eta_v\lambda(r_m - r)) - n(r - r_s)\f$, in which
    /// Newton's method converges quickly from far away.
    class Overstress : public Effect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name  = "overstress";
        info.slot  = ExclusiveSlot::overstress;
        info.words = "friction that rises with sliding speed";
        info.formula =
          "lambda = (exp(n (r - r_s)) - 1) / (eta_v (r_m - r)) for r > r_s";
        info.latex =
          R"(\lambda = \frac{1}{\eta_v}\,\frac{e^{n(r-r_s)} - 1}{r_m - r} )"
          R"(\quad (r > r_s))";
        info.source     = "source paper, eq. 3 and Table 3";
        info.neutral    = "Viscosity -> 0 s/mm; switch the effect off instead";
        info.parameters = {
          {{"Viscosity", "eta_v", "1.15e4", positive(Dimension::viscosity)},
           "viscosity of the overstress (eq. 3 of the source paper; its Table 3 "
           "prints 1.15e7 ms/mm)"},
          {{"Exponent", "n", "16.52", positive(Dimension::number, 1e4)},
           "exponent of the overstress (eq. 3 of the source paper)"},
          {{"Maximum ratio",
            "r_m",
            "1.8",
            Quantity(Dimension::number, 1., 1e6, true)},
           "upper limit of the dynamic-loading ratio, approached at infinite "
           "speed (eq. 3 of the source paper)"}};
        info.neutral_settings = {{"Viscosity", "1e-12"}};
        info.search           = {
                    "the same step in every phase, linear in ln V, the same both ways",
                    search};
        info.search.along = "log10 speed";
        return info;
      }

      Overstress(const EffectSection &section, const CoefficientBasis &)
        : eta(section.number("Viscosity"))
        , n(section.number("Exponent"))
        , r_m(section.number("Maximum ratio"))
      {}

      virtual FlowResidual flow_residual(const double ratio,
                                         const double normal_ratio,
                                         const double slip_rate) const override
      {
        // Beyond r_m, met by iterates only, no rate is fast enough; without the
        // drag the residual stays monotone there.
        const double distance  = std::max(r_m - ratio, 0.);
        const double drag      = eta * slip_rate * distance;
        const double logarithm = std::log1p(drag);
        const double log_slope = (distance > 0. ? 1. / (1. + drag) : 0.);
        const double driver    = n * (ratio - normal_ratio);
        return {logarithm - driver,
                -eta * slip_rate * log_slope - n,
                n,
                eta * distance * log_slope};
      }

      virtual double steady_ratio(const double slip_rate) const override
      {
        if (slip_rate <= 0.)
          return 1.;
        return root_between(
          [&](const double r) { return flow_residual(r, 1., slip_rate).value; },
          1.,
          r_m,
          52);
      }

      virtual double maximum_ratio() const override
      {
        return r_m;
      }

    private:
      // r - r_s is about ln(1 + eta_v V (r_m - r)) / n.
      static TrialFormula search(const Circumstances &now)
      {
        TrialFormula formula;
        formula.is_one_sided = true;
        formula.parameters   = {{"Viscosity",
                                 1e-2 / now.range.fastest,
                                 1e6 / now.range.slowest,
                                 true,
                                 true,
                                 true},
                                {"Exponent", 2., 1e4, true}};
        for (const double eta :
             ladder(0.3 / now.range.fastest, 1e4 / now.range.slowest, 5))
          {
            const double rise =
              std::log1p(eta * now.range.fastest * 0.8) / just_noticed;
            formula.shapes.push_back([=](const double strength) {
              return Values{
                {"Viscosity", eta},
                {"Exponent",
                 std::clamp(rise / std::max(strength, 1e-3), 2.5, 9e3)}};
            });
          }
        return formula;
      }

      const double eta, n, r_m;
    };

    const RegisterEffect overstress_registration =
      register_effect<Overstress>();
  } // namespace
} // namespace SlipStep
