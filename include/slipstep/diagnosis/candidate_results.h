// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_candidate_results_h
#define slipstep_diagnosis_candidate_results_h

#include <slipstep/diagnosis/verdict.h>

#include <vector>

namespace SlipStep
{
  /// The whole catalogue with what became of every effect.
  std::vector<CandidateResult>
  candidate_results(const Workspace                       &workspace,
                    const Judgement                       &judgement,
                    const std::vector<DiagnosedParameter> &parameters,
                    const Model                           &base);
} // namespace SlipStep

#endif
