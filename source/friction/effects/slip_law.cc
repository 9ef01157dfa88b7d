// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// State of the slip law; 0 until the contact has closed.
    const ContactMemory slip_law_state = register_memory({"slip_law_state_s"});

    /// Contacts that strengthen with a state which evolves by slip alone. It
    /// has the steady state \f$\theta = D_c/\lambda\f$ of effect ageing, but
    /// nothing heals without slip: a rest strengthens only as far as the
    /// contact creeps meanwhile. After a step of speed ln \f$\theta\f$ fades
    /// with \f$e^{-\lambda t/D_c}\f$, up and down alike. For a constant slip
    /// rate the step is integrated exactly, \f$\ln\theta = d \ln\theta_0 + (1 -
    /// d) \ln(D_c/\lambda)\f$ with \f$d = e^{-\lambda\Delta t/D_c}\f$. That a
    /// contact closes with \f$\theta = t_0\f$, or a first state of its own, is
    /// chosen.
    ///
    /// With an overstress it is the slip law of rate and state, whose
    /// parameters are \f$a = \mu\,G\,dr/d\ln V\f$, \f$r\,\mu\,b/(1 +
    /// t_0/\theta)\f$ and \f$D_c\f$, as for effect ageing.
    class SlipLaw : public StrengthEffect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name    = "slip_law";
        info.words   = "contacts renewed by slip, which do not age at rest";
        info.formula = "G = 1 + b ln(1 + theta/t_0), d theta/dt = -(lambda "
                       "theta/D_c) ln(lambda theta/D_c)";
        info.latex =
          R"(G = 1 + b \ln\left(1 + \frac{\theta}{t_0}\right), \quad )"
          R"(\dot\theta = -\frac{\lambda\theta}{D_c} )"
          R"(\ln\frac{\lambda\theta}{D_c})";
        info.source = "Ruina (1983), J. Geophys. Res. 88, 10359-10370; first "
                      "state chosen";
        info.parameters = {
          {{"Growth", "b", "0", Quantity(Dimension::number, 0.)},
           "growth of the strength per e-fold of the state"},
          {{"Time", "t_0", "1", positive(Dimension::time)},
           "state below which the strength hardly depends on it, and with "
           "which a contact closes again"},
          {{"Slip length", "D_c", "0.1", positive(Dimension::length)},
           "slip over which the state approaches its steady value"},
          {{"First state", "theta_0", "0", Quantity(Dimension::time, 0.)},
           "state of a contact that closes for the first time, as left by what "
           "it met before the test; 0 stands for t_0"}};
        info.neutral_settings = {{"Growth", "0"}};
        info.typical_settings = {{"Growth", "0.1"},
                                 {"Time", "0.05 s"},
                                 {"Slip length", "0.02 mm"}};
        info.search.why_not =
          "by itself it looks like ageing; it is tried beside overstress";
        info.search.beside = "overstress";
        info.search.beside_signature =
          "friction that falls over some slip after a step up in speed and "
          "rises as fast after one down; rests change nothing";
        info.search.first_state =
          TrialFormula::state_of_contacts("Slip length", "First state");
        info.search.beside_formulas = {TrialFormula::state_of_contacts(
                                         "Slip length"),
                                       info.search.first_state};
        return info;
      }

      SlipLaw(const EffectSection &section, const CoefficientBasis &)
        : StrengthEffect({slip_law_state})
        , b(section.number("Growth"))
        , t_0(section.number("Time"))
        , D_c(section.number("Slip length"))
        , first_state(section.number("First state"))
      {}

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        const Rate state = state_after(step);
        Strength   factor;
        factor.value  = 1. + b * std::log1p(state.value / t_0);
        factor.d_slip = b * state.derivative / (t_0 + state.value);
        return factor;
      }

      virtual void begin(ContactState &state) const override
      {
        state[slip_law_state] = first_state;
      }

      virtual void remember(const SlipStepData &step,
                            ContactState       &end) const override
      {
        end[slip_law_state] =
          step.remembered(slip_law_state, state_after(step).value);
      }

    private:
      // theta at the end, and its derivative with respect to slip, the time
      // step being kept.
      Rate state_after(const SlipStepData &step) const
      {
        const double remembered = step.start[slip_law_state];
        const double start      = remembered > 0. ? remembered : t_0;
        if (!(step.slip > 0.))
          return {start, 0.};
        const double x = step.slip / D_c, decay = std::exp(-x);
        // ln(theta_start / theta_steady)
        const double away  = std::log(start / step.time_step * x);
        const double share = -std::expm1(-x);
        const double value = start * std::exp(-share * away);
        return {value, -value * (decay * away + share / x) / D_c};
      }

      const double b, t_0, D_c, first_state;
    };

    const RegisterEffect slip_law_registration = register_effect<SlipLaw>();
  } // namespace
} // namespace SlipStep
