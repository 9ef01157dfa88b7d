// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_stick_slip_h
#define slipstep_measured_data_stick_slip_h

#include <slipstep/measured_data/measured_test.h>

#include <optional>

namespace SlipStep
{
  /// Friction that rises as a spring is wound up, and falls at once, again and
  /// again, while the load point goes on.
  struct StickSlip
  {
    unsigned int n_falls;
    double       stiffness; ///< of that spring, per area [MPa/mm]
  };

  /// @param noise standard deviation of the friction
  /// @return nothing unless there are several falls, all much shorter than the
  ///   rises before them (or from one row to the next after rises over more),
  ///   and the rises have one slope
  std::optional<StickSlip> find_stick_slip(const MeasuredTest &test,
                                           const double        noise);
} // namespace SlipStep

#endif
