// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_outlying_rows_h
#define slipstep_diagnosis_outlying_rows_h

#include <slipstep/diagnosis/diagnosis.h>
#include <slipstep/diagnosis/workspace.h>

#include <vector>

namespace SlipStep
{
  /// Let single numbers that a model leaves farther from zero than chance would
  /// leave any of the campaign count as if their noise were as large as what it
  /// leaves of them, from now on. If they are more than a few in a hundred they
  /// are no outliers: none does then, but for spikes of the records, if those
  /// are few.
  /// @return these numbers
  std::vector<Eigen::Index> weaken_outlying_rows(Workspace   &workspace,
                                                 const Model &model);

  /// The same in words, test by test.
  std::vector<Outlier>
  outlying_rows_words(const Workspace                 &workspace,
                      const std::vector<Eigen::Index> &rows);
} // namespace SlipStep

#endif
