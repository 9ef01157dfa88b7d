#include <slipstep/friction/effect.h>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// Sliding changes the surfaces for good, ever less so:
    /// \f[ G = 1 + w \left(1 - e^{-D/D_w}\right), \f]
    /// where D is the slip path. Wear and galling raise friction (w > 0),
    /// polishing lowers it (w < 0). What happens in running-in: Blau (2005),
    /// Tribol. Int. 38, 1007; the exponential is chosen.
    class RunIn : public StrengthEffect
    {
    public:
      RunIn(const Parameters &parameters, const CoefficientBasis &)
        : w(parameters.number("Friction/run_in/Change"))
        , D_w(parameters.number("Friction/run_in/Length"))
      {}

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        const double path = step.start.slip_path + step.slip;
        Strength     factor;
        factor.value  = 1. - w * std::expm1(-path / D_w);
        factor.d_slip = w / D_w * std::exp(-path / D_w);
        return factor;
      }

      static void declare(Parameters &parameters)
      {
        parameters.declare("Friction/run_in/Change",
                           "0.2",
                           Quantity(Dimension::number, -0.99, 100.),
                           "Share w by which the strength has changed after "
                           "long sliding, negative if it falls. From -0.99 to "
                           "100, no unit.");
        parameters.declare("Friction/run_in/Length",
                           "100",
                           Quantity(Dimension::length, 0., 1e30, true),
                           "Slip path D_w after which 63 % of the change are "
                           "made. More than 0, in mm.");
      }

    private:
      const double w;
      const double D_w;
    };

    const RegisterEffect run_in_registration(
      {"run_in",
       ExclusiveSlot::none,
       "G = 1 + w (1 - exp(-D / D_w)), D: slip path",
       "Blau (2005), Tribol. Int. 38, 1007-1012; form chosen",
       "Change = 0",
       &RunIn::declare,
       [](const Parameters &parameters, const CoefficientBasis &basis) {
         return std::make_unique<RunIn>(parameters, basis);
       },
       {{"Change", "0"}},
       {{"Change", "-0.4"}, {"Length", "0.02 mm"}}});
  } // namespace
} // namespace SlipStep
