// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/contact_age.h>

#include <cmath>

namespace SlipStep
{
  Rate contact_age_after(const double        age,
                         const SlipStepData &step,
                         const double        renewal_length)
  {
    const double x = step.slip / renewal_length, decay = std::exp(-x);
    // (1 - e^-x) / x and its derivative.
    const bool   is_small = x < 1e-4;
    const double share =
      is_small ? 1. - x / 2. + x * x / 6. : -std::expm1(-x) / x;
    const double slope =
      is_small ? -0.5 + x / 3. - x * x / 8. : (decay - share) / x;
    return {age * decay + step.time_step * share,
            (step.time_step * slope - age * decay) / renewal_length};
  }
} // namespace SlipStep
