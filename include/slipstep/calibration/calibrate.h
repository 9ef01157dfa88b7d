// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_calibration_calibrate_h
#define slipstep_calibration_calibrate_h

#include <slipstep/calibration/calibration.h>

#include <functional>

namespace SlipStep
{
  /// Find parameters from measured tests, as section "Calibration" of the case
  /// says.
  /// @param progress called with what is being done and the share done, 0 to 1;
  ///   may be empty
  /// @throws InputError for anything wrong with case or tests, RunError if no
  /// start led anywhere
  Calibration calibrate(const Parameters                        &parameters,
                        const std::function<void(const std::string &,
                                                 const double)> &progress = {});

  /// The case with the values found, in place of the start values.
  Parameters fitted_case(const Parameters  &parameters,
                         const Calibration &calibration);
} // namespace SlipStep

#endif
