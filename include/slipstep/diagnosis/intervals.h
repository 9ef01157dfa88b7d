// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_intervals_h
#define slipstep_diagnosis_intervals_h

#include <slipstep/diagnosis/diagnosis.h>
#include <slipstep/diagnosis/workspace.h>

#include <vector>

namespace SlipStep
{
  /// All fitted parameters of a model: those of added effects with intervals
  /// by profile likelihood, as far as Comparison::deadline allows, the others
  /// from the curvature.
  std::vector<DiagnosedParameter> find_intervals(const Workspace &workspace,
                                                 const Model     &model,
                                                 const double     confidence);
} // namespace SlipStep

#endif
