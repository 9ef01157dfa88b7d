// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/contact_age.h>
#include <slipstep/friction/effect.h>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// How long what now touches has been in touch.
    const ContactMemory contact_age = register_memory({"contact_age_s"});

    /// Contacts grow stronger with the logarithm of their age, and slip renews
    /// them. Other than by effect healing, the peak after a rest fades on a
    /// slip length of its own. In steady sliding \f$\theta = L/\lambda\f$:
    /// friction falls with speed below \f$L/t_0\f$, and sliding on a soft
    /// spring is unstable there unless an overstress outweighs it.
    ///
    /// With an overstress this is Dieterich's ageing law of rate and state: his
    /// state evolves as \f$\theta\f$ does, and his parameters follow from those
    /// here,
    /// \f[ a_D = \mu\,G\,\frac{dr}{d\ln V}, \qquad
    ///     b_D = \frac{r\,\mu\,b_{age}}{1 + t_0/\theta}, \qquad D_c = L. \f]
    /// They are constant as far as r is linear in ln V and the contact much
    /// older than t_0.
    class Ageing : public StrengthEffect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name  = "ageing";
        info.words = "contacts that strengthen with their age";
        info.formula =
          "G = 1 + b_age ln(1 + theta/t_0), d theta/dt = 1 - lambda theta/L";
        info.latex =
          R"(G = 1 + b_{age} \ln\left(1 + \frac{\theta}{t_0}\right), )"
          R"(\quad \dot\theta = 1 - \frac{\lambda\theta}{L})";
        info.source     = "Dieterich (1979), J. Geophys. Res. 84, 2161-2168";
        info.parameters = {
          {{"Growth", "b_age", "0", Quantity(Dimension::number, 0.)},
           "growth of the strength per e-fold of the contact's age"},
          {{"Time", "t_0", "1", positive(Dimension::time)},
           "age from which the contact grows with the logarithm of its age"},
          {{"Renewal length", "L", "0.1", positive(Dimension::length)},
           "slip that renews the contacts"},
          {{"First age", "theta_0", "0", Quantity(Dimension::time, 0.)},
           "age of a contact that closes for the first time: how long it had "
           "rested before the test"}};
        info.neutral_settings = {{"Growth", "0"}};
        info.typical_settings = {{"Growth", "0.1"},
                                 {"Time", "0.05 s"},
                                 {"Renewal length", "0.02 mm"}};
        info.search           = {"", search, "healing", "Growth"};
        info.search.along     = "hold time";
        info.search.beside    = "overstress";
        info.search.beside_signature =
          "friction that falls over some slip after a step up in speed, and "
          "rises after one down";
        const auto aged =
          TrialFormula::state_of_contacts("Renewal length", "First age");
        info.search.beside_formulas = {
          TrialFormula::state_of_contacts("Renewal length"), aged};
        info.search.first_state = aged;
        // Alone, friction that falls with speed makes sliding jump; without
        // rests it is a candidate of its own.
        info.search.other_forms = {[=](const Circumstances &now) {
          return !(now.range.longest_rest > 0.) ?
                   TrialFormula::none("nothing rested") :
                 now.has("overstress") ?
                   aged(now) :
                   TrialFormula::none(
                     "nothing holds friction that falls with speed");
        }};
        return info;
      }

      Ageing(const EffectSection &section, const CoefficientBasis &)
        : StrengthEffect({contact_age})
        , b_age(section.number("Growth"))
        , t_0(section.number("Time"))
        , L(section.number("Renewal length"))
        , first_age(section.number("First age"))
      {}

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        const Rate age = contact_age_after(step.start[contact_age], step, L);
        Strength   factor;
        factor.value  = 1. + b_age * std::log1p(age.value / t_0);
        factor.d_slip = b_age * age.derivative / (t_0 + age.value);
        return factor;
      }

      virtual void begin(ContactState &state) const override
      {
        state[contact_age] = first_age;
      }

      virtual void remember(const SlipStepData &step,
                            ContactState       &end) const override
      {
        end[contact_age] = step.remembered(
          contact_age,
          contact_age_after(step.start[contact_age], step, L).value);
      }

    private:
      // The peak after a rest fades on a length of its own, which is not longer
      // than what touches: otherwise it is a drift, which has other names.
      static TrialFormula search(const Circumstances &now)
      {
        constexpr double shortest = 1e-4, longest = 1.; // [mm]
        const double     rest = now.range.longest_rest;
        TrialFormula     formula;
        // Without rests it is an effect of the speed, which has other names.
        if (rest == 0.)
          return TrialFormula::none("nothing rested");
        formula.is_one_sided = true;
        formula.parameters   = {
            {"Growth", 0., 1., false},
            {"Time", 1e-4 * rest, 10. * rest, true, true, true},
            {"Renewal length", shortest, longest, true}};
        for (const double t_0 : {0.01 * rest, 0.3 * rest})
          for (const double L : ladder(0.01, 0.5, 3))
            formula.add_shape("Growth",
                              1e-6,
                              0.9,
                              {{"Time", t_0}, {"Renewal length", L}},
                              std::log1p(rest / t_0));
        return formula;
      }

      const double b_age, t_0, L, first_age;
    };

    const RegisterEffect ageing_registration = register_effect<Ageing>();
  } // namespace
} // namespace SlipStep
