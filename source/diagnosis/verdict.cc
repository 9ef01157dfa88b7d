// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/verdict.h>
#include <slipstep/diagnosis/ingest.h>

#include <algorithm>

namespace SlipStep
{
  namespace
  {
    // Names that leave most of what could be explained are no explanation.
    void withdraw(Judgement &judgement, const Model &base)
    {
      for (const Part &part : judgement.found.model.parts)
        judgement.withdrawn.push_back(part.name);
      judgement.found.model = base;
      judgement.found.rivals.clear();
      judgement.found.costs.clear();
      judgement.found.left_out_gains.clear();
      judgement.remainder       = judgement.gap;
      judgement.explained_share = 0.;
      judgement.verdict         = Verdict::unnamed;
    }
  } // namespace



  Judgement judge(Workspace &workspace, const Model &base)
  {
    const auto tell = [&](const std::string &text) {
      if (workspace.progress)
        workspace.progress(text);
    };
    Judgement result;
    tell("looking for a gap");
    result.view        = score_candidates(workspace, base);
    result.gap         = test_gap(workspace, base, result.view);
    result.remainder   = result.gap;
    result.found.model = base;
    if (result.gap.p > workspace.level)
      {
        const bool is_blind = std::none_of(result.view.candidates.begin(),
                                           result.view.candidates.end(),
                                           [](const CandidateView &seen) {
                                             return seen.minimum_detectable <=
                                                    largest_hidden_change;
                                           });
        result.verdict = is_blind ? Verdict::not_testable : Verdict::no_gap;
        return result;
      }

    tell("looking for its name");
    result.found = search(workspace, base);
    if (result.found.model.parts.empty())
      {
        result.verdict = Verdict::unnamed;
        return result;
      }
    result.remainder =
      test_gap(workspace,
               result.found.model,
               score_candidates(workspace, result.found.model));
    result.explained_share =
      result.gap.excess > 0. ?
        std::clamp(1. - result.remainder.excess / result.gap.excess, 0., 1.) :
        1.;
    result.verdict =
      result.found.rivals.empty() ? Verdict::named : Verdict::ambiguous;
    const auto rms = [&](const Model &model) {
      return relative_rms(workspace.comparison,
                          workspace.comparison.difference(*model.simulator,
                                                          model.scaled));
    };
    const bool is_significant = result.remainder.p <= workspace.level;
    if ((is_significant && result.explained_share < sufficient_share) ||
        result.remainder.excess >
          (1. - least_share) * result.gap.excess + sure_excess ||
        rms(result.found.model) > rms(base) ||
        left_out_gain(workspace, base, result.found.model) <= 0.)
      withdraw(result, base);
    return result;
  }
} // namespace SlipStep
