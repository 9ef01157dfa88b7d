// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_refits_h
#define slipstep_diagnosis_refits_h

#include <slipstep/diagnosis/candidate_scores.h>

#include <limits>
#include <optional>

namespace SlipStep
{
  /// The starting model with effects added, fitted; none if it cannot be
  /// simulated.
  /// @param like, values as of make_model()
  std::optional<Model> fitted_model(const Workspace          &workspace,
                                    const std::vector<Part>  &parts,
                                    const Values             &values,
                                    const Model              &like,
                                    const Comparison::FitEnd &end);

  /// A model with one more effect, fitted, by the formula that does best; none
  /// if it cannot be simulated.
  /// @param goal of the objective: fits that will not come below it are not
  ///   followed to their end
  std::optional<Model>
  refit_with(Workspace           &workspace,
             const Model         &model,
             const CandidateView &view,
             const double goal = std::numeric_limits<double>::infinity());

  /// A model with both effects of a pair, fitted.
  std::optional<Model> refit_with_pair(Workspace             &workspace,
                                       const Model           &model,
                                       const View            &view,
                                       const ScoreTest::Pair &pair);

  /// The same without one of its parts, and what corrects that, fitted again.
  std::optional<Model> refit_without(Workspace        &workspace,
                                     const Model      &model,
                                     const std::size_t part);

  /// The better of a model and itself fitted again from other starts.
  Model refit_from_starts(Workspace &workspace, const Model &model);

  /// Whether a parameter of what was added ends at a bound that makes no sense.
  bool is_at_bound(const Model &model);

  /// Give a model time steps for the parameters that it has, with their error
  /// taken out.
  /// @return false if none do, as where the contact sticks and slips: it keeps
  ///   those that it has
  bool replan(Model &model, const Simulator *like = nullptr);

  /// Fit a model once more with time steps of its own, the error of which is
  /// taken out.
  void settle(const Workspace &workspace, Model &model);

  /// Fitted as if rows alone had noise, the same share of friction everywhere:
  /// no test may be off as a whole. None if that cannot be simulated.
  std::optional<Model> fit_plainly(const Workspace &workspace,
                                   const Model     &model);

  /// The objective with the price of the parameters.
  double penalised(const Model &model);
} // namespace SlipStep

#endif
