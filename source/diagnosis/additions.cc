// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/additions.h>
#include <slipstep/diagnosis/confounding.h>
#include <slipstep/diagnosis/refits.h>
#include <slipstep/diagnosis/rules.h>
#include <slipstep/utilities/lists.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace SlipStep
{
  double level_of_round(const Workspace &workspace, const std::size_t round)
  {
    return (round < 2 ? 0.25 : 0.125) * workspace.level;
  }



  bool is_evident(const CandidateView &seen, const double level)
  {
    return seen.candidate.only_beside.empty() && !seen.ways.empty() &&
           seen.p <= level && seen.minimum_detectable <= largest_hidden_change;
  }



  namespace
  {
    /// Additions to one model.
    class Additions
    {
    public:
      Additions(Workspace   &workspace,
                const Model &model,
                const View  &view,
                FirstFits   &notes)
        : workspace(workspace)
        , model(model)
        , view(view)
        , notes(notes)
        , n_effects(effect_names(model.parts).size())
      {}

      std::vector<Model> all();

    private:
      std::vector<Model> single(std::optional<Model> &at_bound);

      void add_beside(const std::optional<Model> &at_bound,
                      std::vector<Model>         &found);

      void add_pairs(std::vector<Model> &found);

      Workspace        &workspace;
      const Model      &model;
      const View       &view;
      FirstFits        &notes;
      const std::size_t n_effects;
    };



    // Those that chance does not explain, fitted. Once there is one, others
    // need no more than the whole level: they may explain the same as well.
    std::vector<Model> Additions::single(std::optional<Model> &at_bound)
    {
      constexpr unsigned int most_tried = 5;

      const double       own   = level_of_round(workspace, n_effects);
      const double       level = any_of(view.candidates,
                                  [&](const CandidateView &seen) {
                                    return is_evident(seen, own);
                                  }) ?
                                   workspace.level :
                                   own;
      std::vector<Model> found;
      unsigned int       n_tried = 0;
      double             gain    = 0.; // of the best
      for (const CandidateView &seen : view.candidates)
        {
          if (!is_evident(seen, level) || n_tried == most_tried)
            continue;
          if (workspace.is_late())
            return {};
          ++n_tried;
          const std::optional<Model> tried = refit_with(
            workspace, model, seen, model.objective - promise_of_rivals(gain));
          if (!tried.has_value() && model.parts.empty())
            notes.lost.push_back(seen.candidate.name);
          // Worse than without it: the fit was lost on its way.
          if (!tried.has_value() || tried->objective > model.objective)
            continue;
          if (model.parts.empty())
            notes.gains.emplace_back(seen.candidate.name,
                                     model.objective - tried->objective);
          if (!is_at_bound(*tried))
            {
              found.push_back(*tried);
              gain = std::max(gain, model.objective - tried->objective);
            }
          else if (!at_bound.has_value() ||
                   tried->objective < at_bound->objective)
            at_bound = tried;
        }
      if (model.parts.empty())
        notes.models = found;
      return found;
    }



    // A fit that ends at a bound, though better than others, may make up for a
    // second effect: tried with those that are seen most beside it.
    void Additions::add_beside(const std::optional<Model> &at_bound,
                               std::vector<Model>         &found)
    {
      constexpr unsigned int most_tried = 3;

      if (!at_bound.has_value() || n_effects + 2 > workspace.most_effects ||
          any_of(found,
                 [&](const Model &other) {
                   return other.objective < at_bound->objective + least_cost;
                 }) ||
          at_bound->objective > model.objective - least_cost ||
          workspace.is_late())
        return;
      const double level   = level_of_round(workspace, n_effects + 1);
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
    void Additions::add_pairs(std::vector<Model> &found)
    {
      constexpr unsigned int most_tried = 3;

      if (n_effects + 2 > workspace.most_effects)
        return;
      const double level  = level_of_round(workspace, n_effects + 1);
      const double more   = (found.empty() ? 1. : 2.) * least_cost;
      double       single = 0.;
      for (const Model &other : found)
        single = std::max(single, model.objective - other.objective);
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
            refit_with_pair(workspace, model, view, pair);
          if (!tried.has_value() && model.parts.empty())
            for (const std::size_t number : {pair.first, pair.second})
              if (const CandidateView &lost =
                    view.of(view.set.directions[number]);
                  lost.is_unstable)
                notes.lost.push_back(lost.candidate.name);
          if (tried.has_value() && !is_at_bound(*tried) &&
              tried->objective < model.objective)
            found.push_back(*tried);
        }
    }



    std::vector<Model> Additions::all()
    {
      if (n_effects >= workspace.most_effects)
        return {};
      std::optional<Model> at_bound;
      std::vector<Model>   found = single(at_bound);
      add_pairs(found);
      add_beside(at_bound, found);
      remove_erase_if(found, [&](const Model &tried) {
        return fits_any_friction(workspace, tried);
      });
      return found;
    }
  } // namespace



  std::vector<Model> fitted_additions(Workspace   &workspace,
                                      const Model &model,
                                      const View  &view,
                                      FirstFits   &notes)
  {
    return Additions(workspace, model, view, notes).all();
  }
} // namespace SlipStep
