// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_left_out_h
#define slipstep_diagnosis_left_out_h

#include <slipstep/diagnosis/workspace.h>

namespace SlipStep
{
  /// By how much the squares of whitened differences on left-out conditions are
  /// less with more effects; NaN for tests of a single condition.
  double left_out_gain(const Workspace &workspace,
                       const Model     &less,
                       const Model     &more);

  /// How well every condition is predicted by a model fitted to all others:
  /// squares of whitened differences, by test.
  std::vector<double> left_out_squares(const Workspace &workspace,
                                       const Model     &model,
                                       Eigen::VectorXd *differences = nullptr);
} // namespace SlipStep

#endif
