// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_experiment_follow_warnings_h
#define slipstep_experiment_follow_warnings_h

#include <slipstep/measured_data/measured_test.h>

#include <string>
#include <vector>

namespace SlipStep
{
  /// What a test begins with that a programme has not reached when it begins to
  /// follow it: the pressure of its first row, which comes on until the second
  /// is reached, and friction, as of a record that begins in mid-slide.
  /// @param pressure at that time [MPa]
  /// @param is_at_rest whether nothing has pulled at the contact so far
  std::vector<std::string> follow_warnings(const MeasuredTest &test,
                                           const double        pressure,
                                           const bool          is_at_rest);
} // namespace SlipStep

#endif
