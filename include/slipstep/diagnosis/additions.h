// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_additions_h
#define slipstep_diagnosis_additions_h

#include <slipstep/diagnosis/candidate_scores.h>

#include <string>
#include <utility>
#include <vector>

namespace SlipStep
{
  /// What may be spent of Diagnosis/Level on the effect of a round, counted
  /// from 0: a quarter on the first and on the second, an eighth on each
  /// later one. So one alarm in four gives a name where nothing is missing,
  /// and four rounds together spend less than the level.
  double level_of_round(const Workspace &workspace, const std::size_t round);

  /// Whether these tests can tell an effect, and chance among all candidates
  /// does not explain its score.
  bool is_evident(const CandidateView &seen, const double level);

  /// What became of candidates that were fitted to the starting model.
  struct FirstFits
  {
    /// By how much each lowers the objective alone.
    std::vector<std::pair<std::string, double>> gains;
    /// Those that end between the bounds of what was added.
    std::vector<Model> models;
    /// Those that no fit could simulate.
    std::vector<std::string> lost;
  };

  /// A model with one effect more, or two that hide each other or make up for
  /// each other: those that chance does not explain, fitted.
  /// @param view of the model
  std::vector<Model> fitted_additions(Workspace   &workspace,
                                      const Model &model,
                                      const View  &view,
                                      FirstFits   &notes);
} // namespace SlipStep

#endif
