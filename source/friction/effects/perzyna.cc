#include <slipstep/friction/effect.h>

#include <cmath>
#include <limits>

namespace SlipStep
{
  namespace
  {
    /// The slip rate is a power of the overstress, without an upper limit of
    /// r:
    /// \f[ \lambda = \frac1{\eta}\left<r - r_s\right>^{n}. \f]
    /// Perzyna, Quart. Appl. Math. 20 (1963) 321, for a friction surface. The
    /// residual is \f$(\eta\lambda)^{1/n} - (r - r_s)\f$.
    class Perzyna : public Effect
    {
    public:
      Perzyna(const Parameters &parameters, const CoefficientBasis &)
        : eta(parameters.number("Friction/perzyna/Viscosity"))
        , n(parameters.number("Friction/perzyna/Exponent"))
      {}

      virtual FlowResidual flow_residual(const double ratio,
                                         const double normal_ratio,
                                         const double slip_rate) const override
      {
        const double overstress = overstress_of(slip_rate);
        // At rest the slope of the root is infinite; a steep finite one keeps
        // the iteration going.
        const double slope =
          (slip_rate > 0. ? overstress / (n * slip_rate) : 1e100);
        return {overstress - (ratio - normal_ratio), -1., 1., slope};
      }

      virtual double steady_ratio(const double slip_rate) const override
      {
        return 1. + overstress_of(slip_rate);
      }

      virtual double maximum_ratio() const override
      {
        return std::numeric_limits<double>::infinity();
      }

      static void declare(Parameters &parameters)
      {
        parameters.declare("Friction/perzyna/Viscosity",
                           "100",
                           Quantity(Dimension::viscosity, 0., 1e30, true),
                           "Viscosity eta of the power-law overstress. More "
                           "than 0, in s/mm.");
        parameters.declare("Friction/perzyna/Exponent",
                           "4",
                           Quantity(Dimension::number, 1., 1e3),
                           "Exponent n of the power-law overstress. 1 or more, "
                           "no unit.");
      }

    private:
      double overstress_of(const double slip_rate) const
      {
        return std::pow(eta * std::max(slip_rate, 0.), 1. / n);
      }

      const double eta;
      const double n;
    };

    const RegisterEffect perzyna_registration(
      {"perzyna",
       ExclusiveSlot::overstress,
       "lambda = <r - r_s>^n / eta",
       "Perzyna (1963), Quart. Appl. Math. 20, 321-332",
       "Viscosity -> 0 s/mm; switch the effect off instead",
       &Perzyna::declare,
       [](const Parameters &parameters, const CoefficientBasis &basis) {
         return std::make_unique<Perzyna>(parameters, basis);
       },
       {{"Viscosity", "1e-40"}},
       {}});
  } // namespace
} // namespace SlipStep
