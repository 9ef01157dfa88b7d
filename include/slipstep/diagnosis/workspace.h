// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_workspace_h
#define slipstep_diagnosis_workspace_h

#include <slipstep/diagnosis/comparison.h>
#include <slipstep/diagnosis/covariates.h>
#include <slipstep/diagnosis/score_test.h>
#include <slipstep/utilities/process.h>

#include <chrono>
#include <csignal>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace SlipStep
{
  struct ScoredModel;

  /// Of a model fitted without a condition, by condition.
  struct LeftOut
  {
    std::vector<double> squares;   ///< whitened, of the one left out
    std::vector<double> of_others; ///< the objective of those fitted
    /// Whether those tell of all that was added.
    std::vector<char> others_tell;
  };

  /// What a search looks at: the tests, their noise, and the rules.
  struct Workspace
  {
    Parameters                start;
    std::vector<CampaignTest> tests;
    Comparison                comparison;
    NoiseEstimate             noise;
    Covariates                covariates;
    TestedRange               range;
    RowMatrix                 null_draws;
    double                    level        = 0.04;
    unsigned int              most_effects = 4;
    unsigned int              n_refits     = 0; ///< counted here
    /// When the search has to come to an end, see is_late().
    std::chrono::steady_clock::time_point deadline =
      std::chrono::steady_clock::time_point::max();
    /// Told what is being done.
    std::function<void(const std::string &)> progress = {};

    void tell(const std::string &text) const
    {
      if (progress)
        progress(text);
    }

    /// @name Directions that are the same for every model, see
    /// prepare_gap_test(): smooth functions of covariates, waves of conditions,
    /// waves along the track.
    ///@{
    DirectionSet        smooth = {}, waves = {}, along_track = {};
    std::vector<double> wavelengths = {}; ///< of the last
    ///@}

    /// @name What is asked of the same model again: what score_candidates() saw
    /// and left_out() found lately. Not for several threads.
    ///@{
    mutable std::deque<std::shared_ptr<const ScoredModel>> scored   = {};
    mutable std::deque<std::pair<ModelKey, LeftOut>>       left_out = {};
    ///@}

    /// Whether something was, or is to be, left undone since time is over, and
    /// whether Ctrl-C ended it.
    bool was_late = false, was_stopped = false;

    /// In a handler: what Ctrl-C stopped ends with what is at hand, as when
    /// time is over; other exceptions go on, and so do other signals, after
    /// which a process may be killed within seconds.
    void end_by_signal()
    {
      if (SignalGuard::caught() != SIGINT)
        throw;
      SignalGuard::put_off();
      was_late = was_stopped = true;
      deadline = comparison.deadline = std::chrono::steady_clock::now();
    }

    /// To be asked before work that an answer can do without.
    bool is_late()
    {
      was_late = was_late || std::chrono::steady_clock::now() > deadline;
      return was_late;
    }
  };
} // namespace SlipStep

#endif
