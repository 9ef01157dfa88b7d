// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_rounded_motion_h
#define slipstep_measured_data_rounded_motion_h

#include <slipstep/measured_data/measured_test.h>

#include <vector>

namespace SlipStep
{
  /// The step to which values of a motion were rounded; 0 unless it shows in
  /// stairs: values that stay for several rows, between steps in one direction
  /// all of which are multiples of the same one.
  double rounding_of_motion(const std::vector<double> &values);

  /// The same motion without stairs: it passes the middle between two values
  /// where the record changes from one to the other, as fast as there; where
  /// the record stays much longer than at that speed, it rests. No value is
  /// changed by more than half a step.
  std::vector<double> without_stairs(const std::vector<double> &time,
                                     const std::vector<double> &values,
                                     const double               step);

  /// The larger step of both axes of a test.
  double rounding_of_motion(const MeasuredTest &test);

  /// Take the stairs out of both axes of a test, and say so in its warnings.
  void undo_rounding_of_motion(MeasuredTest &test);
} // namespace SlipStep

#endif
