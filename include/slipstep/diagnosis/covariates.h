// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_covariates_h
#define slipstep_diagnosis_covariates_h

#include <slipstep/diagnosis/comparison.h>
#include <slipstep/diagnosis/covariate.h>

#include <Eigen/Core>

#include <vector>

namespace SlipStep
{
  /// Everything known of the rows compared that may explain a difference, all
  /// tests in a row; for both axes of a test the same.
  struct Covariates
  {
    Eigen::VectorXd speed;    ///< of the load point [mm/s], 0 at rest
    Eigen::VectorXd pressure; ///< [MPa]
    Eigen::VectorXd path;     ///< [mm], since the beginning of the test
    Eigen::VectorXd position; ///< displacement along the first axis [mm]
    Eigen::VectorXd track;    ///< displacement along the main line [mm]
    /// Slip since the last start, stop or reversal [mm].
    Eigen::VectorXd since_start;
    /// Duration of the last rest [s], 0 before any.
    Eigen::VectorXd rest;
    Eigen::VectorXd angle;      ///< of motion [rad]
    Eigen::VectorXd is_reverse; ///< 1 where motion goes back
    Eigen::VectorXd heat;       ///< recent frictional work [MPa mm]
    Eigen::VectorXd order;      ///< of the test in the campaign; 0 if unknown
    Eigen::VectorXd friction;   ///< as simulated
    Eigen::VectorXd axis;       ///< of the test's, 0 or 1
    /// How far the pressure has fallen below the largest so far, as a share.
    Eigen::VectorXd unloading;
    Eigen::VectorXd pressure_rate; ///< [MPa/s]
    /// lagging_change() over a tenth of the longest path.
    Eigen::VectorXd    pressure_change, speed_change;
    std::vector<Phase> phase;
    double             main_line = 0.; ///< as TestedRange
  };

  /// @param friction simulated, as Comparison::measured
  Covariates find_covariates(const Comparison                &comparison,
                             const std::vector<CampaignTest> &tests,
                             const Eigen::VectorXd           &friction,
                             const double elastic_slip_per_pressure);

  /// ln of a positive value over what follows it, test by test; 0 where it is
  /// not positive.
  /// @param length slip on which it follows [mm]
  Eigen::VectorXd lagging_change(const Comparison      &comparison,
                                 const Eigen::VectorXd &path,
                                 const Eigen::VectorXd &value,
                                 const double           length);

  TestedRange tested_range(const Comparison                &comparison,
                           const std::vector<CampaignTest> &tests,
                           const Covariates                &covariates);
} // namespace SlipStep

#endif
