// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_motion_noise_h
#define slipstep_diagnosis_motion_noise_h

#include <slipstep/diagnosis/comparison.h>

#include <Eigen/Core>

#include <vector>

namespace SlipStep
{
  /// Standard deviations that rounded positions give to the numbers compared,
  /// 0 where none were rounded. A flank that begins up to half a step q sooner
  /// or later has at a place x any friction of those from x - q/2 to x + q/2,
  /// which scatters by their range over sqrt(12): slope times q / sqrt(12)
  /// where it is straight, and not more than the whole flank. One error moves
  /// all n numbers of the way together; sqrt(n) lets them tell as much as one.
  /// @param friction simulated, as Comparison::measured
  Eigen::VectorXd motion_noise(const Comparison                &comparison,
                               const std::vector<CampaignTest> &tests,
                               const Eigen::VectorXd           &friction);
} // namespace SlipStep

#endif
