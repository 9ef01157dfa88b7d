// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/findings.h>
#include <slipstep/diagnosis/next_test.h>
#include <slipstep/diagnosis/rules.h>
#include <slipstep/utilities/lists.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace SlipStep
{
  namespace
  {
    std::string why_not_testable(const CandidateView &seen)
    {
      if (seen.ways.empty())
        return "it would change nothing in these tests";
      if (seen.score.free_length <= 0.)
        return "its effect cannot be told from that of the fitted parameters";
      return "only a change of friction by more than a quarter would be seen";
    }
    // What was seen of a candidate from the starting model.
    CandidateResult seen_result(const CandidateView &seen,
                                const Judgement     &judgement,
                                const double         level)
    {
      CandidateResult result;
      result.name               = seen.candidate.name;
      result.signature          = seen.candidate.signature;
      result.score              = seen.score.value;
      result.p                  = seen.p;
      result.minimum_detectable = seen.minimum_detectable;
      result.is_testable        = seen.candidate.why_not.empty() &&
                           seen.minimum_detectable <= largest_hidden_change;
      for (const auto &gain : judgement.found.first_fits.gains)
        if (gain.first == result.name)
          result.gain = gain.second;
      if (!seen.candidate.why_not.empty())
        {
          result.why      = seen.candidate.why_not;
          result.standing = seen.candidate.is_in_model ?
                              Standing::in_the_model :
                              Standing::not_testable;
        }
      else if (seen.is_late)
        {
          result.why      = "time was over before it was looked at";
          result.standing = Standing::not_tried;
        }
      else if ((!seen.failure.empty() &&
                (seen.ways.empty() || seen.p <= level)) ||
               holds(judgement.found.first_fits.lost, result.name))
        {
          result.why      = seen.failure.empty() ?
                              "no fit with it could be simulated" :
                              seen.failure;
          result.standing = Standing::not_simulated;
        }
      else if (!result.is_testable)
        {
          result.why      = why_not_testable(seen);
          result.standing = Standing::not_testable;
        }
      else
        result.standing = result.p > level ? Standing::rejected :
                          judgement.found.model.parts.empty() ?
                                             Standing::not_enough :
                                             Standing::not_needed;
      return result;
    }



    // What the search made of it.
    void add_found(const SearchResult                    &found,
                   const std::vector<DiagnosedParameter> &parameters,
                   const double                           level,
                   CandidateResult                       &result)
    {
      for (const Rival &rival : found.rivals)
        if (rival.name == result.name)
          result.standing = Standing::rival;
      for (std::size_t part = 0; part < found.model.parts.size(); ++part)
        {
          if (found.model.parts[part].name != result.name)
            continue;
          result.standing = Standing::named;
          // Seen beside another name only: the chance of what it does alone
          // says nothing.
          if (result.p > level)
            result.p = std::numeric_limits<double>::quiet_NaN();
          result.is_testable = true;
          if (part < found.evidence.size())
            {
              result.gain          = found.evidence[part].cost;
              result.left_out_gain = found.evidence[part].left_out_gain;
            }
          for (const DiagnosedParameter &parameter : parameters)
            if (parameter.effect == result.name)
              result.parameters.push_back(parameter);
        }
    }



    // What is seen, but was not held against all others.
    void leave_undecided(const SearchResult &found, CandidateResult &result)
    {
      const bool is_seen = result.standing == Standing::not_enough ||
                           result.standing == Standing::not_needed;
      if (!is_seen ||
          (!found.model.parts.empty() && std::isfinite(result.gain)))
        return;
      result.standing = Standing::undecided;
      result.why      = "time was over before it was judged";
    }



    // Of the table: what was not tried comes last.
    Standing rank(const CandidateResult &result)
    {
      return std::min(result.standing, Standing::not_testable);
    }
  } // namespace



  std::vector<CandidateResult>
  candidate_results(const Workspace                       &workspace,
                    const Judgement                       &judgement,
                    const std::vector<DiagnosedParameter> &parameters,
                    const Model                           &base)
  {
    std::vector<CandidateResult> results(judgement.view.candidates.size());
    side_by_side(results.size(), [&](const std::size_t c) {
      const CandidateView &seen = judgement.view.candidates[c];
      results[c]                = seen_result(seen, judgement, workspace.level);
      add_found(judgement.found, parameters, workspace.level, results[c]);
      if (workspace.was_late)
        leave_undecided(judgement.found, results[c]);
      if (results[c].standing == Standing::not_testable &&
          !seen.candidate.formulas.empty())
        {
          Model own = base.copy();
          results[c].cheapest_test =
            cheapest_test(workspace, own, seen.candidate);
        }
    });
    stable_sort(results,
                [](const CandidateResult &a, const CandidateResult &b) {
                  return rank(a) != rank(b) ? rank(a) < rank(b) :
                                              a.score > b.score;
                });
    return results;
  }
} // namespace SlipStep
