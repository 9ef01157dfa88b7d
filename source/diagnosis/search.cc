// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/gap.h>
#include <slipstep/diagnosis/search.h>
#include <slipstep/utilities/exceptions.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace SlipStep
{
  namespace
  {
    // Precision of the objective in fits that decide.
    constexpr double precision = 0.1;



    std::optional<Model> fitted(const Workspace &workspace, Model model)
    {
      return workspace.comparison.fit(model, precision) ?
               std::make_optional(std::move(model)) :
               std::nullopt;
    }



    // With the effect at a strength, less if that cannot be simulated.
    std::optional<Model> fit_from(const Workspace &workspace,
                                  const Model     &model,
                                  const Candidate &candidate,
                                  const Direction &direction,
                                  const Values    &values,
                                  double           strength)
    {
      const TrialFormula::Shape &shape =
        candidate.formulas[direction.formula].shapes[direction.shape];
      std::optional<Model> result;
      for (unsigned int attempt = 0; attempt < 2 && !result.has_value();
           ++attempt, strength *= 0.1)
        result = if_possible([&]() {
          return fitted(
            workspace,
            make_model(workspace.start,
                       with_part(model, candidate, direction.formula),
                       merged(values, shape(strength)),
                       workspace.tests,
                       &model));
        });
      return result;
    }



    // By one formula.
    std::optional<Model> refit_by(const Workspace          &workspace,
                                  const Model              &model,
                                  const Candidate          &candidate,
                                  const CandidateView::Way &way)
    {
      // Above, in units of the noise, a model is so far off that its
      // parameters have been pulled anywhere: those of the start are as good.
      constexpr double far = 2.;

      // To first order; less where that is far.
      double strength = std::clamp(way.score.strength, -50., 100.);
      if (way.direction.is_one_sided)
        strength = std::max(strength, 0.1);
      std::optional<Model> best = fit_from(
        workspace, model, candidate, way.direction, model.values(), strength);
      if (model.objective < far * workspace.comparison.n_rows())
        return best;
      Values start = model.values();
      for (const FitParameter &parameter : model.campaign->fitted)
        start[parameter.path] = parameter.start;
      for (const double share : {1., 0.2})
        {
          const std::optional<Model> other = fit_from(workspace,
                                                      model,
                                                      candidate,
                                                      way.direction,
                                                      start,
                                                      share * strength);
          if (other.has_value() &&
              (!best.has_value() || other->objective < best->objective))
            best = other;
        }
      return best;
    }



    bool ends_at_bound(const CandidateParameter &parameter, const Model &model)
    {
      for (std::size_t i = 0; i < model.scaled.size(); ++i)
        if (model.campaign->fitted[i].path == parameter.path &&
            ((model.scaled[i] < 1e-6 && !parameter.lower_makes_sense) ||
             (model.scaled[i] > 1. - 1e-6 && !parameter.upper_makes_sense)))
          return true;
      return false;
    }



    bool is_at_bound(const Model &model)
    {
      for (const Part &part : model.parts)
        for (const CandidateParameter &parameter : part.formula.parameters)
          if (ends_at_bound(parameter, model))
            return true;
      return false;
    }
  } // namespace



  std::optional<Model> refit_with(Workspace           &workspace,
                                  const Model         &model,
                                  const CandidateView &view)
  {
    // Below this share of the best score another formula is not tried.
    constexpr double as_promising = 0.7;

    std::optional<Model> best;
    const auto           rank = [](const Model &tried) {
      return std::make_pair(is_at_bound(tried), penalised(tried));
    };
    for (const CandidateView::Way &way : view.ways)
      {
        if (way.score.value < as_promising * view.score.value)
          break;
        ++workspace.n_refits;
        const std::optional<Model> tried =
          refit_by(workspace, model, view.candidate, way);
        if (tried.has_value() &&
            (!best.has_value() || rank(*tried) < rank(*best)))
          best = tried;
      }
    return best;
  }



  void settle(const Workspace &workspace, Model &model)
  {
    Model settled     = model;
    settled.simulator = std::make_shared<Simulator>(*model.simulator);
    try
      {
        settled.simulator->plan(model.scaled, model.simulator.get());
        settled.simulator->correct(model.scaled, correction_share);
      }
    catch (const RunError &)
      {
        // It sticks and slips: the steps that it was fitted with have to do.
        throw_if_stopped();
        return;
      }
    if (workspace.comparison.fit(settled, 0.01))
      model = settled;
  }



  double penalised(const Model &model)
  {
    return model.objective + cost_of_parameter * model.scaled.size();
  }



  double level_of_round(const Workspace &workspace, const std::size_t round)
  {
    // Halves, and in the last round what is left.
    const std::size_t last = std::max(1u, workspace.most_effects) - 1;
    return workspace.level *
           std::pow(0.5, std::min(round, last) + (round < last ? 1. : 0.));
  }



  bool is_evident(const CandidateView &seen, const double level)
  {
    return !seen.ways.empty() && seen.score.value > 0. && seen.p <= level &&
           seen.minimum_detectable <= largest_hidden_change;
  }



  double left_out_gain(const Workspace &workspace,
                       const Model     &less,
                       const Model     &more)
  {
    const auto sum = [&](const Model &model) {
      const std::vector<double> squares = left_out_squares(workspace, model);
      return std::accumulate(squares.begin(), squares.end(), 0.);
    };
    return sum(less) - sum(more);
  }



  bool is_needed(const double cost, const double left_out_gain)
  {
    return std::isnan(left_out_gain) ? cost >= sure_cost :
                                       cost >= least_cost && left_out_gain > 0.;
  }



  namespace
  {
    // The same without one of its parts, fitted again.
    std::optional<Model> refit_without(Workspace        &workspace,
                                       const Model      &model,
                                       const std::size_t part)
    {
      std::vector<Part> parts = model.parts;
      parts.erase(parts.begin() + part);
      ++workspace.n_refits;
      return if_possible([&]() {
        Model result = make_model(
          workspace.start, parts, model.values(), workspace.tests, &model);
        // The model that it is compared with is not weak in what is missing
        // here.
        result.simulator->correct(result.scaled, correction_share);
        return fitted(workspace, std::move(result));
      });
    }



    /// The search, step by step.
    class Searcher
    {
    public:
      Searcher(Workspace &workspace, const Model &base)
        : workspace(workspace)
        , base(base)
      {
        result.model = base;
      }

      SearchResult run();

    private:
      bool add();

      double level() const;

      bool exchange_and_prune();

      bool is_soaking_up(const unsigned int n_allowed);

      void prove();

      void drop_weakest();

      bool examine(const std::size_t part);

      bool is_out_of_time();

      bool
      try_rivals(const Model &less, const std::string &name, const double cost);

      void tell(const std::string &text) const
      {
        if (workspace.progress)
          workspace.progress(text);
      }

      Workspace   &workspace;
      const Model &base;
      SearchResult result;
    };



    // What is left of the level for the part added last, or its rivals.
    double Searcher::level() const
    {
      return level_of_round(
        workspace, std::max<std::size_t>(1, result.model.parts.size()) - 1);
    }



    // The best of those that chance does not explain, and that predict
    // conditions left out better than without them.
    bool Searcher::add()
    {
      constexpr unsigned int most_tried = 5;

      const double level = level_of_round(workspace, result.model.parts.size());
      const View   view  = score_candidates(workspace, result.model);
      std::vector<Model> found;
      unsigned int       n_tried = 0;
      for (const CandidateView &seen : view.candidates)
        {
          if (!is_evident(seen, level) || n_tried == most_tried)
            continue;
          if (is_out_of_time())
            return false;
          ++n_tried;
          const std::optional<Model> tried =
            refit_with(workspace, result.model, seen);
          // Worse than without it: the fit was lost on its way.
          if (!tried.has_value() || tried->objective > result.model.objective)
            continue;
          if (result.model.parts.empty())
            result.gains.emplace_back(seen.candidate.name,
                                      result.model.objective -
                                        tried->objective);
          if (!is_at_bound(*tried))
            found.push_back(*tried);
        }
      std::stable_sort(found.begin(),
                       found.end(),
                       [](const Model &a, const Model &b) {
                         return penalised(a) < penalised(b);
                       });
      for (Model &best : found)
        {
          if (!is_needed(result.model.objective - best.objective,
                         left_out_gain(workspace, result.model, best)))
            continue;
          result.model = best;
          settle(workspace, result.model);
          tell("added " + result.model.parts.back().name);
          return true;
        }
      return false;
    }



    bool Searcher::is_out_of_time()
    {
      result.is_cut_short = result.is_cut_short || workspace.is_late();
      return result.is_cut_short;
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
      return try_rivals(*less, name, cost);
    }



    // In the place of a name. Returns whether one takes it.
    bool Searcher::try_rivals(const Model       &less,
                              const std::string &name,
                              const double       cost)
    {
      constexpr unsigned int most_rivals = 4;

      const View   view    = score_candidates(workspace, less);
      unsigned int n_tried = 0;
      for (const CandidateView &seen : view.candidates)
        {
          const double promised =
            std::pow(seen.score.strength * seen.score.free_length, 2);
          if (!is_evident(seen, level()) || seen.candidate.name == name ||
              promised < promising_share * cost - promising_slack ||
              n_tried == most_rivals)
            continue;
          if (is_out_of_time())
            return false;
          ++n_tried;
          const std::optional<Model> tried = refit_with(workspace, less, seen);
          if (!tried.has_value() || is_at_bound(*tried))
            continue;
          const double distance = penalised(*tried) - penalised(result.model);
          if (distance >= rival_distance ||
              !is_needed(less.objective - tried->objective,
                         left_out_gain(workspace, less, *tried)))
            continue;
          if (distance < -sure_gain)
            {
              result.model = *tried;
              settle(workspace, result.model);
              return true;
            }
          result.rivals.push_back(
            {seen.candidate.name, name, distance, *tried});
        }
      return false;
    }



    bool Searcher::exchange_and_prune()
    {
      result.rivals.clear();
      result.costs.clear();
      result.left_out_gains.clear();
      for (std::size_t part = 0; part < result.model.parts.size(); ++part)
        if (is_out_of_time())
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
      tell("proving");
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



    SearchResult Searcher::run()
    {
      SearchResult proven = result;
      for (unsigned int round = 0; round < workspace.most_effects; ++round)
        {
          if (!add())
            break;
          prove();
          if (is_out_of_time())
            break;
          // What was added and taken away again would come back.
          if (result.model.parts.size() <= round)
            break;
          if (is_soaking_up(workspace.most_effects - round - 1))
            break;
          proven = result;
        }
      while (!result.is_cut_short && is_soaking_up(0))
        {
          const std::size_t n = result.model.parts.size();
          drop_weakest();
          if (result.model.parts.size() == n)
            break;
          prove();
          is_out_of_time();
        }
      if (!result.is_cut_short)
        return result;
      proven.gains        = result.gains;
      proven.is_cut_short = true;
      return proven;
    }
  } // namespace



  SearchResult search(Workspace &workspace, const Model &base)
  {
    return Searcher(workspace, base).run();
  }



  namespace
  {
    // A model as fitted to all conditions but one: by one step of Gauss and
    // Newton from the optimum of all, by a fit of its own where that goes far.
    Model fit_without(const Comparison &comparison,
                      const Model      &model,
                      const std::size_t condition)
    {
      Eigen::MatrixXd   derivatives = model.derivatives;
      Eigen::VectorXd   residual    = model.residual;
      std::vector<bool> left_out;
      for (const ComparedTest &test : comparison.tests)
        {
          left_out.push_back(test.condition == condition);
          if (!left_out.back())
            continue;
          derivatives.middleRows(test.begin, test.size).setZero();
          residual.segment(test.begin, test.size).setZero();
        }
      Model result     = model;
      result.simulator = std::make_shared<Simulator>(*model.simulator);
      const Eigen::MatrixXd curvature = derivatives.transpose() * derivatives;
      const Eigen::VectorXd step =
        curvature.completeOrthogonalDecomposition().solve(
          derivatives.transpose() * residual);
      bool is_near = true;
      for (std::size_t i = 0; i < result.scaled.size(); ++i)
        {
          const double slope =
            natural_slope(model.campaign->fitted[i], model.scaled[i]);
          is_near          = is_near && std::abs(step(i)) * slope < 0.5;
          result.scaled[i] = std::clamp(result.scaled[i] + step(i), 0., 1.);
        }
      if (!is_near)
        {
          result.scaled = model.scaled;
          comparison.fit(result, 1., left_out);
        }
      return result;
    }
  } // namespace



  std::vector<double> left_out_squares(const Workspace &workspace,
                                       const Model     &model,
                                       Eigen::VectorXd *differences)
  {
    const Comparison   &comparison = workspace.comparison;
    std::vector<double> squares(comparison.tests.size(), 0.);
    // Of a single condition nothing is left to fit.
    constexpr double none   = std::numeric_limits<double>::quiet_NaN();
    const bool       is_one = comparison.conditions.size() < 2;
    if (differences != nullptr)
      *differences =
        Eigen::VectorXd::Constant(comparison.n_rows(), is_one ? none : 0.);
    if (is_one)
      return std::vector<double>(comparison.tests.size(), none);
    side_by_side(comparison.conditions.size(), [&](const std::size_t c) {
      const Model           other = fit_without(comparison, model, c);
      const Eigen::VectorXd difference =
        comparison.difference(*other.simulator, other.scaled);
      if (difference.size() == 0)
        return;
      RowMatrix whitened = difference;
      comparison.whiten(whitened);
      for (std::size_t t = 0; t < comparison.tests.size(); ++t)
        {
          const ComparedTest &test = comparison.tests[t];
          if (test.condition != c)
            continue;
          squares[t] = whitened.middleRows(test.begin, test.size).squaredNorm();
          if (differences != nullptr)
            differences->segment(test.begin, test.size) =
              difference.segment(test.begin, test.size);
        }
    });
    return squares;
  }
} // namespace SlipStep
