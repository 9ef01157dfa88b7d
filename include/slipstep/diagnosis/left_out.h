// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_left_out_h
#define slipstep_diagnosis_left_out_h

#include <slipstep/diagnosis/workspace.h>

#include <limits>
#include <vector>

namespace SlipStep
{
  /// How well every condition is predicted by a model fitted to all others; NaN
  /// for tests of a single condition.
  /// @param differences simulated minus measured friction, if asked for
  LeftOut left_out(const Workspace &workspace,
                   const Model     &model,
                   Eigen::VectorXd *differences = nullptr);

  /// What speaks for what a model has more than another.
  struct Evidence
  {
    double cost = 0.; ///< of leaving it out
    /// By how much the squares of whitened differences on left-out conditions
    /// are less with it. NaN if that does not tell: for tests of a single
    /// condition, or where one does not judge, or alone tells of it, and the
    /// others have little against it.
    double left_out_gain = std::numeric_limits<double>::quiet_NaN();
    /// Conditions without which the others do not ask for it.
    std::vector<std::size_t> told_by = {};
    /// By condition: left out, one that alone tells of an effect is predicted
    /// without it, or by what others hardly tell. All others judge, and those
    /// that speak for it nevertheless.
    std::vector<bool> judges = {};

    /// Whether fitted and left-out differences are enough lower.
    /// @param n effects that it is
    bool is_enough(const std::size_t n = 1) const;
  };

  Evidence evidence_for(const Workspace &workspace,
                        const Model     &less,
                        const Model     &more);

  /// By how much those squares are less with one model than with another, on
  /// conditions that judge what both have more than a base, and without which
  /// the others tell of every part of both; NaN for tests of a single
  /// condition.
  double left_out_lead(const Workspace &workspace,
                       const Model     &base,
                       const Model     &model,
                       const Model     &other);
} // namespace SlipStep

#endif
