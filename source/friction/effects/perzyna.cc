// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace SlipStep
{
  namespace
  {
    /// The slip rate is a power of the overstress, without an upper limit of r.
    /// The residual is \f$(\eta\lambda)^{1/n} - (r - r_s)\f$.
    class Perzyna : public Effect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name    = "perzyna";
        info.slot    = ExclusiveSlot::overstress;
        info.words   = "friction that rises with a power of the sliding speed";
        info.formula = "lambda = <r - r_s>^n / eta";
        info.latex   = R"(\lambda = \frac{1}{\eta}\left<r - r_s\right>^{n})";
        info.source  = "Perzyna (1963), Quart. Appl. Math. 20, 321-332";
        info.neutral = "Viscosity -> 0 s/mm; switch the effect off instead";
        info.parameters = {
          {{"Viscosity", "eta", "100", positive(Dimension::viscosity)},
           "viscosity of the power-law overstress"},
          {{"Exponent", "n", "4", Quantity(Dimension::number, 1., 1e3)},
           "exponent of the power-law overstress"}};
        info.neutral_settings = {{"Viscosity", "1e-40"}};
        info.search           = {"", search, "overstress"};
        info.search.along     = "log10 speed";
        return info;
      }

      Perzyna(const EffectSection &section, const CoefficientBasis &)
        : eta(section.number("Viscosity"))
        , n(section.number("Exponent"))
      {}

      virtual FlowResidual flow_residual(const double ratio,
                                         const double normal_ratio,
                                         const double slip_rate) const override
      {
        const double overstress = overstress_of(slip_rate);
        // At rest the slope of the root is infinite; a steep finite one keeps
        // the iteration going.
        const double slope =
          (slip_rate > 0. ? overstress / (n * slip_rate) : 1e100);
        return {overstress - (ratio - normal_ratio), -1., 1., slope};
      }

      virtual double steady_ratio(const double slip_rate) const override
      {
        return 1. + overstress_of(slip_rate);
      }

      virtual double maximum_ratio() const override
      {
        return std::numeric_limits<double>::infinity();
      }

    private:
      // r - r_s = (eta V)^(1/n).
      static TrialFormula search(const Circumstances &now)
      {
        const double speed = now.range.fastest;
        TrialFormula formula;
        formula.is_one_sided = true;
        formula.parameters   = {{"Viscosity", 1e-30 / speed, 1e6 / speed, true},
                                {"Exponent", 2., 16., true, true, true}};
        for (const double n : {2., 4., 8.})
          formula.shapes.push_back([=](const double strength) {
            const double rise = std::clamp(just_noticed * strength, 1e-3, 3.);
            return Values{{"Viscosity", std::pow(rise, n) / speed},
                          {"Exponent", n}};
          });
        return formula;
      }

      double overstress_of(const double slip_rate) const
      {
        return std::pow(eta * std::max(slip_rate, 0.), 1. / n);
      }

      const double eta, n;
    };

    const RegisterEffect perzyna_registration = register_effect<Perzyna>();
  } // namespace
} // namespace SlipStep
