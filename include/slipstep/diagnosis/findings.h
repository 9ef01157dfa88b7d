// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_findings_h
#define slipstep_diagnosis_findings_h

#include <slipstep/diagnosis/diagnosis.h>
#include <slipstep/diagnosis/verdict.h>
#include <slipstep/diagnosis/ingest.h>

namespace SlipStep
{
  /// @name What was found, put down for reports.
  ///@{
  void describe_data(const Ingested &ingested, Diagnosis &diagnosis);

  /// The whole catalogue with what became of every effect.
  /// @param parameters that were fitted in the end
  std::vector<CandidateResult>
  candidate_results(const Workspace                       &workspace,
                    const Judgement                       &judgement,
                    const std::vector<DiagnosedParameter> &parameters,
                    const Model                           &base);

  /// All fitted parameters of a model: those of added effects with intervals
  /// by profile likelihood, as far as Comparison::deadline allows, the others
  /// from the curvature.
  std::vector<DiagnosedParameter> find_intervals(const Workspace &workspace,
                                                 const Model     &model,
                                                 const double     confidence);

  void describe_noise(const Workspace &workspace, Diagnosis &diagnosis);

  /// @param after the model that the diagnosis came to
  void describe_tests(const Ingested &ingested,
                      const Model    &after,
                      Diagnosis      &diagnosis);

  void describe_shrink(const Ingested &ingested,
                       const Model    &after,
                       Diagnosis      &diagnosis);

  /// Warn of names that have as many numbers as there are levels of what they
  /// depend on: they fit anything.
  void describe_few_levels(const Workspace &workspace,
                           const Model     &model,
                           Diagnosis       &diagnosis);

  /// Warn of lengths of what was added that are shorter than the path between
  /// two rows: that is all that is seen of them.
  void describe_short_lengths(const Workspace &workspace,
                              const Model     &model,
                              Diagnosis       &diagnosis);

  /// Warn of names that let friction fall with speed, where an effect by which
  /// it would do so at once was not tried, since nothing holds it.
  void describe_what_nothing_holds(const Workspace &workspace,
                                   const View      &view,
                                   const Model     &model,
                                   Diagnosis       &diagnosis);

  /// What would change the verdict.
  void describe_doubts(const Workspace &workspace, Diagnosis &diagnosis);
  ///@}
} // namespace SlipStep

#endif
