// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_next_test_h
#define slipstep_diagnosis_next_test_h

#include <slipstep/diagnosis/diagnosis.h>
#include <slipstep/diagnosis/search.h>

#include <string>
#include <vector>

namespace SlipStep
{
  /// How far apart two models predict a test, in standard deviations, given
  /// the noise and how well their parameters are known.
  double separation(const Workspace    &workspace,
                    const Model        &a,
                    const Model        &b,
                    const MeasuredTest &motion);

  /// The test that tells the winner from its rivals: the cheapest in time of
  /// those by which all are five standard deviations apart, else the one that
  /// separates most.
  NextTest propose_next_test(const Workspace          &workspace,
                             const Model              &winner,
                             const std::vector<Rival> &rivals);

  /// What the cheapest test is that would show a candidate which these tests do
  /// not, in words; "" if there is none.
  std::string cheapest_test(const Workspace &workspace,
                            const Model     &base,
                            const Candidate &candidate);
} // namespace SlipStep

#endif
