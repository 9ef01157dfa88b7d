// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_friction_largest_coefficient_h
#define slipstep_friction_largest_coefficient_h

#include <slipstep/friction/effect.h>

namespace SlipStep
{
  /// The parameter of an effect whose strength needs no pressure. Without it, a
  /// contact that opens loses that at once, and where the loss closes it again
  /// a block has no equilibrium.
  inline EffectParameter largest_coefficient()
  {
    return {
      {"Largest coefficient",
       "m",
       "1000",
       Quantity(Dimension::number, 0., 1e30, true)},
      "what it adds is at most this times the pressure, so that a contact "
      "that opens loses it by and by"};
  }

  /// At most @p most times the pressure.
  inline Strength
  bounded(const Strength &strength, const double most, const SlipStepData &step)
  {
    const double bound = most * step.normal_traction;
    return strength.value <= bound ? strength : Strength{bound, 0., most, {}};
  }
} // namespace SlipStep

#endif
