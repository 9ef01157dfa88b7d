// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_sensor_noise_h
#define slipstep_measured_data_sensor_noise_h

#include <slipstep/measured_data/measured_test.h>

#include <vector>

namespace SlipStep
{
  /// Leave of channels what their sensors showed without noise: straight lines
  /// in time between rows at which a record bends by more than noise can, by
  /// least squares. Lines whose rise noise explains are level, as in a rest.
  /// All channels bend at the same rows. They stay as they are if they bend too
  /// often for lines, or lines leave more than white noise.
  /// @param deviations of the noise of each, white; one that is clean stays
  /// @return whether it was done
  bool take_off_noise(const std::vector<double>         &time,
                      std::vector<std::vector<double> *> channels,
                      const std::vector<double>         &deviations);

  /// A contact sticks or slips with less motion than many sensors tremble by,
  /// and what it carries is divided by what the pressure does: take off the
  /// noise of the displacements if its deviation is more than @p felt [mm], and
  /// that of the pressure if it is more than some 1e-4 of it. It is said in the
  /// test's warnings. A counter has no such noise.
  void take_off_noise_of_motion(MeasuredTest &test, const double felt);
} // namespace SlipStep

#endif
