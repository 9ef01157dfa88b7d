// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_basis_h
#define slipstep_diagnosis_basis_h

#include <slipstep/diagnosis/covariates.h>

#include <Eigen/Core>

#include <string>
#include <vector>

namespace SlipStep
{
  /// A correction of the simulated friction that depends on one covariate.
  struct BasisColumn
  {
    std::string     covariate; ///< "speed"
    Eigen::VectorXd friction;  ///< change, per unit
  };

  /// Smooth functions of every covariate that varies, times friction.
  std::vector<BasisColumn> smooth_basis(const Comparison &comparison,
                                        const Covariates &covariates);

  /// What a model with anything at all could remove: the mean of every
  /// condition and a few waves.
  std::vector<Eigen::VectorXd> condition_basis(const Comparison  &comparison,
                                               const Covariates  &covariates,
                                               const unsigned int n_waves);
} // namespace SlipStep

#endif
