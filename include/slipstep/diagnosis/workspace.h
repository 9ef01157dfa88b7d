// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_workspace_h
#define slipstep_diagnosis_workspace_h

#include <slipstep/diagnosis/comparison.h>
#include <slipstep/diagnosis/covariates.h>
#include <slipstep/diagnosis/score_test.h>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace SlipStep
{
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

    /// @name Directions that are the same for every model, see
    /// prepare_gap_test(): smooth functions of covariates, waves of conditions,
    /// waves along the track.
    ///@{
    DirectionSet        smooth = {}, waves = {}, along_track = {};
    std::vector<double> wavelengths = {}; ///< of the last
    ///@}

    bool is_late() const
    {
      return std::chrono::steady_clock::now() > deadline;
    }
  };
} // namespace SlipStep

#endif
