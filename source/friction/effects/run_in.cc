// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// Sliding changes the surfaces for good, ever less so. Wear and galling
    /// raise friction (w > 0), polishing lowers it (w < 0).
    class RunIn : public StrengthEffect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name = "run_in";
        info.words =
          "surfaces that run in: a slow drift with the distance slid";
        info.formula = "G = 1 + w (1 - exp(-D / D_w)), D: slip path";
        info.latex   = R"(G = 1 + w \left(1 - e^{-D/D_w}\right))";
        info.source  = "Blau (2005), Tribol. Int. 38, 1007-1012; form chosen";
        info.parameters = {
          {{"Change", "w", "0.2", Quantity(Dimension::number, -0.99, 100.)},
           "share by which the strength has changed after long sliding, "
           "negative if it falls"},
          {{"Length", "D_w", "100", positive(Dimension::length)},
           "slip path after which 63 % of the change has taken place"}};
        info.neutral_settings = {{"Change", "0"}};
        info.typical_settings = {{"Change", "-0.4"}, {"Length", "0.02 mm"}};
        info.search       = {"slow drift with the path, no recovery", search};
        info.search.along = "path";
        return info;
      }

      RunIn(const EffectSection &section, const CoefficientBasis &)
        : w(section.number("Change"))
        , D_w(section.number("Length"))
      {}

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        const double path = step.start.slip_path + step.path;
        Strength     factor;
        factor.value  = 1. - w * std::expm1(-path / D_w);
        factor.d_path = w / D_w * std::exp(-path / D_w);
        return factor;
      }

    private:
      // A fall with the path is softening by another name: without softening in
      // the model only a rise is run-in.
      static TrialFormula search(const Circumstances &now)
      {
        const double path = now.range.longest_path;
        TrialFormula formula;
        formula.is_one_sided = !now.has("softening");
        formula.parameters   = {
            {"Change", formula.is_one_sided ? 0. : -0.8, 3., false},
            {"Length", 0.02 * path, 10. * path, true, false, true}};
        for (const double D : ladder(0.03 * path, 3. * path, 5))
          formula.add_shape("Change", -0.7, 2.9, {{"Length", D}});
        return formula;
      }

      const double w, D_w;
    };

    const RegisterEffect run_in_registration = register_effect<RunIn>();
  } // namespace
} // namespace SlipStep
