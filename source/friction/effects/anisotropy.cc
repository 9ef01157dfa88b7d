#include <slipstep/friction/effect.h>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// Friction differs along two axes of the surface that are normal to each
    /// other: the yield level is an ellipse,
    /// \f[ |f_t|^2 \to f_1^2 + \left(\frac{f_2}{\varrho}\right)^2, \qquad
    ///     \varrho = \mu_2/\mu_1, \f]
    /// and slip is normal to it (associated), so traction and slip are parallel
    /// along the axes only. In steady sliding along the unit vector e the
    /// traction is \f$r \tau_y P^2 e / |P e|\f$ with \f$P = \f$ diag(1,
    /// \f$\varrho\f$) in the axes. Michalowski and Mroz (1978), Arch. Mech. 30,
    /// 259. That the tangential stiffness along the second axis is
    /// \f$\varrho^2\alpha_t\f$ is chosen: in the metric of the ellipse all is
    /// isotropic then, and f_1, f_2/rho, the slip s_1, rho s_2 do the same
    /// work. lambda and the slip path are measured in it.
    class Anisotropy : public Effect
    {
    public:
      Anisotropy(const Parameters &parameters, const CoefficientBasis &)
        : rho(parameters.number("Friction/anisotropy/Ratio"))
        , angle(parameters.number("Friction/anisotropy/Angle"))
      {}

      virtual dealii::Tensor<2, 2> cone() const override
      {
        dealii::Tensor<1, 2> first, second;
        first[0] = second[1] = std::cos(angle);
        first[1]             = std::sin(angle);
        second[0]            = -first[1];
        return outer_product(first, first) +
               rho * outer_product(second, second);
      }

      static void declare(Parameters &parameters)
      {
        parameters.declare("Friction/anisotropy/Ratio",
                           "0.8",
                           Quantity(Dimension::number, 0.01, 100.),
                           "Ratio rho of the coefficient along the second axis "
                           "to that along the first, which is mu. From 0.01 to "
                           "100, no unit.");
        parameters.declare(
          "Friction/anisotropy/Angle",
          "0",
          Quantity(Dimension::angle, -360., 360.),
          "Angle from the first axis of the contact plane to "
          "the first axis of the ellipse. From -360 to 360, in "
          "deg.");
      }

    private:
      const double rho;
      const double angle;
    };

    const RegisterEffect anisotropy_registration(
      {"anisotropy",
       ExclusiveSlot::anisotropy,
       "|f_t| = sqrt(f_1^2 + (f_2 / rho)^2), slip normal to the ellipse",
       "Michalowski and Mroz (1978), Arch. Mech. 30, 259-276",
       "Ratio = 1",
       &Anisotropy::declare,
       [](const Parameters &parameters, const CoefficientBasis &basis) {
         return std::make_unique<Anisotropy>(parameters, basis);
       },
       {{"Ratio", "1"}},
       {{"Ratio", "0.6"}, {"Angle", "35 deg"}}});
  } // namespace
} // namespace SlipStep
