#include <slipstep/friction/effect.h>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// Friction heats the contact, and a warm contact is weaker:
    /// \f[ G = \frac{1}{1 + \beta T}, \qquad
    ///     \frac{dT}{dt} = h |f_t| \lambda - \frac{T}{t_c}. \f]
    /// T is the temperature above that of the surroundings. Over a step it is
    /// integrated exactly for a constant heat flow. That the heat of sliding
    /// governs friction is from Blok (1937), Proc. Inst. Mech. Eng. 2, 222; one
    /// temperature per point and the form of G are chosen. In steady sliding
    /// \f$T = h t_c |f_t| \lambda\f$.
    class Heating : public StrengthEffect
    {
    public:
      Heating(const Parameters &parameters, const CoefficientBasis &)
        : beta(parameters.number("Friction/heating/Weakening"))
        , h(parameters.number("Friction/heating/Heating"))
        , t_c(parameters.number("Friction/heating/Cooling time"))
      {}

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        Strength factor;
        factor.value = 1. / (1. + beta * temperature_rise(step));
        factor.d_work =
          -beta * factor.value * factor.value * rise_per_work(step);
        return factor;
      }

      virtual void remember(const SlipStepData &step,
                            ContactState       &end) const override
      {
        end.temperature_rise = temperature_rise(step);
      }

      virtual std::vector<double ContactState::*> memories() const override
      {
        return {&ContactState::temperature_rise};
      }

      static void declare(Parameters &parameters)
      {
        parameters.declare("Friction/heating/Weakening",
                           "1e-3",
                           Quantity(Dimension::per_temperature, 0.),
                           "Weakening beta with temperature. 0 or more, in "
                           "1/degC.");
        parameters.declare("Friction/heating/Heating",
                           "10",
                           Quantity(Dimension::heating, 0.),
                           "Temperature h that the contact gains per work of "
                           "friction and area. 0 or more, in degC mm/N.");
        parameters.declare("Friction/heating/Cooling time",
                           "10",
                           Quantity(Dimension::time, 0., 1e30, true),
                           "Time t_c in which the temperature falls to 37 %. "
                           "More than 0, in s.");
      }

    private:
      // Of heat that flows during the step, some is gone at its end.
      double rise_per_work(const SlipStepData &step) const
      {
        return -h * t_c / step.time_step * std::expm1(-step.time_step / t_c);
      }

      double temperature_rise(const SlipStepData &step) const
      {
        return step.start.temperature_rise * std::exp(-step.time_step / t_c) +
               rise_per_work(step) * step.work;
      }

      const double beta;
      const double h;
      const double t_c;
    };

    const RegisterEffect heating_registration(
      {"heating",
       ExclusiveSlot::none,
       "G = 1 / (1 + beta T), dT/dt = h |f_t| lambda - T / t_c",
       "Blok (1937), Proc. Inst. Mech. Eng. 2, 222-235; form chosen",
       "Weakening = 0 1/degC",
       &Heating::declare,
       [](const Parameters &parameters, const CoefficientBasis &basis) {
         return std::make_unique<Heating>(parameters, basis);
       },
       {{"Weakening", "0"}},
       {{"Weakening", "0.02"}, {"Heating", "50"}, {"Cooling time", "2 s"}}});
  } // namespace
} // namespace SlipStep
