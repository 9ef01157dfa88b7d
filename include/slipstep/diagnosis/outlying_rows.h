// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_outlying_rows_h
#define slipstep_diagnosis_outlying_rows_h

#include <slipstep/diagnosis/diagnosis.h>
#include <slipstep/diagnosis/workspace.h>

#include <vector>

namespace SlipStep
{
  /// Single numbers that a model leaves farther from zero than chance would
  /// leave any of the campaign; none if they are more than a few in a hundred,
  /// which are no outliers.
  std::vector<Eigen::Index> outlying_rows(const Workspace &workspace,
                                          const Model     &model);

  /// Let these rows count as if their noise were as large as what the model
  /// leaves of them, from now on.
  void weaken_rows(Workspace                       &workspace,
                   const Model                     &model,
                   const std::vector<Eigen::Index> &rows);

  /// The same in words, test by test.
  std::vector<Outlier>
  outlying_rows_words(const Workspace                 &workspace,
                      const std::vector<Eigen::Index> &rows);
} // namespace SlipStep

#endif
