// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <slipstep/friction/effect.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// Friction against a preferred direction n of the surface differs from
    /// friction along it: G is 1 forward, 1 + d in reverse strokes, halfway
    /// across. The form 'reversed' acts on slip against n only and leaves slip
    /// along n and across as it is; its derivative is continuous. For laid or
    /// combed surfaces.
    class Direction : public StrengthEffect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name  = "direction";
        info.words = "friction that differs between forward and back strokes";
        info.formula =
          "G = 1 + d (1 - cos(phi)) / 2 or 1 + d max(0, -cos(phi))^2, phi: from "
          "the forward angle to slip";
        info.latex =
          R"(G = 1 + d\,\frac{1 - \cos\varphi}{2} \quad\text{or}\quad )"
          R"(1 + d \max(0, -\cos\varphi)^2)";
        info.source     = "chosen";
        info.parameters = {
          {{"Change", "d", "0.1", Quantity(Dimension::number, -0.99, 100.)},
           "share by which the strength differs in reverse strokes, negative "
           "if it is less"},
          {{"Forward angle", "", "0", Quantity(Dimension::angle, -360., 360.)},
           "angle of the forward direction n in the contact plane, from its "
           "first axis to its second"},
          {{"Form", "G", "cosine", one_of("cosine|reversed")},
           "'cosine' changes with every angle, half of it across; 'reversed' "
           "acts on slip against the forward direction only"}};
        info.neutral_settings   = {{"Change", "0"}};
        info.typical_settings   = {{"Change", "0.5"},
                                   {"Forward angle", "20 deg"}};
        info.search             = {"an offset on reverse strokes", search};
        info.search.other_forms = {TrialFormula::in_form("reversed", search),
                                   turned,
                                   TrialFormula::in_form("reversed", turned)};
        info.search.along       = "angle";
        return info;
      }

      Direction(const EffectSection &section, const CoefficientBasis &)
        : d(section.number("Change"))
        , only_reversed(section.text("Form") == "reversed")
      {
        const double angle = section.number("Forward angle");
        n[0]               = std::cos(angle);
        n[1]               = std::sin(angle);
      }

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        Strength factor;
        if (only_reversed)
          {
            const double against = std::max(0., -(n * step.direction));
            factor.value         = 1. + d * against * against;
            factor.d_direction   = -2. * d * against * n;
            return factor;
          }
        factor.value       = 1. + d * (1. - n * step.direction) / 2.;
        factor.d_direction = -d / 2. * n;
        return factor;
      }

    private:
      // Forward is the line along which tests move.
      static TrialFormula search(const Circumstances &now)
      {
        TrialFormula formula;
        formula.set_proportional("Change", 1., least, most);
        if (now.range.main_line != 0.)
          formula.settings = {{"Forward angle", now.range.main_line}};
        return formula;
      }

      // Forward is any direction.
      static TrialFormula turned(const Circumstances &now)
      {
        using dealii::numbers::PI;
        if (now.range.widest_angle < 0.1)
          return TrialFormula::none("all tests move along one line");
        const double line = now.range.main_line;
        TrialFormula formula;
        for (const double angle : {PI / 4., PI / 2., 3. * PI / 4.})
          formula.add_shape("Change",
                            0.9 * least,
                            0.9 * most,
                            {{"Forward angle", line + angle}});
        formula.parameters = {
          {"Change", least, most, false},
          {"Forward angle", line - PI, line + 2. * PI, false, true, true}};
        return formula;
      }

      static constexpr double least = -0.8, most = 3.; // looked for

      const double         d;
      const bool           only_reversed;
      dealii::Tensor<1, 2> n;
    };

    const RegisterEffect direction_registration = register_effect<Direction>();
  } // namespace
} // namespace SlipStep
