#ifndef slipstep_diagnosis_describe_h
#define slipstep_diagnosis_describe_h

#include <slipstep/diagnosis/diagnosis.h>
#include <slipstep/diagnosis/judge.h>
#include <slipstep/diagnosis/prepare.h>
#include <slipstep/diagnosis/prove.h>

namespace SlipStep
{
  /// @name What was found, put down for reports.
  ///@{
  void describe_data(const Prepared &prepared, Diagnosis &diagnosis);

  void describe_noise(const Workspace &workspace, Diagnosis &diagnosis);

  /// @param after the model that the diagnosis came to
  void describe_tests(const Prepared &prepared,
                      const Model    &after,
                      Diagnosis      &diagnosis);

  void describe_shrink(const Prepared &prepared,
                       const Model    &after,
                       Diagnosis      &diagnosis);

  /// What would change the verdict.
  void describe_doubts(const Workspace &workspace, Diagnosis &diagnosis);
  ///@}
} // namespace SlipStep

#endif
