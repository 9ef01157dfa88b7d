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
  /// the record stays much longer than at that speed, it rests. It is even over
  /// as many rows as the rounding lets it be. No value is changed by more than
  /// half a step.
  std::vector<double> without_stairs(const std::vector<double> &time,
                                     const std::vector<double> &values,
                                     const double               step);

  /// The step to which the stamps of an even clock were rounded, as 1 ms that
  /// makes steps of 3, 3 and 4 ms of 300 Hz; 0 if there is none, or less than a
  /// hundredth of the steps.
  double rounding_of_time(const std::vector<double> &time);

  /// Make the clock even again over as many rows as the rounding lets it be: no
  /// stamp is changed by more than half a step.
  void undo_rounding_of_time(MeasuredTest &test);

  /// Whether values are whole steps.
  /// @param tolerance of a step, for the digits of a file
  bool are_multiples(const std::vector<double> &values,
                     const double               step,
                     const double               tolerance = 1e-3);

  /// The larger step of both axes of a test.
  /// @param of_others to which other records of the same machine were rounded:
  ///   rows far from each other make no stairs, but an axis all of whose values
  ///   are multiples of it was rounded to it, too
  double rounding_of_motion(const MeasuredTest &test,
                            const double        of_others = 0.);

  /// Take the stairs out of both axes of a test, and say so in its warnings.
  /// Where all places are on a straight line, as far as the rounding tells, so
  /// is the motion: stairs of two axes do not end together, and friction would
  /// turn to and fro.
  void undo_rounding_of_motion(MeasuredTest &test, const double of_others = 0.);
} // namespace SlipStep

#endif
