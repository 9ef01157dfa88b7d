// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// The pressure to which the contact has adapted by slip; 0 until it has
    /// closed.
    const ContactMemory adapted_pressure =
      register_memory({"adapted_pressure_MPa"});

    /// A change of pressure acts on the coefficient of friction at once, and
    /// slip makes it forgotten:
    /// \f[ G = \left(\frac{p_m}{f_n}\right)^\alpha, \qquad
    ///     \frac{d \ln p_m}{d\lambda} = \frac{\ln f_n - \ln p_m}{L}. \f]
    /// Linker and Dieterich (1992), J. Geophys. Res. 97, 4923: a change of
    /// normal stress changes the state of rate-and-state friction by
    /// \f$d\theta = -\alpha_{LD}\theta/(b f_n)\,df_n\f$. With the slip law,
    /// d ln theta/d lambda = -ln(lambda theta/D_c)/D_c, that is linear in
    /// ln theta, so what pressure adds to the state has the equation of its own
    /// above, \f$b\,\Delta\ln\theta = -\alpha_{LD}\ln(f_n/p_m)\f$, with
    /// L = D_c and \f$\alpha_{LD} = \alpha\f$ times the coefficient of
    /// friction. The power instead of \f$1 - \alpha\ln(f_n/p_m)\f$, its first
    /// two terms, is chosen: it is positive for every pressure. \f$\alpha <
    /// 1\f$: the strength grows with pressure at once, by \f$f_n^{1-\alpha}\f$.
    class PressureMemory : public StrengthEffect
    {
    public:
      PressureMemory(const Parameters &parameters, const CoefficientBasis &)
        : alpha(parameters.number("Friction/pressure_memory/Change"))
        , L(parameters.number("Friction/pressure_memory/Slip length"))
      {}

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        const double decay = std::exp(-step.slip / L);
        const double away  = log_ratio(step);
        Strength     factor;
        factor.value  = std::exp(alpha * decay * away);
        factor.d_slip = -factor.value * alpha * decay * away / L;
        if (step.start[adapted_pressure] > 0. && step.normal_traction > 0.)
          factor.d_normal =
            -factor.value * alpha * decay / step.normal_traction;
        return factor;
      }

      virtual void remember(const SlipStepData &step,
                            ContactState       &end) const override
      {
        end[adapted_pressure] =
          step.normal_traction *
          std::exp(std::exp(-step.slip / L) * log_ratio(step));
      }

      virtual std::vector<ContactMemory> memories() const override
      {
        return {adapted_pressure};
      }

      static EffectInfo info()
      {
        EffectInfo info;
        info.name    = "pressure_memory";
        info.words   = "a change of pressure to which friction adapts by slip";
        info.formula = "G = (p_m/f_n)^alpha, d ln(p_m)/d lambda = (ln(f_n) - "
                       "ln(p_m))/L";
        info.latex   = "G = \\left(\\frac{p_m}{f_n}\\right)^\\alpha, \\quad "
                       "\\frac{d \\ln p_m}{d\\lambda} = \\frac{\\ln f_n - \\ln "
                       "p_m}{L}";
        info.source  = "Linker and Dieterich (1992), J. Geophys. Res. 97, "
                       "4923-4940; power chosen";
        info.neutral = "Change = 0";
        info.parameters = {
          {"Change",
           "alpha",
           "0",
           Quantity(Dimension::number, 0., 0.99),
           "fall of the coefficient per e-fold of the pressure, in shares of "
           "it, before slip"},
          {"Slip length",
           "L",
           "0.1",
           Quantity(Dimension::length, 0., 1e30, true),
           "slip over which a change of pressure is forgotten"}};
        info.neutral_settings = {{"Change", "0"}};
        info.typical_settings = {{"Change", "0.5"}, {"Slip length", "0.02 mm"}};
        info.search.why_not   = "it shows in steps of pressure during sliding, "
                                "which measured tests seldom have";
        return info;
      }

    private:
      // ln(p_m / f_n) with p_m as at the beginning; a contact that closes has
      // nothing to remember.
      static double log_ratio(const SlipStepData &step)
      {
        const double before = step.start[adapted_pressure];
        return before > 0. && step.normal_traction > 0. ?
                 std::log(before / step.normal_traction) :
                 0.;
      }

      const double alpha;
      const double L;
    };

    const RegisterEffect pressure_memory_registration =
      register_effect<PressureMemory>();
  } // namespace
} // namespace SlipStep
