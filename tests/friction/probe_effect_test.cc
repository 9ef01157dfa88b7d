// SPDX-License-Identifier: LGPL-2.1-or-later

// An effect for the tests: a strength that depends on everything a hook may
// depend on, and some strength besides.

#include <slipstep/friction/effect.h>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    class Probe : public StrengthEffect
    {
    public:
      Probe(const EffectSection &, const CoefficientBasis &)
      {}

      static EffectInfo info()
      {
        EffectInfo info;
        info.name  = "probe";
        info.words = "a strength that depends on slip, pressure and direction";
        info.formula        = info.words;
        info.source         = "made for the tests";
        info.neutral        = "not neutral";
        info.search.why_not = "it is made for the tests";
        return info;
      }

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        const double path   = step.start.slip_path + step.path;
        const double slip   = 1. + 0.2 * std::exp(-path);
        const double normal = std::pow(1. + step.normal_traction, -0.1);
        const double angle  = 1. + 0.1 * step.direction[0] * step.direction[1];
        Strength     result{slip * normal * angle,
                        0.,
                        -0.1 * slip * normal * angle /
                          (1. + step.normal_traction),
                        {}};
        result.d_path         = -0.2 * std::exp(-path) * normal * angle;
        result.d_direction[0] = slip * normal * 0.1 * step.direction[1];
        result.d_direction[1] = slip * normal * 0.1 * step.direction[0];
        return result;
      }

      virtual Strength
      additive_strength(const SlipStepData &step) const override
      {
        return {0.01 + 0.02 * step.slip, 0.02, 0., {}};
      }
    };

    const RegisterEffect probe_registration = register_effect<Probe>();
  } // namespace
} // namespace SlipStep
