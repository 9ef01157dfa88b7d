// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>

#include <deal.II/base/numbers.h>

#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/expint.hpp>
#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace SlipStep
{
  namespace
  {
    using dealii::numbers::PI_2;

    /// The normal ratio grows with slip, ever slower towards 1, so that
    /// sticking goes over into sliding smoothly. Both forms are integrated
    /// exactly over a step: the first gives \f$\cos(\pi R/2) = \cos(\pi
    /// R_0/2)\,e^{-\pi u\lambda/2}\f$, the second \f$E_1(-\ln R) = E_1(-\ln
    /// R_0) + u\lambda\f$, with \f$\lambda/(1 - r_e)\f$ for the slip. Nothing
    /// slips below the elastic range r_e, the material constant R_e of
    /// Hashiguchi, Elastoplasticity Theory (2014).
    class Subloading : public Effect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name  = "subloading";
        info.slot  = ExclusiveSlot::normal_ratio;
        info.words = "slip that begins little by little before full friction";
        info.formula =
          "d r_s/d lambda = u cot(pi R/2) or -u ln(R), R = (r_s - r_e)/(1 - "
          "r_e); r_s <= r";
        info.latex =
          R"(\frac{dr_s}{d\lambda} = u \cot\frac{\pi R}{2} )"
          R"(\quad\text{or}\quad -u \ln R, \qquad R = )"
          R"(\left<\frac{r_s - r_e}{1 - r_e}\right>, \qquad r_s \le r)";
        info.source  = "Hashiguchi, Ozaki and Okayasu (2005), Int. J. Solids "
                       "Struct. 42, 1705-1727";
        info.neutral = "Rate -> infinity; switch the effect off instead";
        info.parameters = {
          {{"Form", "U", "cot", one_of("cot|log")},
           "evolution function of the normal ratio: 'cot' is u cot(pi R/2), "
           "'log' is -u ln(R), with R = r_s without an elastic range"},
          {{"Rate", "u", "200", positive(Dimension::per_length)},
           "rate at which the normal ratio grows with slip: sliding is fully "
           "developed after a slip of a few 1/u; infinity is Coulomb's law"},
          {{"Elastic range", "r_e", "0", Quantity(Dimension::number, 0., 0.99)},
           "normal ratio below which nothing slips"}};
        info.neutral_settings = {{"Rate", "1e12"}};
        info.search           = {"rounded flanks before every peak", search};
        return info;
      }

      Subloading(const EffectSection &section, const CoefficientBasis &)
        : u(section.number("Rate"))
        , r_e(section.number("Elastic range"))
        , is_logarithmic(section.text("Form") == "log")
      {}

      virtual double virgin_normal_ratio() const override
      {
        return 0.;
      }

      virtual double elastic_range() const override
      {
        return r_e;
      }

      virtual NormalRatio
      normal_ratio_after_slip(const double start,
                              const double slip) const override
      {
        // Beyond the elastic range, as a share of what is beyond it; at 0 both
        // forms have an infinite rate.
        const double beyond = 1. - r_e;
        const double r_s0 =
          std::min(std::max((start - r_e) / beyond, 1e-12), 1.);
        const double relative_slip = slip / beyond;
        NormalRatio  result = slip <= 0. ? NormalRatio{r_s0, rate(r_s0), 1.} :
                              is_logarithmic ? logarithmic(r_s0, relative_slip) :
                                               cotangent(r_s0, relative_slip);
        // Its d_slip is that with respect to the relative slip.
        result.value = r_e + beyond * result.value;
        return result;
      }

    private:
      // The smooth onset of slip.
      static TrialFormula search(const Circumstances &now)
      {
        const double unit = 100. / now.range.longest_path;
        TrialFormula formula;
        formula.is_one_sided = true;
        formula.parameters   = {{"Rate", 0.01 * unit, 1e5 * unit, true}};
        for (const double u : {1., 30.})
          formula.shapes.push_back([=](const double strength) {
            return Values{{"Rate",
                           std::clamp(u * unit / std::max(strength, 1e-3),
                                      0.011 * unit,
                                      9e4 * unit)}};
          });
        return formula;
      }

      double rate(const double r_s) const
      {
        return is_logarithmic ? -u * std::log(r_s) : u / std::tan(PI_2 * r_s);
      }

      NormalRatio cotangent(const double r_s0, const double slip) const
      {
        if (r_s0 >= 1.)
          return {1., 0., std::exp(-PI_2 * u * slip)};
        // 1 - cos^2 is formed without cancellation, so that small ratios keep
        // their digits.
        const double s0    = std::sin(PI_2 * r_s0);
        const double c0    = std::cos(PI_2 * r_s0);
        const double loss  = std::expm1(-PI_2 * u * slip);
        const double decay = 1. + loss;
        const double s1    = std::sqrt(s0 * s0 - c0 * c0 * loss * (1. + decay));
        const double c1    = c0 * decay;
        return {std::atan2(s1, c1) / PI_2, u * c1 / s1, decay * s0 / s1};
      }

      NormalRatio logarithmic(const double r_s0, const double slip) const
      {
        if (r_s0 >= 1.)
          return {1., 0., 0.};
        const double y0     = -std::log(r_s0);
        const double target = boost::math::expint(1, y0) + u * slip;
        // Unknown is z = ln(y), y = -ln(r_s), decreasing with slip.
        // E_1(y) > -gamma - ln(y) bounds it from below.
        const double lower = -boost::math::constants::euler<double>() - target;
        if (lower < -40.)
          return {1., 0., 0.};
        boost::uintmax_t iterations = 200;
        const double     z = boost::math::tools::newton_raphson_iterate(
          [target](const double z) {
            const double y = std::exp(z);
            return std::make_tuple(boost::math::expint(1, y) - target,
                                   -std::exp(-y));
          },
          std::max(lower, std::log(y0) - u * slip * std::exp(y0)),
          lower,
          std::log(y0) + 1e-12,
          45,
          iterations);
        const double y = std::exp(z);
        return {std::exp(-y), u * y, y / y0};
      }

      const double u, r_e;
      const bool   is_logarithmic;
    };

    const RegisterEffect subloading_registration =
      register_effect<Subloading>();
  } // namespace
} // namespace SlipStep
