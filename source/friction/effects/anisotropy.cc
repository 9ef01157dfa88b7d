// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <slipstep/friction/effect.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  using dealii::numbers::PI;

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
    /// work. lambda is measured in it; the path over the plane is not.
    class AssociatedAnisotropy : public Effect
    {
    public:
      explicit AssociatedAnisotropy(const dealii::Tensor<2, 2> &ellipse)
        : ellipse(ellipse)
      {}

      virtual dealii::Tensor<2, 2> cone() const override
      {
        return ellipse;
      }

    private:
      const dealii::Tensor<2, 2> ellipse; ///< P
    };



    /// The same ellipse, but friction is opposite to slip, as is chosen for
    /// most machine parts: not associated. Slip along e meets the traction of
    /// the ellipse in that direction, a factor of the strength
    /// \f[ G = \frac1{|P^{-1} e|}. \f]
    /// Zmitrowicz (1981), Wear 73, 9, has both kinds. The tangential stiffness
    /// is the same in all directions, and lambda is the true rate. What other
    /// effects add to f_n mu G is not touched.
    class OppositeAnisotropy : public StrengthEffect
    {
    public:
      explicit OppositeAnisotropy(const dealii::Tensor<2, 2> &ellipse)
        : inverse(invert(ellipse))
      {}

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        const dealii::Tensor<1, 2> scaled = inverse * step.direction;
        const double               norm   = scaled.norm();
        if (norm == 0.)
          return StrengthEffect::strength_factor(step);
        Strength factor;
        factor.value       = 1. / norm;
        factor.d_direction = -1. / (norm * norm * norm) * (inverse * scaled);
        return factor;
      }

    private:
      const dealii::Tensor<2, 2> inverse; ///< of P, symmetric
    };



    class Anisotropy
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name  = "anisotropy";
        info.slot  = ExclusiveSlot::anisotropy;
        info.words = "friction that depends on the direction in the plane";
        info.formula =
          "|f_t| = sqrt(f_1^2 + (f_2 / rho)^2), slip normal to the ellipse or "
          "along f_t";
        info.latex  = R"(|f_t|^2 = f_1^2 + \left(\frac{f_2}{\varrho}\right)^2)";
        info.source = "Michalowski and Mroz (1978), Arch. Mech. 30, 259-276; "
                      "Zmitrowicz (1981), Wear 73, 9-39";
        info.parameters = {
          {{"Form", "", "associated", one_of("associated|opposite")},
           "'associated': slip is normal to the ellipse, and the slip rate in "
           "all effects is |P V|, which is V along the first axis and rho "
           "times V along the second; 'opposite': friction is opposite to "
           "slip, and as large as the radius of the ellipse in that direction"},
          {{"Ratio", "rho", "0.8", Quantity(Dimension::number, 0.01, 100.)},
           "ratio of the coefficient along the second axis to that along the "
           "first, which is mu"},
          {{"Angle", "", "0", Quantity(Dimension::angle, -360., 360.)},
           "angle from the first axis of the contact plane to the first axis "
           "of the ellipse"}};
        info.neutral_settings   = {{"Ratio", "1"}};
        info.typical_settings   = {{"Ratio", "0.6"}, {"Angle", "35 deg"}};
        info.search             = {"a ratio in off-axis tests", search};
        info.search.other_forms = {[](const Circumstances &now) {
                                     return search_from(now, PI / 2.);
                                   },
                                   TrialFormula::in_form("opposite", search)};
        info.search.along       = "angle";
        info.create             = create;
        return info;
      }

      static std::unique_ptr<Effect> create(const EffectSection &section,
                                            const CoefficientBasis &)
      {
        const double         rho   = section.number("Ratio");
        const double         angle = section.number("Angle");
        dealii::Tensor<1, 2> first, second;
        first[0] = second[1] = std::cos(angle);
        first[1]             = std::sin(angle);
        second[0]            = -first[1];
        const dealii::Tensor<2, 2> ellipse =
          outer_product(first, first) + rho * outer_product(second, second);
        if (section.text("Form") == "opposite")
          return std::make_unique<OppositeAnisotropy>(ellipse);
        return std::make_unique<AssociatedAnisotropy>(ellipse);
      }

    private:
      static TrialFormula search(const Circumstances &now)
      {
        return search_from(now, 0.);
      }

      // A ratio and its inverse with the axes exchanged make the same friction
      // of a rigid contact; an elastic one is softer along the second axis.
      static TrialFormula search_from(const Circumstances &now,
                                      const double         middle)
      {
        if (now.range.widest_angle < 0.1 && !now.range.has_two_axes)
          return TrialFormula::none("all tests move along one line");
        constexpr double reach = PI / 4.;
        TrialFormula     formula;
        formula.parameters = {
          {"Ratio", 0.3, 3., true},
          {"Angle", middle - reach, middle + reach, false, true, true}};
        for (const double phi : {0., 0.9 * reach})
          formula.shapes.push_back([=](const double strength) {
            return Values{{"Ratio",
                           std::clamp(1. + just_noticed * strength, 0.35, 2.9)},
                          {"Angle", middle + phi}};
          });
        return formula;
      }
    };

    const RegisterEffect anisotropy_registration(Anisotropy::info());
  } // namespace
} // namespace SlipStep
