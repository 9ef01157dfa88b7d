// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>

#include <boost/math/quadrature/gauss.hpp>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// The pressure to which the contact has adapted by slip, 0 until it has
    /// slipped; and how much of that length it has slipped since it closed.
    const ContactMemory adapted_pressure =
      register_memory({"adapted_pressure_MPa"});
    const ContactMemory adapted_share =
      register_memory({"adapted_share", 0., 0., 1.});

    /// A change of pressure acts on the coefficient of friction at once, and
    /// slip makes it forgotten. A fresh contact has adapted to the pressure at
    /// which it first slips, whatever it was pressed from, and what it
    /// remembers, v, grows within a twentieth of L, or friction of one that
    /// slips while it is pressed from nothing would have no beginning. Slipped
    /// some L it has v = w = 1: as Linker and Dieterich have it, a change of
    /// normal stress changes the state of rate-and-state friction by \f$d\theta
    /// = -\alpha_{LD}\theta/(b f_n)\,df_n\f$. With the slip law, d ln theta/d
    /// lambda = -ln(lambda theta/D_c)/D_c, that is linear in ln theta, so what
    /// pressure adds to the state has the equation of its own of p_m, with w =
    /// 1, \f$b\,\Delta\ln\theta = -\alpha_{LD}\ln(f_n/p_m)\f$, with L = D_c and
    /// \f$\alpha_{LD} = \alpha\f$ times the coefficient of friction. The power
    /// instead of \f$1 - \alpha\ln(f_n/p_m)\f$, its first two terms, is chosen:
    /// it is positive for every pressure. \f$\alpha < 1\f$: the strength grows
    /// with pressure at once, by \f$f_n^{1-\alpha}\f$.
    class PressureMemory : public StrengthEffect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name  = "pressure_memory";
        info.words = "a change of pressure to which friction adapts by slip";
        info.formula =
          "G = (p_m/f_n)^(alpha v), d ln(p_m)/d lambda = (ln(f_n) - "
          "ln(p_m))/(w L), w = 1 - exp(-s/L), v = 1 - exp(-20 s/L), s: slip "
          "since closing";
        info.latex =
          R"(G = \left(\frac{p_m}{f_n}\right)^{\alpha v}, \quad )"
          R"(\frac{d \ln p_m}{d\lambda} = \frac{\ln f_n - \ln p_m}{w L}, )"
          R"(\quad w = 1 - e^{-s/L}, \quad v = 1 - e^{-20 s/L})";
        info.source     = "Linker and Dieterich (1992), J. Geophys. Res. 97, "
                          "4923-4940; power chosen";
        info.parameters = {
          {{"Change", "alpha", "0", Quantity(Dimension::number, -0.99, 0.99)},
           "fall of the coefficient per e-fold of the pressure, in shares of "
           "it, before slip; negative if it rises"},
          {{"Slip length", "L", "0.1", positive(Dimension::length)},
           "slip over which a change of pressure is forgotten"}};
        info.neutral_settings = {{"Change", "0"}};
        info.typical_settings = {{"Change", "0.5"}, {"Slip length", "0.02 mm"}};
        info.search           = {
                    "a jump with every change of pressure that some slip takes back",
                    search};
        return info;
      }

      PressureMemory(const EffectSection &section, const CoefficientBasis &)
        : StrengthEffect({adapted_pressure, adapted_share})
        , alpha(section.number("Change"))
        , L(section.number("Slip length"))
      {}

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        const double kept = share_kept(step), away = log_ratio(step);
        const double forgotten  = share_forgotten(share(step));
        const double remembered = 1. - forgotten;
        Strength     factor;
        factor.value = std::exp(alpha * remembered * kept * away);
        if (kept > 0. && step.normal_traction > 0.)
          {
            factor.d_slip = factor.value * alpha * kept * away / L *
                            (beginning * forgotten - remembered / share(step));
            factor.d_normal =
              -factor.value * alpha * remembered * kept / step.normal_traction;
          }
        return factor;
      }

      virtual void remember(const SlipStepData &step,
                            ContactState       &end) const override
      {
        const bool has_slipped = step.normal_traction > 0. && share(step) > 0.;
        end[adapted_share]     = has_slipped ? share(step) : 0.;
        end[adapted_pressure] =
          has_slipped ? step.normal_traction *
                          std::exp(share_kept(step) * log_ratio(step)) :
                        0.;
      }

      // Over a stage the pressure is taken as constant: of a long one it would
      // not be seen that the contact lags behind.
      virtual double unseen_error(const ContactState &start,
                                  const ContactState &end) const override
      {
        const double slip = end.slip_path - start.slip_path,
                     p_0 = start.normal_traction, p_1 = end.normal_traction;
        if (!(p_0 > 0.) || !(p_1 > 0.) || !(slip > 0.) ||
            !(end[adapted_pressure] > 0.))
          return 0.;
        // With z = w ln(p_m/p_1), L dz/dlambda = ln(p/p_1) - z; of a pressure
        // that changes evenly with slip, in t = exp(-(slip to come)/L).
        const double kept = std::exp(-slip / L);
        const double z =
          (start[adapted_pressure] > 0. ?
             kept * start[adapted_share] *
               std::log(start[adapted_pressure] / p_1) :
             0.) +
          boost::math::quadrature::gauss<double, 15>::integrate(
            [&](const double t) {
              return std::log1p((p_0 / p_1 - 1.) *
                                std::min(1., -L * std::log(t) / slip));
            },
            kept,
            1.);
        const double v = 1. - share_forgotten(end[adapted_share]);
        return std::abs(
          alpha * v *
          (z / end[adapted_share] - std::log(end[adapted_pressure] / p_1)));
      }

    private:
      static TrialFormula search(const Circumstances &now)
      {
        const TestedRange &range = now.range;
        if (range.highest < 1.05 * range.lowest)
          return TrialFormula::none("the pressure hardly varies");
        TrialFormula formula;
        const double path  = range.longest_path;
        const double folds = std::log(range.highest / range.lowest);
        formula.parameters = {{"Change", -0.95, 0.95, false},
                              {"Slip length", 1e-5 * path, path, true}};
        for (const double L : ladder(0.01 * path, 0.3 * path, 4))
          formula.add_shape("Change", -0.9, 0.9, {{"Slip length", L}}, folds);
        return formula;
      }

      // w at the end.
      double share(const SlipStepData &step) const
      {
        const double start = step.start[adapted_share];
        return start - (1. - start) * std::expm1(-step.slip / L);
      }

      // 1 - v, of w.
      static double share_forgotten(const double adapted)
      {
        return std::pow(1. - adapted, beginning);
      }

      // Of ln(p_m / f_n), for a constant pressure.
      double share_kept(const SlipStepData &step) const
      {
        const double end = share(step);
        return end > 0. ?
                 step.start[adapted_share] * std::exp(-step.slip / L) / end :
                 0.;
      }

      // ln(p_m / f_n) with p_m as at the beginning.
      static double log_ratio(const SlipStepData &step)
      {
        const double before = step.start[adapted_pressure];
        return before > 0. && step.normal_traction > 0. ?
                 std::log(before / step.normal_traction) :
                 0.;
      }

      static constexpr double beginning = 20.; // L over it
      const double            alpha, L;
    };

    const RegisterEffect pressure_memory_registration =
      register_effect<PressureMemory>();
  } // namespace
} // namespace SlipStep
