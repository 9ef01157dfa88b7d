// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_basis_h
#define slipstep_diagnosis_basis_h

#include <slipstep/diagnosis/covariates.h>
#include <slipstep/diagnosis/score_test.h>

#include <vector>

namespace SlipStep
{
  /// Smooth functions of every covariate that varies, times friction.
  std::vector<Direction> smooth_basis(const Comparison &comparison,
                                      const Covariates &covariates);

  /// What a model with anything at all could remove: the mean of every
  /// condition and a few waves.
  std::vector<Direction> condition_basis(const Comparison  &comparison,
                                         const Covariates  &covariates,
                                         const unsigned int n_waves);
} // namespace SlipStep

#endif
