// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_rounding_noise_h
#define slipstep_diagnosis_rounding_noise_h

#include <slipstep/diagnosis/comparison.h>

#include <Eigen/Core>

#include <vector>

namespace SlipStep
{
  /// Standard deviations that rounding gives to the numbers compared, 0 where
  /// nothing was rounded: what rounded friction keeps in means, and what
  /// rounded positions do. A flank that begins up to half a step q sooner
  /// or later has at a place x any friction of those from x - q/2 to x + q/2,
  /// which scatters by their range over sqrt(12): slope times q / sqrt(12)
  /// where it is straight, and not more than the whole flank. One error moves
  /// all n numbers of the way together; sqrt(n) lets them tell as much as one.
  /// @param friction simulated, as Comparison::measured
  Eigen::VectorXd rounding_noise(const Comparison                &comparison,
                                 const std::vector<CampaignTest> &tests,
                                 const Eigen::VectorXd           &friction);
} // namespace SlipStep

#endif
