// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_rules_h
#define slipstep_diagnosis_rules_h

namespace SlipStep
{
  // Of the search, in units of the objective (chi^2).

  /// What every parameter has to gain.
  constexpr double cost_of_parameter = 4.;
  /// A name whose removal costs less is dropped.
  constexpr double least_cost = 15.;
  /// The same where there is but one condition, so that none can be left out.
  constexpr double sure_cost = 30.;
  /// On conditions left out, by which one of two ways predicts them better.
  constexpr double sure_lead = 30.;
  /// 2 ln 20: nearer than this, a rival explains the tests as well.
  constexpr double rival_distance = 6.;
  /// A rival that does better by more than this takes the place of the name.
  constexpr double sure_gain = 1.;
  /// Fitted as rivals are those that promise this share of what the name gains,
  /// to first order, give or take the slack.
  constexpr double promising_share = 0.6, promising_slack = 10.;
  /// What a rival of a gain has to promise.
  constexpr double promise_of_rivals(const double gain)
  {
    return promising_share * gain - promising_slack;
  }
  /// Of the explainable excess, if the remainder is still significant.
  constexpr double sufficient_share = 0.8;
  /// In any case, as far as an excess is known ...
  constexpr double least_share = 0.6;
  /// ... which is to this at best.
  constexpr double sure_excess = 25.;
  /// A candidate that has to change friction by more to be seen cannot be
  /// tested.
  constexpr double largest_hidden_change = 0.25;
} // namespace SlipStep

#endif
