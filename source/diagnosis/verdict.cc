// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/confounding.h>
#include <slipstep/diagnosis/outlying_rows.h>
#include <slipstep/diagnosis/verdict.h>
#include <slipstep/diagnosis/ingest.h>
#include <slipstep/diagnosis/left_out.h>
#include <slipstep/diagnosis/localisation.h>
#include <slipstep/diagnosis/refits.h>
#include <slipstep/diagnosis/rules.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/lists.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace SlipStep
{
  namespace
  {
    // Names that leave most of what could be explained are no explanation.
    void withdraw(Judgement &judgement)
    {
      judgement.withdrawn   = effect_names(judgement.found.model.parts);
      judgement.found.model = judgement.base;
      judgement.found.rivals.clear();
      judgement.found.evidence.clear();
      judgement.remainder       = judgement.gap;
      judgement.explained_share = 0.;
      judgement.verdict         = Verdict::unnamed;
      judgement.is_incomplete   = false;
    }



    bool is_too_much(const GapTest &remainder, const GapTest &gap)
    {
      return remainder.excess > (1. - least_share) * gap.excess + gap.slack();
    }



    /// Squares of what could be explained, by groups of rows.
    struct Groups
    {
      std::vector<double> gap, remainder, n_rows;

      void add(const std::size_t group,
               const double      of_gap,
               const double      of_remainder)
      {
        if (group >= gap.size())
          for (auto *values : {&gap, &remainder, &n_rows})
            values->resize(group + 1, 0.);
        gap[group] += of_gap * of_gap;
        remainder[group] += of_remainder * of_remainder;
        n_rows[group] += 1.;
      }
    };



    double sum_of(const std::vector<double> &values)
    {
      return std::accumulate(values.begin(), values.end(), 0.);
    }



    // Whether most of what remains is in few of the rows, and nearly all that
    // was there is explained in the others.
    bool is_local(const Groups &groups, const Judgement &judgement)
    {
      constexpr double most = 0.7, few = 0.3;

      std::vector<std::size_t> order(groups.gap.size());
      std::iota(order.begin(), order.end(), 0);
      sort(order, [&](const std::size_t a, const std::size_t b) {
        return groups.remainder[a] > groups.remainder[b];
      });
      const double n_all         = sum_of(groups.n_rows);
      const double chance_of_gap = sum_of(groups.gap) - judgement.gap.excess;
      const double chance_of_remainder =
        sum_of(groups.remainder) - judgement.remainder.excess;
      double in_few = 0., n = 0., gap = judgement.gap.excess;
      double left = judgement.remainder.excess;
      for (const std::size_t group : order)
        {
          if (in_few > most * sum_of(groups.remainder))
            break;
          const double share = groups.n_rows[group] / n_all;
          in_few += groups.remainder[group];
          n += share;
          gap -= groups.gap[group] - share * chance_of_gap;
          left -= groups.remainder[group] - share * chance_of_remainder;
        }
      return n < few && gap > sure_excess &&
             left < (1. - sufficient_share) * gap;
    }



    bool remains_in_few_rows(const Workspace &workspace,
                             const Judgement &judgement)
    {
      if (judgement.gap.explained.size() == 0 ||
          judgement.remainder.explained.size() == 0)
        return false;
      Groups conditions, phases;
      for (const ComparedTest &test : workspace.comparison.tests)
        for (Eigen::Index i = test.begin; i < test.begin + test.size; ++i)
          {
            const double gap       = judgement.gap.explained(i);
            const double remainder = judgement.remainder.explained(i);
            conditions.add(test.condition, gap, remainder);
            phases.add(static_cast<std::size_t>(workspace.covariates.phase[i]),
                       gap,
                       remainder);
          }
      return is_local(conditions, judgement) || is_local(phases, judgement);
    }



    // Without what completes their formulas, names have to explain most by
    // themselves: a free function along a covariate explains anything there.
    bool explains_by_itself(Workspace &workspace, const Judgement &judgement)
    {
      const Model &model = judgement.found.model;
      for (std::size_t part = 0; part < model.parts.size(); ++part)
        {
          if (model.parts[part].corrects.empty())
            continue;
          const std::optional<Model> bare =
            refit_without(workspace, model, part);
          if (!bare.has_value() ||
              is_too_much(
                test_gap(workspace, *bare, score_candidates(workspace, *bare)),
                judgement.gap))
            return false;
        }
      return true;
    }



    // Whether a model is farther from the tests than another in their plain
    // differences, and by more than noise makes it: where a right model changes
    // d, squares rise by -d^2 - 2 d n, n being noise.
    bool is_farther(const Workspace       &workspace,
                    const Comparison      &comparison,
                    const Eigen::VectorXd &differences_before,
                    const Eigen::VectorXd &differences_after)
    {
      constexpr unsigned int n_draws = 100;
      constexpr double       clearly = 3.; // standard deviations

      Eigen::VectorXd after  = differences_after;
      Eigen::VectorXd change = after - differences_before;
      RowMatrix       noise  = draw_noise(comparison,
                                   workspace.noise,
                                   n_draws,
                                   workspace.start.integer("Diagnosis/Seed"));
      for (const ComparedTest &test : comparison.tests)
        {
          after.segment(test.begin, test.size) /= test.level;
          change.segment(test.begin, test.size) /= test.level;
          noise.middleRows(test.begin, test.size) /= test.level;
        }
      const double squares = change.squaredNorm();
      const double rise    = 2. * after.dot(change) - squares;
      const double scatter =
        2. * (noise.transpose() * change).norm() / std::sqrt(1. * n_draws);
      return rise > std::max(0., clearly * scatter - squares);
    }



    // Fitted, or under conditions that were left out of the fit.
    bool is_farther(const Workspace &workspace,
                    const Model     &base,
                    const Model     &model)
    {
      // A hum has been taken off.
      Comparison comparison = workspace.comparison;
      for (ComparedTest &test : comparison.tests)
        for (Series &series : test.series)
          series.hum.clear();
      if (is_farther(workspace,
                     comparison,
                     comparison.difference(base),
                     comparison.difference(model)))
        return true;
      Eigen::VectorXd before, after;
      left_out(workspace, base, &before);
      left_out(workspace, model, &after);
      const std::vector<bool> judges =
        evidence_for(workspace, base, model).judges;
      for (const ComparedTest &test : comparison.tests)
        if (!judges[test.condition])
          for (Eigen::VectorXd *differences : {&before, &after})
            differences->segment(test.begin, test.size).setZero();
      return is_farther(workspace, comparison, before, after);
    }



    // Whether an effect that would make sliding jump was left out, and what
    // remains goes with speed: what others took up of it is no evidence for
    // them.
    bool has_untried(const Workspace &workspace, const Judgement &judgement)
    {
      constexpr double much = 0.2;

      const Model &model = judgement.found.model;
      const View   view  = score_candidates(workspace, model);
      if (none_of(view.candidates,
                  [](const CandidateView &seen) { return seen.is_unstable; }))
        return false;
      return judgement.remainder.excess > sure_excess &&
             any_of(localise(workspace, model, judgement.remainder),
                    [](const Localisation &place) {
                      return place.covariate == "speed" && place.share > much;
                    });
    }



    // Whether names explain enough to be told.
    bool are_sufficient(Workspace &workspace, Judgement &judgement)
    {
      const Model &model = judgement.found.model;
      const Model &base  = judgement.base;
      if (is_at_bound(model) || is_farther(workspace, base, model) ||
          evidence_for(workspace, base, model).left_out_gain <= 0. ||
          !explains_by_itself(workspace, judgement))
        return false;
      judgement.is_incomplete = judgement.remainder.p <= workspace.level;
      if (judgement.is_incomplete && has_untried(workspace, judgement))
        return false;
      const bool is_enough = !(judgement.is_incomplete &&
                               judgement.explained_share < sufficient_share) &&
                             !is_too_much(judgement.remainder, judgement.gap);
      return is_enough || remains_in_few_rows(workspace, judgement);
    }



    // What follows the tests only by the details of a formula that does not
    // follow them to the noise is no better than another.
    void look_for_confounded(const Workspace &workspace, Judgement &judgement)
    {
      judgement.confounded =
        confounded_effects(workspace, judgement.base, judgement.found);
      if (!judgement.is_incomplete)
        return;
      std::vector<Rival> &rivals = judgement.found.rivals;
      rivals.insert(rivals.end(),
                    judgement.confounded.begin(),
                    judgement.confounded.end());
      if (!judgement.confounded.empty())
        judgement.verdict = Verdict::ambiguous;
    }



    void look_for_gap(Workspace &workspace, Judgement &judgement)
    {
      workspace.range.track_wave =
        clear_track_wave(workspace, judgement.base).wavelength;
      judgement.view = score_candidates(workspace, judgement.base);
      // That no gap is seen says nothing of what was not scored.
      workspace.was_late =
        workspace.was_late ||
        any_of(judgement.view.candidates,
               [](const CandidateView &seen) { return seen.is_late; });
      judgement.gap       = test_gap(workspace, judgement.base, judgement.view);
      judgement.remainder = judgement.gap;
      judgement.found.model = judgement.base;
    }



    // Nothing is missing, or nothing would have been seen.
    Verdict without_gap(const View &view)
    {
      return any_of(view.candidates,
                    [](const CandidateView &seen) {
                      return seen.minimum_detectable <= largest_hidden_change;
                    }) ?
               Verdict::no_gap :
               Verdict::not_testable;
    }



    void look_for_names(Workspace   &workspace,
                        Judgement   &judgement,
                        const Model &first)
    {
      judgement.found = search(workspace, first);
      if (judgement.found.model.parts.empty())
        {
          judgement.verdict = Verdict::unnamed;
          return;
        }
      judgement.remainder =
        test_gap(workspace,
                 judgement.found.model,
                 score_candidates(workspace, judgement.found.model));
      judgement.explained_share =
        judgement.gap.excess > 0. ?
          std::clamp(1. - judgement.remainder.excess / judgement.gap.excess,
                     0.,
                     1.) :
          1.;
      judgement.verdict =
        judgement.found.rivals.empty() ? Verdict::named : Verdict::ambiguous;
    }



    // A few bad rows shall neither make a gap nor withdraw a right name: once
    // more, from what was found on, with those that it does not explain
    // counting for less. If that cannot be fitted, they count as before.
    void judge_without_outliers(Workspace &workspace, Judgement &judgement)
    {
      if (workspace.is_late())
        return;
      Workspace weakened = workspace;
      Judgement again;
      again.outlying = weaken_outlying_rows(weakened, judgement.found.model);
      if (again.outlying.empty())
        return;
      again.base  = judgement.base.copy();
      Model first = judgement.found.model.copy();
      if (!weakened.comparison.fit(again.base, 0.01) ||
          !weakened.comparison.fit(first, 0.01))
        return;
      // Far off, a fit may have lost the tests for the sake of few rows.
      const auto rms = [&](const Model &model) {
        return relative_rms(weakened.comparison, model);
      };
      if (rms(again.base) > lost_fit * rms(judgement.base))
        return;
      look_for_gap(weakened, again);
      if (again.gap.p <= weakened.level)
        {
          look_for_names(weakened, again, first);
          if (again.found.first_fits.gains.empty())
            again.found.first_fits = judgement.found.first_fits;
        }
      else
        {
          again.verdict = without_gap(again.view);
          again.named_by_outliers =
            judgement.withdrawn.empty() ?
              effect_names(judgement.found.model.parts) :
              judgement.withdrawn;
        }
      workspace.was_late    = weakened.was_late;
      workspace.was_stopped = weakened.was_stopped;
      workspace.n_refits    = weakened.n_refits;
      // Rows far from what explains nothing are no fault of theirs.
      if (judgement.found.model.parts.empty() &&
          again.verdict == Verdict::unnamed)
        return;
      workspace = std::move(weakened);
      judgement = again;
    }



    void settle_names(Workspace &workspace, Judgement &judgement)
    {
      if (judgement.found.model.parts.empty())
        return;
      if (!are_sufficient(workspace, judgement))
        withdraw(judgement);
      else if (!workspace.is_late())
        look_for_confounded(workspace, judgement);
    }
  } // namespace



  Judgement judge(Workspace &workspace, const Model &base)
  {
    Judgement result;
    result.base = base;
    workspace.tell("looking for a gap");
    look_for_gap(workspace, result);
    if (result.gap.p > workspace.level)
      {
        result.verdict = without_gap(result.view);
        return result;
      }

    workspace.tell("looking for its name");
    look_for_names(workspace, result, result.base);
    workspace.tell("looking for rows that nothing explains");
    const auto finish = [&]() {
      judge_without_outliers(workspace, result);
      settle_names(workspace, result);
      // A name that was withdrawn may have followed spikes.
      if (!result.withdrawn.empty() && result.outlying.empty())
        {
          judge_without_outliers(workspace, result);
          settle_names(workspace, result);
        }
    };
    try
      {
        finish();
      }
    catch (const RunError &)
      {
        workspace.end_by_signal();
        finish();
      }
    return result;
  }
} // namespace SlipStep
