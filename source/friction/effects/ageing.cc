#include <slipstep/friction/contact_age.h>
#include <slipstep/friction/effect.h>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// Contacts grow stronger with the logarithm of their age, and slip renews
    /// them:
    /// \f[ G = 1 + b_{age} \ln\left(1 + \frac{\theta}{t_0}\right), \qquad
    ///     \frac{d\theta}{dt} = 1 - \frac{\lambda\theta}{L}. \f]
    /// Other than by effect healing, the peak after a rest fades on a slip
    /// length of its own. Dieterich (1979), J. Geophys. Res. 84, 2161. In
    /// steady sliding \f$\theta = L/\lambda\f$: friction falls with speed below
    /// \f$L/t_0\f$, and sliding on a soft spring is unstable there unless an
    /// overstress outweighs it.
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
      Ageing(const Parameters &parameters, const CoefficientBasis &)
        : b_age(parameters.number("Friction/ageing/Growth"))
        , t_0(parameters.number("Friction/ageing/Time"))
        , L(parameters.number("Friction/ageing/Renewal length"))
      {}

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        const Rate age = contact_age_after(step.start.contact_age, step, L);
        Strength   factor;
        factor.value  = 1. + b_age * std::log1p(age.value / t_0);
        factor.d_slip = b_age * age.derivative / (t_0 + age.value);
        return factor;
      }

      virtual void remember(const SlipStepData &step,
                            ContactState       &end) const override
      {
        end.contact_age =
          step.normal_traction > 0. ?
            contact_age_after(step.start.contact_age, step, L).value :
            0.;
      }

      virtual std::vector<double ContactState::*> memories() const override
      {
        return {&ContactState::contact_age};
      }

      static void declare(Parameters &parameters)
      {
        parameters.declare("Friction/ageing/Growth",
                           "0",
                           Quantity(Dimension::number, 0.),
                           "Growth b_age of the strength per e-fold of the "
                           "contact's age. 0 or more, no unit.");
        parameters.declare("Friction/ageing/Time",
                           "1",
                           Quantity(Dimension::time, 0., 1e30, true),
                           "Age t_0 from which the contact grows with the "
                           "logarithm of its age. More than 0, in s.");
        parameters.declare("Friction/ageing/Renewal length",
                           "0.1",
                           Quantity(Dimension::length, 0., 1e30, true),
                           "Slip L that renews the contacts. More than 0, in "
                           "mm.");
      }

    private:
      const double b_age;
      const double t_0;
      const double L;
    };

    const RegisterEffect ageing_registration(
      {"ageing",
       ExclusiveSlot::none,
       "G = 1 + b_age ln(1 + theta/t_0), d theta/dt = 1 - lambda theta/L",
       "Dieterich (1979), J. Geophys. Res. 84, 2161-2168",
       "Growth = 0",
       &Ageing::declare,
       [](const Parameters &parameters, const CoefficientBasis &basis) {
         return std::make_unique<Ageing>(parameters, basis);
       },
       {{"Growth", "0"}},
       {{"Growth", "0.1"}, {"Time", "0.05 s"}, {"Renewal length", "0.02 mm"}}});
  } // namespace
} // namespace SlipStep
