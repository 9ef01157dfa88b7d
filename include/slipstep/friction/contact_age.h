// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_friction_contact_age_h
#define slipstep_friction_contact_age_h

#include <slipstep/friction/effect.h>

namespace SlipStep
{
  /// How long at the end of a step what touches has been in touch [s], and its
  /// derivative with respect to slip [s/mm]. The age grows with time, and slip
  /// renews the contacts: \f$\dot\theta = 1 - \lambda\theta/L\f$, Dieterich
  /// (1979), J. Geophys. Res. 84, 2161, integrated exactly for a constant slip
  /// rate.
  /// @param age at the beginning of the step [s]
  /// @param renewal_length L [mm]
  Rate contact_age_after(const double        age,
                         const SlipStepData &step,
                         const double        renewal_length);
} // namespace SlipStep

#endif
