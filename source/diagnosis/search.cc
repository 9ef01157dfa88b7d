// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/additions.h>
#include <slipstep/diagnosis/confounding.h>
#include <slipstep/diagnosis/free_factor.h>
#include <slipstep/diagnosis/gap.h>
#include <slipstep/diagnosis/search.h>
#include <slipstep/diagnosis/refits.h>
#include <slipstep/diagnosis/rules.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/lists.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace SlipStep
{
  namespace
  {
    /// Another first addition to a model.
    struct OtherBeginning
    {
      Model  model;
      double lead; ///< on conditions left out, before the one that was chosen
    };



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

      /// The same without proof of what the first model has.
      SearchResult go_on();

      /// From another beginning, if there is one that could lead elsewhere.
      SearchResult begin_again(const SearchResult &found) const;

    private:
      std::optional<OtherBeginning> other_beginning(const Model &found) const;

      void extend(SearchResult &proven);

      bool add();

      void leave_wave(const TrackWave &wave, View &view) const;

      std::size_t n_effects() const
      {
        return effect_names(result.model.parts).size();
      }

      bool exchange_and_prune();

      std::size_t weakest() const;

      bool is_soaking_up(const unsigned int n_allowed);

      void prove();

      void drop_weakest();

      void refit_final();

      bool examine(const std::size_t part);

      bool try_rivals(const Model &less, const Part part, const double cost);

      Workspace           &workspace;
      std::optional<Model> started_from; ///< what the first name was added to
      std::vector<Model>   beginnings; ///< what was added first, and the others
      SearchResult         result;
    };



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



    bool holds_names(const Model &model, const Model &others)
    {
      return none_of(others.parts,
                     [&](const Part &part) { return !model.has(part.name); });
    }



    // Of those that gain nearly as much and were not found in the end, the one
    // that predicts conditions left out best.
    std::optional<OtherBeginning>
    Searcher::other_beginning(const Model &found) const
    {
      std::optional<OtherBeginning> best;
      const Model                  &chosen = beginnings.front();
      const double gain = started_from->objective - chosen.objective;
      for (const Model &other : beginnings)
        {
          if (other.has(chosen.parts.front().name) ||
              holds_names(found, other) ||
              started_from->objective - other.objective <
                promise_of_rivals(gain))
            continue;
          const double lead =
            left_out_lead(workspace, *started_from, other, chosen);
          if (!best.has_value() || lead > best->lead)
            best = OtherBeginning{other.copy(), lead};
        }
      return best;
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
      std::vector<Model> found =
        fitted_additions(workspace, result.model, view, result.first_fits);
      stable_sort(found, [](const Model &a, const Model &b) {
        return penalised(a) < penalised(b);
      });
      if (workspace.is_late())
        return false;
      const std::optional<FreeFactor> completed =
        complete_formula(workspace, result.model);
      const auto is_good = [&](const Model &more) {
        return evidence_for(workspace, result.model, more)
          .is_enough(more.parts.size() - result.model.parts.size());
      };
      for (auto best = found.begin(); best != found.end(); ++best)
        {
          if (completed.has_value() &&
              best->objective > completed->model.objective - rival_distance)
            continue;
          if (!is_good(*best))
            continue;
          const std::size_t n = result.model.parts.size();
          if (n == 0)
            {
              started_from = result.model;
              beginnings.assign(best, found.end());
            }
          result.model = *best;
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
          result.evidence.push_back(
            {std::numeric_limits<double>::infinity(), 0.});
          return false;
        }
      const Evidence evidence = evidence_for(workspace, *less, result.model);
      if (!evidence.is_enough())
        {
          result.model = *less;
          return true;
        }
      result.evidence.push_back(evidence);
      return result.model.parts[part].corrects.empty() &&
             try_rivals(*less, result.model.parts[part], evidence.cost);
    }



    // Between other bounds, or with an age at first, the law is the same. What
    // adds no effect to the case is told by its parameters only.
    bool is_same_law(const TrialFormula &a, const TrialFormula &b)
    {
      return !a.effect.empty() && a.effect == b.effect &&
             a.settings == b.settings && a.texts == b.texts;
    }



    // An effect may have several forms, which bounds tell apart, too.
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
          if (!is_evident(seen, workspace.level) ||
              promised < promise_of_rivals(cost) || n_tried == most_rivals ||
              (is_same && seen.candidate.formulas.size() < 2))
            continue;
          if (workspace.is_late())
            return false;
          ++n_tried;
          std::optional<Model> tried = refit_with(
            workspace, less, seen, penalised(result.model) + rival_distance);
          if (!tried.has_value() || is_at_bound(*tried) ||
              fits_any_friction(workspace, *tried) ||
              is_same_formula(tried->parts.back().formula, part.formula))
            continue;
          // What is better only while its steps are another's would have to
          // give way again.
          if (penalised(*tried) < penalised(result.model) - sure_gain)
            settle(workspace, *tried);
          const double distance = penalised(*tried) - penalised(result.model);
          if (distance >= rival_distance ||
              !evidence_for(workspace, less, *tried).is_enough())
            continue;
          if (distance < -sure_gain)
            {
              result.model = *tried;
              return true;
            }
          if (!is_same &&
              !is_same_law(tried->parts.back().formula, part.formula))
            result.rivals.push_back(
              {seen.candidate.name, part.name, distance, *tried});
        }
      return false;
    }



    bool Searcher::exchange_and_prune()
    {
      result.rivals.clear();
      result.evidence.clear();
      for (std::size_t part = 0; part < result.model.parts.size(); ++part)
        if (workspace.is_late())
          return false;
        else if (examine(part))
          return true;
      return false;
    }



    // The part that costs least to leave out.
    std::size_t Searcher::weakest() const
    {
      return std::min_element(result.evidence.begin(),
                              result.evidence.end(),
                              [](const Evidence &a, const Evidence &b) {
                                return a.cost < b.cost;
                              }) -
             result.evidence.begin();
    }



    // Each name gains less than the one before it. If those that are still
    // allowed could not explain what remains, the formula of a stronger name is
    // not the right one, and the weakest takes up what that leaves.
    bool Searcher::is_soaking_up(const unsigned int n_allowed)
    {
      if (result.model.parts.size() < 2 ||
          result.evidence.size() < result.model.parts.size())
        return false;
      const GapTest remainder =
        test_gap(workspace,
                 result.model,
                 score_candidates(workspace, result.model));
      const double least = result.evidence[weakest()].cost;
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
      const std::optional<Model> less =
        refit_without(workspace, result.model, weakest());
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
      return go_on();
    }



    SearchResult Searcher::go_on()
    {
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
      proven.first_fits = result.first_fits;
      return proven;
    }



    // Names that explain the tests as well by another way are rivals of those
    // that are not among them.
    void add_rivals(SearchResult &result, const SearchResult &other)
    {
      std::vector<std::string> names;
      for (const std::string &name : effect_names(result.model.parts))
        if (!other.model.has(name))
          names.push_back(name);
      const auto is_known = [&](const Part &part) {
        return any_of(result.model.parts,
                      [&](const Part &own) {
                        return own.name == part.name ||
                               is_same_law(own.formula, part.formula);
                      }) ||
               any_of(result.rivals, [&](const Rival &rival) {
                 return rival.name == part.name;
               });
      };
      for (const Part &part : other.model.parts)
        if (part.corrects.empty() && !is_known(part) && !names.empty())
          {
            result.rivals.push_back(
              {part.name,
               names.front(),
               penalised(other.model) - penalised(result.model),
               other.model});
            if (names.size() > 1)
              names.erase(names.begin());
          }
    }



    // From another beginning, if that could lead elsewhere: names may be wrong
    // together, what was found may be none, or leave a part of what could be
    // explained.
    SearchResult Searcher::begin_again(const SearchResult &found) const
    {
      constexpr double much = 0.05; // of what is explained

      if (beginnings.size() < 2 || workspace.is_late())
        return found;

      const GapTest remainder =
        test_gap(workspace,
                 found.model,
                 score_candidates(workspace, found.model));
      const bool remains = remainder.p <= workspace.level;
      const bool is_none = is_at_bound(found.model);
      if (!is_none && !remains && effect_names(found.model.parts).size() < 2)
        return found;
      const auto   other     = other_beginning(found.model);
      const double explained = started_from->objective - found.model.objective;
      if (!other.has_value() ||
          !(other->lead > sure_lead || is_none ||
            (remains &&
             remainder.excess > std::max(sure_excess, much * explained))))
        return found;
      workspace.tell("beginning with " + other->model.parts.back().name);
      SearchResult others = Searcher(workspace, other->model).go_on();
      // Nothing has to be added to it.
      if (others.evidence.empty())
        others = Searcher(workspace, other->model).run();
      if (others.evidence.empty() || workspace.is_late())
        return found;
      return better_of(
        found,
        others,
        left_out_lead(workspace, *started_from, others.model, found.model));
    }
  } // namespace



  SearchResult better_of(const SearchResult &first,
                         const SearchResult &other,
                         const double        lead)
  {
    if (is_at_bound(other.model))
      return first;
    const double distance = is_at_bound(first.model) ?
                              -std::numeric_limits<double>::infinity() :
                              penalised(other.model) - penalised(first.model);
    // Without conditions to leave out the lead does not tell.
    const bool   is_far    = std::abs(distance) >= rival_distance;
    const bool   lead_told = std::abs(lead) >= sure_lead;
    const bool   is_other  = is_far || !lead_told ? distance < 0. : lead > 0.;
    SearchResult result    = is_other ? other : first;
    result.first_fits      = first.first_fits;
    if (!is_far && !lead_told)
      add_rivals(result, is_other ? first : other);
    return result;
  }



  // Names follow the tests most closely one by one: a wrong one may do so by
  // what a second one would explain.
  SearchResult search(Workspace &workspace, const Model &first)
  {
    Searcher           searcher(workspace, first);
    const SearchResult found = searcher.run();
    try
      {
        return searcher.begin_again(found);
      }
    catch (const RunError &)
      {
        workspace.end_by_signal();
        return found;
      }
  }
} // namespace SlipStep
