// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_search_h
#define slipstep_diagnosis_search_h

#include <slipstep/diagnosis/candidate_scores.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace SlipStep
{
  /// @name Rules, in units of the objective (chi^2).
  ///@{
  /// What every parameter has to gain.
  constexpr double cost_of_parameter = 4.;
  /// A name whose removal costs less is dropped.
  constexpr double least_cost = 15.;
  /// The same where there is but one condition, so that none can be left out.
  constexpr double sure_cost = 30.;
  /// 2 ln 20: nearer than this, a rival explains the tests as well.
  constexpr double rival_distance = 6.;
  /// A rival that does better by more than this takes the place of the name.
  constexpr double sure_gain = 1.;
  /// Fitted as rivals are those that promise this share of what the name gains,
  /// to first order, give or take the slack.
  constexpr double promising_share = 0.6, promising_slack = 10.;
  /// Of the explainable excess, if the remainder is still significant.
  constexpr double sufficient_share = 0.8;
  /// In any case, as far as an excess is known ...
  constexpr double least_share = 0.6;
  /// ... its own scatter being about this.
  constexpr double sure_excess = 25.;
  /// A candidate that has to change friction by more to be seen cannot be
  /// tested.
  constexpr double largest_hidden_change = 0.25;
  ///@}

  /// A model with one more effect, fitted, by the formula that does best; none
  /// if it cannot be simulated.
  std::optional<Model> refit_with(Workspace           &workspace,
                                  const Model         &model,
                                  const CandidateView &view);

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

  /// Fit a model once more with time steps of its own, the error of which is
  /// taken out.
  void settle(const Workspace &workspace, Model &model);

  /// The objective with the price of the parameters.
  double penalised(const Model &model);

  /// What may be spent of Diagnosis/Level on the effect of a round, counted
  /// from 0: halves of what is left, so that all rounds together spend it once.
  double level_of_round(const Workspace &workspace, const std::size_t round);

  /// Whether these tests can tell an effect, and chance among all candidates
  /// does not explain its score.
  bool is_evident(const CandidateView &seen, const double level);

  /// By how much the squares of whitened differences on left-out conditions are
  /// less with more effects; NaN for tests of a single condition.
  double left_out_gain(const Workspace &workspace,
                       const Model     &less,
                       const Model     &more);

  /// Whether an addition lowers the fitted and the left-out differences enough.
  /// @param n effects that are added
  bool is_needed(const double      cost,
                 const double      left_out_gain,
                 const std::size_t n = 1);

  /// A rival of a named effect: with it in the place of the name the tests are
  /// explained as well.
  struct Rival
  {
    std::string name; ///< of the rival
    std::string instead_of;
    double      distance = 0.; ///< penalised objective above the winner's
    Model       model;
  };

  /// What a search came to.
  struct SearchResult
  {
    Model              model;
    std::vector<Rival> rivals;
    /// Cost of removing each part, and what left-out conditions gain by it.
    std::vector<double> costs, left_out_gains;
    /// The objective of single additions to the starting model, for those that
    /// were fitted.
    std::vector<std::pair<std::string, double>> gains;
    /// Whether time was over before all was tried.
    bool is_cut_short = false;
  };

  /// Add effects as long as they are needed, take away those that are not, and
  /// exchange those for which another does better.
  SearchResult search(Workspace &workspace, const Model &base);

  /// How well every condition is predicted by a model fitted to all others:
  /// squares of whitened differences, by test.
  std::vector<double> left_out_squares(const Workspace &workspace,
                                       const Model     &model,
                                       Eigen::VectorXd *differences = nullptr);
} // namespace SlipStep

#endif
