// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/free_factor.h>
#include <slipstep/diagnosis/gap.h>
#include <slipstep/diagnosis/search.h>
#include <slipstep/diagnosis/left_out.h>
#include <slipstep/diagnosis/refits.h>
#include <slipstep/diagnosis/rules.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/lists.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace SlipStep
{
  double level_of_round(const Workspace &workspace, const std::size_t round)
  {
    // Halves, and in the last round what is left.
    const std::size_t last = std::max(1u, workspace.most_effects) - 1;
    return workspace.level *
           std::pow(0.5, std::min(round, last) + (round < last ? 1. : 0.));
  }



  bool is_evident(const CandidateView &seen, const double level)
  {
    return seen.candidate.only_beside.empty() && !seen.ways.empty() &&
           seen.score.value > 0. && seen.p <= level &&
           seen.minimum_detectable <= largest_hidden_change;
  }



  bool
  is_needed(const double cost, const double left_out_gain, const std::size_t n)
  {
    return std::isnan(left_out_gain) ?
             cost >= n * sure_cost :
             cost >= n * least_cost && left_out_gain > 0.;
  }



  namespace
  {
    /// The search, step by step.
    class Searcher
    {
    public:
      Searcher(Workspace &workspace, const Model &first)
        : workspace(workspace)
      {
        result.model = first;
      }

      SearchResult run();

    private:
      void extend(SearchResult &proven);

      bool add();

      void leave_wave(const TrackWave &wave, View &view) const;

      std::vector<Model> single_additions(const View           &view,
                                          std::optional<Model> &at_bound);

      void add_beside(const std::optional<Model> &at_bound,
                      std::vector<Model>         &found);

      void add_pairs(const View &view, std::vector<Model> &found);

      std::size_t n_effects() const
      {
        return effect_names(result.model.parts).size();
      }

      double level() const;

      bool exchange_and_prune();

      bool is_soaking_up(const unsigned int n_allowed);

      void prove();

      void drop_weakest();

      void refit_final();

      bool examine(const std::size_t part);

      bool try_rivals(const Model &less, const Part part, const double cost);

      Workspace   &workspace;
      SearchResult result;
    };



    // What is left of the level for the part added last, or its rivals.
    double Searcher::level() const
    {
      return level_of_round(workspace,
                            std::max<std::size_t>(1, n_effects()) - 1);
    }



    // A clear wave along the track that stays beside a texture is another one,
    // for which there is no second name: what is less clear may be a part of
    // it.
    void Searcher::leave_wave(const TrackWave &wave, View &view) const
    {
      if (!result.model.has("texture") || !(wave.wavelength > 0.))
        return;
      for (CandidateView &seen : view.candidates)
        if (seen.score.value < wave.score)
          seen.p = 1.;
      for (ScoreTest::Pair &pair : view.pairs)
        if (pair.gain < wave.score * wave.score)
          pair.p = 1.;
    }



    // Those that chance does not explain, fitted.
    std::vector<Model>
    Searcher::single_additions(const View &view, std::optional<Model> &at_bound)
    {
      constexpr unsigned int most_tried = 5;

      const double       level = level_of_round(workspace, n_effects());
      std::vector<Model> found;
      unsigned int       n_tried = 0;
      for (const CandidateView &seen : view.candidates)
        {
          if (!is_evident(seen, level) || n_tried == most_tried)
            continue;
          if (workspace.is_late())
            return {};
          ++n_tried;
          const std::optional<Model> tried =
            refit_with(workspace, result.model, seen);
          if (!tried.has_value() && result.model.parts.empty())
            result.lost.push_back(seen.candidate.name);
          // Worse than without it: the fit was lost on its way.
          if (!tried.has_value() || tried->objective > result.model.objective)
            continue;
          if (result.model.parts.empty())
            result.gains.emplace_back(seen.candidate.name,
                                      result.model.objective -
                                        tried->objective);
          if (!is_at_bound(*tried))
            found.push_back(*tried);
          else if (!at_bound.has_value() ||
                   tried->objective < at_bound->objective)
            at_bound = tried;
        }
      return found;
    }



    // A fit that ends at a bound, though better than others, may make up for a
    // second effect: tried with those that are seen most beside it.
    void Searcher::add_beside(const std::optional<Model> &at_bound,
                              std::vector<Model>         &found)
    {
      constexpr unsigned int most_tried = 3;

      if (!at_bound.has_value() || n_effects() + 2 > workspace.most_effects ||
          any_of(found,
                 [&](const Model &other) {
                   return other.objective < at_bound->objective + least_cost;
                 }) ||
          at_bound->objective > result.model.objective - least_cost ||
          workspace.is_late())
        return;
      const double level   = level_of_round(workspace, n_effects() + 1);
      const View   view    = score_candidates(workspace, *at_bound);
      unsigned int n_tried = 0;
      for (const CandidateView &seen : view.candidates)
        {
          if (!is_evident(seen, level) || n_tried == most_tried ||
              workspace.is_late())
            continue;
          ++n_tried;
          const std::optional<Model> tried =
            refit_with(workspace, *at_bound, seen);
          if (tried.has_value() && !is_at_bound(*tried) &&
              tried->objective < at_bound->objective)
            found.push_back(*tried);
        }
    }



    // Two effects that nearly cancel each other, where they promise more than
    // each alone: by far if one is seen alone, as the formula of that may not
    // be quite right. They have the share of the level of the second of them.
    void Searcher::add_pairs(const View &view, std::vector<Model> &found)
    {
      constexpr unsigned int most_tried = 3;

      if (n_effects() + 2 > workspace.most_effects)
        return;
      const double level  = level_of_round(workspace, n_effects() + 1);
      const double more   = (found.empty() ? 1. : 2.) * least_cost;
      double       single = 0.;
      for (const Model &model : found)
        single = std::max(single, result.model.objective - model.objective);
      for (const CandidateView &seen : view.candidates)
        if (seen.candidate.only_beside.empty() && seen.score.value > 0.)
          single =
            std::max(single,
                     std::pow(seen.score.strength * seen.score.free_length, 2));
      unsigned int                                     n_tried = 0;
      std::vector<std::pair<std::size_t, std::size_t>> seen;
      for (const ScoreTest::Pair &pair : view.pairs)
        {
          if (pair.p > level ||
              pair.gain < std::max(single + more, 2. * least_cost) ||
              n_tried == most_tried || workspace.is_late())
            continue;
          const std::pair<std::size_t, std::size_t> names =
            std::minmax(view.set.directions[pair.first].candidate,
                        view.set.directions[pair.second].candidate);
          if (holds(seen, names))
            continue;
          seen.push_back(names);
          ++n_tried;
          const std::optional<Model> tried =
            refit_with_pair(workspace, result.model, view, pair);
          if (!tried.has_value() && result.model.parts.empty())
            for (const std::size_t number : {pair.first, pair.second})
              if (const CandidateView &lost =
                    view.of(view.set.directions[number]);
                  lost.is_unstable)
                result.lost.push_back(lost.candidate.name);
          if (tried.has_value() && !is_at_bound(*tried) &&
              tried->objective < result.model.objective)
            found.push_back(*tried);
        }
    }



    // The best of those that predict conditions left out better than without
    // them. Before another effect has a name, the formulas of those that have
    // one are completed: what that explains is no second effect.
    bool Searcher::add()
    {
      const TrackWave wave       = clear_track_wave(workspace, result.model);
      workspace.range.track_wave = wave.wavelength;
      View view                  = score_candidates(workspace, result.model);
      leave_wave(wave, view);
      std::vector<Model> found;
      if (n_effects() < workspace.most_effects)
        {
          std::optional<Model> at_bound;
          found = single_additions(view, at_bound);
          add_pairs(view, found);
          add_beside(at_bound, found);
        }
      stable_sort(found, [](const Model &a, const Model &b) {
        return penalised(a) < penalised(b);
      });
      if (workspace.is_late())
        return false;
      const std::optional<FreeFactor> completed =
        complete_formula(workspace, result.model);
      const auto is_good = [&](const Model &more) {
        return is_needed(result.model.objective - more.objective,
                         left_out_gain(workspace, result.model, more),
                         more.parts.size() - result.model.parts.size());
      };
      for (Model &best : found)
        {
          if (completed.has_value() &&
              best.objective > completed->model.objective - rival_distance)
            continue;
          if (!is_good(best))
            continue;
          const std::size_t n = result.model.parts.size();
          result.model        = best;
          settle(workspace, result.model);
          for (std::size_t part = n; part < result.model.parts.size(); ++part)
            workspace.tell("added " + result.model.parts[part].name);
          return true;
        }
      // What leaves nothing of an effect does not complete its formula.
      if (!completed.has_value() || is_at_bound(completed->model) ||
          !is_good(completed->model))
        return false;
      result.model = completed->model;
      settle(workspace, result.model);
      workspace.tell("completed the " + result.model.parts.back().name);
      return true;
    }



    // Without one of the parts: what that costs, and whether another effect
    // does better in its place. Returns whether the model has changed.
    bool Searcher::examine(const std::size_t part)
    {
      const std::string          name = result.model.parts[part].name;
      const std::optional<Model> less =
        refit_without(workspace, result.model, part);
      if (!less.has_value())
        {
          result.costs.push_back(std::numeric_limits<double>::infinity());
          result.left_out_gains.push_back(0.);
          result.told_by.emplace_back();
          return false;
        }
      const double cost = less->objective - result.model.objective;
      const double gain = left_out_gain(workspace, *less, result.model);
      if (!is_needed(cost, gain))
        {
          result.model = *less;
          return true;
        }
      result.costs.push_back(cost);
      result.left_out_gains.push_back(gain);
      result.told_by.push_back(
        conditions_that_tell(workspace, *less, result.model));
      return result.model.parts[part].corrects.empty() &&
             try_rivals(*less, result.model.parts[part], cost);
    }



    // An effect may have several forms, which its settings, texts and bounds
    // tell apart.
    bool is_same_formula(const TrialFormula &a, const TrialFormula &b)
    {
      return a.effect == b.effect && a.settings == b.settings &&
             a.texts == b.texts &&
             std::equal(a.parameters.begin(),
                        a.parameters.end(),
                        b.parameters.begin(),
                        b.parameters.end(),
                        [](const CandidateParameter &x,
                           const CandidateParameter &y) {
                          return x.path == y.path && x.lower == y.lower &&
                                 x.upper == y.upper;
                        });
    }



    // In the place of a name, or another formula of it. Returns whether one
    // takes it.
    bool
    Searcher::try_rivals(const Model &less, const Part part, const double cost)
    {
      constexpr unsigned int most_rivals = 4;

      const View   view    = score_candidates(workspace, less);
      unsigned int n_tried = 0;
      for (const CandidateView &seen : view.candidates)
        {
          const double promised =
            std::pow(seen.score.strength * seen.score.free_length, 2);
          const bool is_same = seen.candidate.name == part.name;
          if (!is_evident(seen, level()) ||
              promised < promising_share * cost - promising_slack ||
              n_tried == most_rivals ||
              (is_same && seen.candidate.formulas.size() < 2))
            continue;
          if (workspace.is_late())
            return false;
          ++n_tried;
          std::optional<Model> tried = refit_with(workspace, less, seen);
          if (!tried.has_value() || is_at_bound(*tried) ||
              is_same_formula(tried->parts.back().formula, part.formula))
            continue;
          // What is better only while its steps are another's would have to
          // give way again.
          if (penalised(*tried) < penalised(result.model) - sure_gain)
            settle(workspace, *tried);
          const double distance = penalised(*tried) - penalised(result.model);
          if (distance >= rival_distance ||
              !is_needed(less.objective - tried->objective,
                         left_out_gain(workspace, less, *tried)))
            continue;
          if (distance < -sure_gain)
            {
              result.model = *tried;
              return true;
            }
          if (!is_same)
            result.rivals.push_back(
              {seen.candidate.name, part.name, distance, *tried});
        }
      return false;
    }



    bool Searcher::exchange_and_prune()
    {
      result.rivals.clear();
      result.costs.clear();
      result.left_out_gains.clear();
      result.told_by.clear();
      for (std::size_t part = 0; part < result.model.parts.size(); ++part)
        if (workspace.is_late())
          return false;
        else if (examine(part))
          return true;
      return false;
    }



    // Each name gains less than the one before it. If those that are still
    // allowed could not explain what remains, the formula of a stronger name is
    // not the right one, and the weakest takes up what that leaves.
    bool Searcher::is_soaking_up(const unsigned int n_allowed)
    {
      if (result.model.parts.size() < 2 ||
          result.costs.size() < result.model.parts.size())
        return false;
      const GapTest remainder =
        test_gap(workspace,
                 result.model,
                 score_candidates(workspace, result.model));
      const double least =
        *std::min_element(result.costs.begin(), result.costs.end());
      return remainder.p <= workspace.level &&
             remainder.excess > (n_allowed + 1) * least + sure_excess;
    }



    void Searcher::prove()
    {
      workspace.tell("proving");
      for (unsigned int n = 0; n < 6; ++n)
        if (!exchange_and_prune())
          break;
    }



    void Searcher::drop_weakest()
    {
      const auto weakest =
        std::min_element(result.costs.begin(), result.costs.end());
      const std::optional<Model> less =
        refit_without(workspace, result.model, weakest - result.costs.begin());
      if (less.has_value())
        {
          result.model = *less;
          settle(workspace, result.model);
        }
    }



    // From several starts; costs and rivals are those of the better optimum.
    void Searcher::refit_final()
    {
      if (result.model.parts.empty())
        return;
      const double before = result.model.objective;
      result.model        = refit_from_starts(workspace, result.model);
      if (result.model.objective < before - sure_gain)
        prove();
    }



    // One name after the other.
    void Searcher::extend(SearchResult &proven)
    {
      // One more, to complete a formula.
      for (unsigned int round = 0; round <= workspace.most_effects; ++round)
        {
          const std::size_t n = result.model.parts.size();
          if (!add())
            break;
          prove();
          if (workspace.is_late())
            break;
          // What was added and taken away again would come back.
          if (result.model.parts.size() <= n)
            break;
          if (is_soaking_up(workspace.most_effects - n_effects()))
            break;
          proven = result;
        }
      while (!workspace.is_late() && is_soaking_up(0))
        {
          const std::size_t n = result.model.parts.size();
          drop_weakest();
          if (result.model.parts.size() == n)
            break;
          prove();
        }
      if (!workspace.was_late)
        {
          refit_final();
          proven = result;
        }
    }



    SearchResult Searcher::run()
    {
      if (!result.model.parts.empty())
        prove();
      SearchResult proven = result;
      try
        {
          extend(proven);
        }
      catch (const RunError &)
        {
          // Ctrl-C leaves what is proven, if anything is.
          if (proven.model.parts.empty())
            throw;
          workspace.end_by_signal();
        }
      proven.gains = result.gains;
      proven.lost  = result.lost;
      return proven;
    }
  } // namespace



  SearchResult search(Workspace &workspace, const Model &first)
  {
    return Searcher(workspace, first).run();
  }
} // namespace SlipStep
