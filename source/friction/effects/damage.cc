// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// A coating or film has failed on a share \f$1 - e^{-(D/D_d)^k}\f$ of the
    /// contact, by Weibull's distribution of lives. Galling raises friction (w
    /// > 0).
    class Damage : public StrengthEffect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name    = "damage";
        info.words   = "a coating that fails after a distance slid: friction "
                       "that changes there for good";
        info.formula = "G = 1 + w (1 - exp(-(D / D_d)^k)), D: slip path";
        info.latex   = R"(G = 1 + w \left(1 - e^{-(D/D_d)^k}\right))";
        info.source =
          "lives as in Weibull (1951), J. Appl. Mech. 18, 293-297; form chosen";
        info.parameters = {
          {{"Change", "w", "0.3", Quantity(Dimension::number, -0.99, 100.)},
           "share by which the strength has changed where the coating is gone"},
          {{"Length", "D_d", "100", positive(Dimension::length)},
           "slip path after which 63 % of the coating is gone"},
          {{"Sharpness", "k", "8", Quantity(Dimension::number, 1., 100.)},
           "how suddenly it fails: 1 is a steady loss, as in run_in"}};
        info.neutral_settings = {{"Change", "0"}};
        info.typical_settings = {{"Change", "0.3"},
                                 {"Length", "0.02 mm"},
                                 {"Sharpness", "3"}};
        info.search = {"one rise or fall after a distance slid, none before",
                       search};
        info.search.along = "path";
        info.is_sudden    = true;
        return info;
      }

      Damage(const EffectSection &section, const CoefficientBasis &)
        : w(section.number("Change"))
        , D_d(section.number("Length"))
        , k(section.number("Sharpness"))
      {}

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        const double path   = step.start.slip_path + step.path;
        const double age    = std::pow(path / D_d, k);
        const double intact = std::exp(-age);
        Strength     factor;
        factor.value = 1. + w * (1. - intact);
        factor.d_path =
          path > 0. && intact > 0. ? w * intact * age * k / path : 0.;
        return factor;
      }

    private:
      static TrialFormula search(const Circumstances &now)
      {
        const double path = now.range.longest_path;
        TrialFormula formula;
        // What is less sudden is run-in or softening.
        formula.parameters = {{"Change", -0.8, 3., false},
                              {"Length", 0.01 * path, 0.95 * path, true},
                              {"Sharpness", 4., 100., true, false, true}};
        for (const double D : ladder(0.03 * path, 0.9 * path, 8))
          formula.add_shape("Change",
                            -0.7,
                            2.9,
                            {{"Length", D}, {"Sharpness", 15.}});
        return formula;
      }

      const double w, D_d, k;
    };

    const RegisterEffect damage_registration = register_effect<Damage>();
  } // namespace
} // namespace SlipStep
