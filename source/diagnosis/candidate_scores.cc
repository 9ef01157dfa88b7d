// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/candidate_scores.h>
#include <slipstep/experiment/stability.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/lists.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace SlipStep
{
  std::vector<Part> with_part(std::vector<Part> parts,
                              const Candidate  &candidate,
                              const std::size_t formula)
  {
    parts.push_back({candidate.name, candidate.formulas[formula]});
    return parts;
  }



  Values merged(Values values, const Values &others)
  {
    for (const auto &value : others)
      values[value.first] = value.second;
    return values;
  }



  namespace
  {
    // Scores are of this many standard deviations when an effect counts as
    // seen.
    constexpr double seen_deviations = 5.;



    // What a candidate is seen from: a model, or that with an effect beside it.
    struct Ground
    {
      std::vector<Part> parts;
      Values            values;

      Parameters parameters(const Workspace &workspace) const
      {
        return assemble(workspace.start, parts, values).parameters;
      }
    };



    // Why sliding at the speeds of the tests is not stable on this ground, ""
    // if it is, or is not on the one below, either.
    std::string why_unstable(const Workspace &workspace,
                             const Ground    &below,
                             const Ground    &ground)
    {
      const auto why = [&](const Parameters &parameters) {
        const TestedRange &range = workspace.range;
        return why_no_branch(FrictionLaw(parameters),
                             {range.slowest,
                              std::sqrt(range.slowest * range.fastest),
                              range.fastest},
                             range.highest);
      };
      const std::string with_it = why(ground.parameters(workspace));
      return with_it.empty() || why(below.parameters(workspace)).empty() ?
               with_it :
               "";
    }



    // Changes of friction by one formula of a candidate at unit strength, or
    // why there are none, if it cannot be simulated.
    void add_directions(const Workspace        &workspace,
                        const Model            &model,
                        const Ground           &ground,
                        const Candidate        &candidate,
                        const std::size_t       candidate_number,
                        const std::size_t       formula_number,
                        std::vector<Direction> &directions,
                        CandidateView          &seen)
    {
      const TrialFormula     &formula = candidate.formulas[formula_number];
      const std::vector<Part> parts =
        with_part(ground.parts, candidate, formula_number);
      try
        {
          const Values unity =
            merged(ground.values,
                   formula.shapes[formula.shapes.size() / 2](1.));
          if (const std::string why =
                formula.along == "log10 speed" ?
                  why_unstable(workspace, ground, {parts, unity}) :
                  "";
              !why.empty())
            {
              seen.failure     = why;
              seen.is_unstable = true;
              return;
            }
          const Model trial = make_coarse_model(
            workspace.start, parts, unity, workspace.tests, &model);
          trial.simulator->subtract(ground.parameters(workspace));
          for (std::size_t s = 0; s < formula.shapes.size(); ++s)
            {
              const Values values =
                merged(ground.values, formula.shapes[s](1.));
              std::vector<double> scaled;
              for (const FitParameter &parameter : trial.campaign->fitted)
                scaled.push_back(std::clamp(
                  parameter.to_scaled(values.at(parameter.path)), 0., 1.));
              const Eigen::VectorXd there =
                workspace.comparison.difference(*trial.simulator, scaled);
              if (there.size() == 0)
                continue;
              Direction direction;
              direction.friction     = there + workspace.comparison.measured;
              direction.is_one_sided = formula.is_one_sided;
              direction.candidate    = candidate_number;
              direction.formula      = formula_number;
              direction.shape        = s;
              directions.push_back(direction);
            }
        }
      catch (const InputError &error)
        {
          seen.failure = error.what();
        }
      catch (const RunError &error)
        {
          throw_if_stopped();
          seen.failure = error.what();
        }
    }



    // Keep the best direction of every formula.
    void keep_best(std::vector<CandidateView::Way> &ways,
                   const CandidateView::Way        &way)
    {
      for (CandidateView::Way &other : ways)
        if (other.direction.formula == way.direction.formula)
          {
            if (way.score.value > other.score.value)
              other = way;
            return;
          }
      ways.push_back(way);
    }



    // Below this share of the friction, greatest over the rows, nothing but
    // round-off and time steps are seen.
    constexpr double least_change = 1e-5;



    // With a candidate that holds it beside it, as strong as holds any trial.
    std::optional<Ground> held_ground(const Ground                 &ground,
                                      const Candidate              &candidate,
                                      const std::vector<Candidate> &candidates)
    {
      constexpr double strong = 5.;

      for (const Candidate &other : candidates)
        if (other.name == candidate.held_by && !other.formulas.empty())
          {
            const TrialFormula &formula = other.formulas.front();
            return Ground{with_part(ground.parts, other, 0),
                          merged(ground.values,
                                 formula.shapes[formula.shapes.size() / 2](
                                   strong))};
          }
      return {};
    }



    // What the catalogue would change, without scores yet.
    View find_directions(const Workspace &workspace, const Model &model)
    {
      const std::vector<Candidate> candidates =
        make_candidates(model.simulator->with(model.scaled),
                        workspace.range,
                        model.campaign->fitted);
      std::vector<std::vector<Direction>> found(candidates.size());
      View                                view;
      view.candidates.resize(candidates.size());
      side_by_side(candidates.size(), [&](const std::size_t c) {
        CandidateView &seen = view.candidates[c];
        seen.candidate      = candidates[c];
        seen.number         = c;
        seen.is_late = std::chrono::steady_clock::now() > workspace.deadline;
        if (seen.is_late)
          return;
        Model      own          = model.copy();
        const auto see_all_from = [&](const Ground &ground) {
          for (std::size_t f = 0; f < candidates[c].formulas.size(); ++f)
            add_directions(
              workspace, own, ground, candidates[c], c, f, found[c], seen);
        };
        const Ground ground{model.parts, model.values()};
        see_all_from(ground);
        if (!seen.is_unstable || !found[c].empty())
          return;
        if (const auto held = held_ground(ground, candidates[c], candidates))
          {
            see_all_from(*held);
            seen.candidate.only_beside = candidates[c].held_by;
          }
      });
      for (std::size_t c = 0; c < candidates.size(); ++c)
        {
          for (const Direction &direction : found[c])
            if (direction.friction.cwiseAbs().maxCoeff() >
                least_change * workspace.range.typical_friction)
              view.set.directions.push_back(direction);
          // By one formula at least it can be, alone.
          if (!found[c].empty() && view.candidates[c].candidate.only_beside ==
                                     candidates[c].only_beside)
            {
              view.candidates[c].failure     = "";
              view.candidates[c].is_unstable = false;
            }
        }
      view.set = DirectionSet(workspace.comparison,
                              workspace.null_draws,
                              view.set.directions);
      return view;
    }



    void see(const Direction &direction,
             const Score     &score,
             const double     typical_friction,
             CandidateView   &seen)
    {
      keep_best(seen.ways, {direction, score});
      if (score.free_length > 0.)
        seen.minimum_detectable =
          std::min(seen.minimum_detectable,
                   seen_deviations * score.deviation / score.free_length *
                     direction.friction.cwiseAbs().maxCoeff() /
                     typical_friction);
    }
  } // namespace



  Pairing pairing(const Candidate &a, const Candidate &b)
  {
    if (a.only_beside.empty() && b.only_beside.empty())
      return Pairing::if_opposed;
    return a.only_beside == b.name || b.only_beside == a.name ?
             Pairing::always :
             Pairing::never;
  }



  namespace
  {
    View with_scores(const Workspace &workspace, const Model &model, View view)
    {
      if (view.set.directions.empty())
        return view;
      const ScoreTest scores(model, workspace.null_draws, view.set);
      const std::vector<Direction> &directions = view.set.directions;
      for (std::size_t d = 0; d < directions.size(); ++d)
        see(directions[d],
            scores.scores[d],
            workspace.range.typical_friction,
            view.candidates[directions[d].candidate]);
      const auto is_better = [](const auto &a, const auto &b) {
        return a.score.value > b.score.value;
      };
      for (CandidateView &seen : view.candidates)
        {
          stable_sort(seen.ways, is_better);
          if (!seen.ways.empty())
            seen.score = seen.ways.front().score;
          seen.p = scores.family_p(seen.score.value);
        }
      view.pairs =
        scores.pairs(directions, [&](const std::size_t i, const std::size_t j) {
          return pairing(view.candidates[directions[i].candidate].candidate,
                         view.candidates[directions[j].candidate].candidate);
        });
      stable_sort(view.candidates, is_better);
      return view;
    }
  } // namespace



  /// A model, the wave that it was asked for, and what was seen.
  struct ScoredModel
  {
    // What candidates change is the same where all that is simulated is, but
    // for less than noise.
    bool is_like(const Model &other, const Eigen::Index n_rows) const
    {
      constexpr double little = 1.;
      return ModelKey(other).parts == key.parts &&
             (other.residual - residual).head(n_rows).squaredNorm() < little;
    }

    ModelKey        key;
    Eigen::VectorXd residual;
    double          track_wave;
    View            unscored, view;
  };



  View score_candidates(const Workspace &workspace, const Model &model)
  {
    constexpr std::size_t most_kept = 4;

    const ModelKey key(model);
    auto          &known = workspace.scored;
    const auto     find  = [&](const auto &is_wanted) {
      return std::find_if(known.begin(), known.end(), [&](const auto &other) {
        return other->track_wave == workspace.range.track_wave &&
               is_wanted(*other);
      });
    };
    const auto same =
      find([&](const ScoredModel &other) { return other.key == key; });
    if (same != known.end())
      return (*same)->view;
    const auto alike    = find([&](const ScoredModel &other) {
      return other.is_like(model, workspace.comparison.n_rows());
    });
    const View unscored = alike != known.end() ?
                            (*alike)->unscored :
                            find_directions(workspace, model);
    known.push_front(std::make_shared<const ScoredModel>(
      ScoredModel{key,
                  model.residual,
                  workspace.range.track_wave,
                  unscored,
                  with_scores(workspace, model, unscored)}));
    if (known.size() > most_kept)
      known.pop_back();
    return known.front()->view;
  }



  const CandidateView &View::of(const Direction &direction) const
  {
    return *std::find_if(candidates.begin(),
                         candidates.end(),
                         [&](const CandidateView &seen) {
                           return seen.number == direction.candidate;
                         });
  }
} // namespace SlipStep
