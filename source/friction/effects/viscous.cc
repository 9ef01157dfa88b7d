#include <slipstep/friction/effect.h>

namespace SlipStep
{
  namespace
  {
    /// A Newtonian film adds a strength in proportion to the slip rate:
    /// \f[ \tau_y = f_n \mu\,G_1 G_2 \cdots + c_v \lambda. \f]
    /// Of a film of thickness h and viscosity \f$\eta\f$,
    /// \f$c_v = \eta/h\f$: Reynolds (1886), Phil. Trans. R. Soc. 177, 157. As
    /// part of the yield level it is multiplied by r.
    class Viscous : public StrengthEffect
    {
    public:
      Viscous(const Parameters &parameters, const CoefficientBasis &)
        : c_v(parameters.number("Friction/viscous/Drag"))
      {}

      virtual bool depends_on_rate() const override
      {
        return true;
      }

      virtual Strength
      additive_strength(const SlipStepData &step) const override
      {
        Strength strength;
        strength.value  = c_v * step.slip_rate();
        strength.d_rate = c_v;
        return strength;
      }

      static void declare(Parameters &parameters)
      {
        parameters.declare("Friction/viscous/Drag",
                           "0.01",
                           Quantity(Dimension::drag, 0.),
                           "Strength c_v per slip rate. 0 or more, in MPa "
                           "s/mm.");
      }

    private:
      const double c_v;
    };

    const RegisterEffect viscous_registration(
      {"viscous",
       ExclusiveSlot::none,
       "tau_y = f_n mu G_1 G_2 ... + c_v lambda",
       "Reynolds (1886), Phil. Trans. R. Soc. 177, 157-234",
       "Drag = 0 MPa s/mm",
       &Viscous::declare,
       [](const Parameters &parameters, const CoefficientBasis &basis) {
         return std::make_unique<Viscous>(parameters, basis);
       },
       {{"Drag", "0"}},
       {{"Drag", "0.2"}}});
  } // namespace
} // namespace SlipStep
