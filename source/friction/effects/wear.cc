// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>

namespace SlipStep
{
  namespace
  {
    /// Depth of the material that is gone.
    const ContactMemory worn_depth = register_memory({"worn_depth_mm"});

    /// The block loses material where it is pressed and slides: the volume worn
    /// is load times path times k, hardness and probability in one. The
    /// strength stays; what changes is the contact face of a block, see
    /// ContactFace::respond().
    class Wear : public StrengthEffect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name       = "wear";
        info.words      = "material that is lost under pressure and slip";
        info.formula    = "dw/d lambda = k f_n, k in mm^3/(N m)";
        info.latex      = R"(\frac{dw}{d\lambda} = k f_n)";
        info.source     = "Archard (1953), J. Appl. Phys. 24, 981-988";
        info.parameters = {
          {{"Specific rate", "k", "0", Quantity(Dimension::number, 0., 1e6)},
           "volume worn per load and slip path, in mm^3/(N m); 1e-6 is mild, "
           "1e-3 severe. On one contact point only the depth is counted"}};
        info.neutral_settings = {{"Specific rate", "0"}};
        info.typical_settings = {{"Specific rate", "1"}};
        info.search.why_not =
          "it changes the pressure within a face, not the friction of a point";
        return info;
      }

      Wear(const EffectSection &section, const CoefficientBasis &)
        : StrengthEffect({worn_depth})
        // mm^3/(N m) = 1e-3 mm^2/N
        , k(1e-3 * section.number("Specific rate"))
      {}

      virtual double wear_rate() const override
      {
        return k;
      }

      virtual void remember(const SlipStepData &step,
                            ContactState       &end) const override
      {
        end[worn_depth] =
          step.start[worn_depth] + k * step.normal_traction * step.path;
      }

    private:
      const double k; ///< [1/MPa]
    };

    const RegisterEffect wear_registration = register_effect<Wear>();
  } // namespace
} // namespace SlipStep
