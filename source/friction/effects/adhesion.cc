#include <slipstep/friction/effect.h>

namespace SlipStep
{
  namespace
  {
    /// Bonds that need no pressure add to the strength of a closed contact:
    /// \f[ \tau_y = f_n \mu\,G_1 G_2 \cdots + c. \f]
    /// Bowden and Tabor (1950), The Friction and Lubrication of Solids; the
    /// linear law with a constant is Derjaguin's (1934), Z. Phys. 88, 661.
    class Adhesion : public StrengthEffect
    {
    public:
      Adhesion(const Parameters &parameters, const CoefficientBasis &)
        : c(parameters.number("Friction/adhesion/Strength"))
      {}

      virtual Strength additive_strength(const SlipStepData &) const override
      {
        Strength strength;
        strength.value = c;
        return strength;
      }

      static void declare(Parameters &parameters)
      {
        parameters.declare("Friction/adhesion/Strength",
                           "0.01",
                           Quantity(Dimension::stress, 0.),
                           "Shear strength c of the adhesive bonds, lost when "
                           "the contact opens. 0 or more, in MPa.");
      }

    private:
      const double c;
    };

    const RegisterEffect adhesion_registration(
      {"adhesion",
       ExclusiveSlot::none,
       "tau_y = f_n mu G_1 G_2 ... + c",
       "Bowden and Tabor (1950); Derjaguin (1934), Z. Phys. 88, 661-675",
       "Strength = 0 MPa",
       &Adhesion::declare,
       [](const Parameters &parameters, const CoefficientBasis &basis) {
         return std::make_unique<Adhesion>(parameters, basis);
       },
       {{"Strength", "0"}},
       {{"Strength", "0.3"}}});
  } // namespace
} // namespace SlipStep
