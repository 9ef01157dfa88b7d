#include <slipstep/friction/effect.h>

#include <boost/math/tools/roots.hpp>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// The slip rate grows exponentially with the overstress r - r_s, and
    /// without bound as r approaches r_m:
    /// \f[ \lambda = \frac1{\eta_v}\,
    ///     \frac{e^{n(r-r_s)} - 1}{r_m - r}\quad (r > r_s). \f]
    /// Eq. 3 of the source paper. The residual is the logarithm of this,
    /// \f$\ln(1 + \eta_v\lambda(r_m - r)) - n(r - r_s)\f$, in which Newton's
    /// method converges quickly from far away.
    class Overstress : public Effect
    {
    public:
      Overstress(const Parameters &parameters, const CoefficientBasis &)
        : eta(parameters.number("Friction/overstress/Viscosity"))
        , n(parameters.number("Friction/overstress/Exponent"))
        , r_m(parameters.number("Friction/overstress/Maximum ratio"))
      {}

      virtual FlowResidual flow_residual(const double ratio,
                                         const double normal_ratio,
                                         const double slip_rate) const override
      {
        // Beyond r_m, met by iterates only, no rate is fast enough; without the
        // drag the residual stays monotone there.
        const double distance  = std::max(r_m - ratio, 0.);
        const double drag      = eta * slip_rate * distance;
        const double logarithm = std::log1p(drag);
        const double log_slope = (distance > 0. ? 1. / (1. + drag) : 0.);
        const double driver    = n * (ratio - normal_ratio);
        return {logarithm - driver,
                -eta * slip_rate * log_slope - n,
                n,
                eta * distance * log_slope};
      }

      virtual double steady_ratio(const double slip_rate) const override
      {
        if (slip_rate <= 0.)
          return 1.;
        boost::uintmax_t iterations = 200;
        const auto       bracket    = boost::math::tools::toms748_solve(
          [&](const double r) { return flow_residual(r, 1., slip_rate).value; },
          1.,
          r_m,
          boost::math::tools::eps_tolerance<double>(52),
          iterations);
        return (bracket.first + bracket.second) / 2.;
      }

      virtual double maximum_ratio() const override
      {
        return r_m;
      }

      static void declare(Parameters &parameters)
      {
        parameters.declare("Friction/overstress/Viscosity",
                           "1.15e4",
                           Quantity(Dimension::viscosity, 0., 1e30, true),
                           "Viscosity eta_v of the overstress (eq. 3 of the "
                           "source paper; its Table 3 prints 1.15e7 ms/mm). "
                           "More than 0, in s/mm.");
        parameters.declare("Friction/overstress/Exponent",
                           "16.52",
                           Quantity(Dimension::number, 0., 1e4, true),
                           "Exponent n of the overstress (eq. 3 of the source "
                           "paper). More than 0, no unit.");
        parameters.declare("Friction/overstress/Maximum ratio",
                           "1.8",
                           Quantity(Dimension::number, 1., 1e6, true),
                           "Upper limit r_m of the dynamic-loading ratio, "
                           "approached at infinite speed (eq. 3 of the source "
                           "paper). More than 1, no unit.");
      }

    private:
      const double eta;
      const double n;
      const double r_m;
    };

    const RegisterEffect overstress_registration(
      {"overstress",
       ExclusiveSlot::overstress,
       "lambda = (exp(n (r - r_s)) - 1) / (eta_v (r_m - r)) for r > r_s",
       "source paper, eq. 3 and Table 3",
       "Viscosity -> 0 s/mm; switch the effect off instead",
       &Overstress::declare,
       [](const Parameters &parameters, const CoefficientBasis &basis) {
         return std::make_unique<Overstress>(parameters, basis);
       },
       {{"Viscosity", "1e-12"}},
       {}});
  } // namespace
} // namespace SlipStep
