// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_synthetic_tests_hidden_effects_h
#define slipstep_synthetic_tests_hidden_effects_h

#include <slipstep/synthetic_tests/true_contact.h>

#include <cmath>

namespace SlipStep
{
  namespace Planting
  {
    /// @name The effects. What a seed draws depends on their order.
    ///@{
    extern const std::vector<HiddenEffectKind> catalogue_effects, joint_effects,
      other_formulas, third_formulas, outside_effects;
    ///@}

    /// What a usual campaign reaches: an amplitude is the change of friction
    /// there.
    struct Reach
    {
      static constexpr double reference_pressure = 5.8;  ///< [MPa]
      static constexpr double least_pressure     = 1.5;  ///< [MPa]
      static constexpr double largest_pressure   = 20.;  ///< [MPa]
      static constexpr double least_speed        = 0.01; ///< [mm/s]
      static constexpr double largest_speed      = 8.;   ///< [mm/s]
      static constexpr double long_rest          = 300.; ///< [s]
    };

    /// Where a name stands.
    /// @param what it is, for the message
    /// @throws InputError naming the nearest if it is not there
    std::size_t place_among(const std::vector<std::string> &names,
                            const std::string              &what,
                            const std::string              &wanted);

    inline double uniform(Random &random, const double least, const double most)
    {
      return std::uniform_real_distribution<double>(least, most)(random);
    }

    inline double
    log_uniform(Random &random, const double least, const double most)
    {
      return std::exp(uniform(random, std::log(least), std::log(most)));
    }

    inline double either_sign(Random &random)
    {
      return uniform(random, -1., 1.) < 0. ? -1. : 1.;
    }

    /// A share of the usual friction [MPa].
    inline double usual_friction(const TrueContact &contact,
                                 const double       share = 1.)
    {
      return share * Reach::reference_pressure *
             contact.coefficient.kinetic_coefficient;
    }

    /// The share of G by which strength may fall per factor e of slip rate:
    /// half of what the overstress lets it rise, so that sliding stays stable.
    inline double largest_weakening(const TrueContact &contact)
    {
      return 0.5 / contact.flow.exponent;
    }
  } // namespace Planting
} // namespace SlipStep

#endif
