#include <slipstep/diagnosis/search.h>
#include <slipstep/utilities/exceptions.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace SlipStep
{
  namespace
  {
    // Precision of the objective in fits that decide.
    constexpr double precision = 0.1;

    // Scores are of this many standard deviations when an effect counts as
    // seen.
    constexpr double seen_deviations = 5.;



    std::vector<Part> with_part(const Model &model, const CandidateView &view)
    {
      std::vector<Part> parts = model.parts;
      parts.push_back(
        {view.candidate.name, view.candidate.formulas[view.best->formula]});
      return parts;
    }



    Values merged(Values values, const Values &others)
    {
      for (const auto &value : others)
        values[value.first] = value.second;
      return values;
    }



    // Changes of friction by one formula of a candidate at unit strength.
    // Returns why there are none, if it cannot be simulated.
    std::string add_directions(const Workspace        &workspace,
                               const Model            &model,
                               const Candidate        &candidate,
                               const std::size_t       candidate_number,
                               const std::size_t       formula_number,
                               std::vector<Direction> &directions)
    {
      const Formula    &formula = candidate.formulas[formula_number];
      std::vector<Part> parts   = model.parts;
      parts.push_back({candidate.name, formula});
      const Values own = model.values();
      try
        {
          Model trial = make_model(
            workspace.start,
            parts,
            merged(own, formula.shapes[formula.shapes.size() / 2].values(1.)),
            workspace.tests,
            &model);
          const Eigen::VectorXd base =
            workspace.comparison.difference(*model.simulator, model.scaled);
          for (std::size_t s = 0; s < formula.shapes.size(); ++s)
            {
              const Values values = merged(own, formula.shapes[s].values(1.));
              std::vector<double> scaled;
              for (const FitParameter &parameter : trial.campaign->fitted)
                scaled.push_back(std::clamp(
                  parameter.to_scaled(values.at(parameter.path)), 0., 1.));
              const Eigen::VectorXd there =
                workspace.comparison.difference(*trial.simulator, scaled);
              if (there.size() == 0)
                continue;
              Direction direction;
              direction.friction     = there - base;
              direction.is_one_sided = formula.is_one_sided;
              direction.candidate    = candidate_number;
              direction.formula      = formula_number;
              direction.shape        = s;
              directions.push_back(direction);
            }
        }
      catch (const InputError &error)
        {
          return error.what();
        }
      catch (const RunError &error)
        {
          throw_if_stopped();
          return error.what();
        }
      return "";
    }



    // Below this share of the friction, greatest over the rows, nothing but
    // round-off and time steps are seen.
    constexpr double least_change = 1e-5;
  } // namespace



  View look(Workspace &workspace, const Model &model)
  {
    const std::vector<Candidate> candidates =
      make_candidates(model.simulator->with(model.scaled), workspace.range);
    std::vector<std::vector<Direction>> found(candidates.size());
    std::vector<std::string>            failures(candidates.size());
    side_by_side(candidates.size(), [&](const std::size_t c) {
      Model own     = model;
      own.simulator = std::make_shared<Simulator>(*model.simulator);
      for (std::size_t f = 0; f < candidates[c].formulas.size(); ++f)
        failures[c] =
          add_directions(workspace, own, candidates[c], c, f, found[c]);
    });
    View view;
    for (const auto &directions : found)
      for (const Direction &direction : directions)
        if (direction.friction.cwiseAbs().maxCoeff() >
            least_change * workspace.range.typical_friction)
          view.directions.push_back(direction);
    view.candidates.resize(candidates.size());
    for (std::size_t c = 0; c < candidates.size(); ++c)
      {
        view.candidates[c].candidate = candidates[c];
        if (found[c].empty())
          view.candidates[c].failure = failures[c];
      }
    if (view.directions.empty())
      return view;

    const ScoreTest scores(workspace.comparison,
                           model,
                           workspace.null_draws,
                           view.directions);
    for (std::size_t d = 0; d < view.directions.size(); ++d)
      {
        const Direction &direction = view.directions[d];
        const Score     &score     = scores.scores[d];
        CandidateView   &seen      = view.candidates[direction.candidate];
        if (!seen.best.has_value() || score.value > seen.score.value)
          {
            seen.best  = direction;
            seen.score = score;
          }
        if (score.free_length > 0.)
          seen.minimum_detectable =
            std::min(seen.minimum_detectable,
                     seen_deviations * score.deviation / score.free_length *
                       direction.friction.cwiseAbs().maxCoeff() /
                       workspace.range.typical_friction);
      }
    for (CandidateView &seen : view.candidates)
      seen.p = scores.family_p(seen.score.value);
    std::stable_sort(view.candidates.begin(),
                     view.candidates.end(),
                     [](const CandidateView &a, const CandidateView &b) {
                       return a.score.value > b.score.value;
                     });
    return view;
  }



  std::vector<Direction> smooth_directions(const Workspace &workspace,
                                           const View      &view)
  {
    std::vector<Direction> result = view.directions;
    for (const BasisColumn &column :
         smooth_basis(workspace.comparison, workspace.covariates))
      {
        Direction direction;
        direction.friction = column.friction;
        result.push_back(direction);
      }
    return result;
  }



  GapTest
  test_gap(const Workspace &workspace, const Model &model, const View &view)
  {
    return test_gap(workspace.comparison,
                    workspace.covariates,
                    model,
                    workspace.null_draws,
                    smooth_directions(workspace, view));
  }



  namespace
  {
    // With the effect at a strength, less if that cannot be simulated.
    std::optional<Model> fit_from(const Workspace     &workspace,
                                  const Model         &model,
                                  const CandidateView &view,
                                  const Values        &values,
                                  double               strength)
    {
      const Formula &formula = view.candidate.formulas[view.best->formula];
      for (unsigned int attempt = 0; attempt < 2; ++attempt, strength *= 0.1)
        try
          {
            Model result = make_model(
              workspace.start,
              with_part(model, view),
              merged(values, formula.shapes[view.best->shape].values(strength)),
              workspace.tests,
              &model);
            if (workspace.comparison.fit(result, precision))
              return result;
          }
        catch (const InputError &)
          {}
        catch (const RunError &)
          {
            throw_if_stopped();
          }
      return {};
    }
  } // namespace



  std::optional<Model> refit_with(Workspace           &workspace,
                                  const Model         &model,
                                  const CandidateView &view)
  {
    // Above, in units of the noise, a model is so far off that its parameters
    // have been pulled anywhere: those of the start are as good.
    constexpr double far = 2.;

    const Formula &formula = view.candidate.formulas[view.best->formula];
    // To first order; less where that is far.
    double strength = std::clamp(view.score.strength, -50., 100.);
    if (formula.is_one_sided)
      strength = std::max(strength, 0.1);
    ++workspace.n_refits;
    std::optional<Model> best =
      fit_from(workspace, model, view, model.values(), strength);
    if (model.objective < far * workspace.comparison.n_rows())
      return best;
    Values start = model.values();
    for (const FitParameter &parameter : model.campaign->fitted)
      start[parameter.path] = parameter.start;
    for (const double share : {1., 0.2})
      {
        const std::optional<Model> other =
          fit_from(workspace, model, view, start, share * strength);
        if (other.has_value() &&
            (!best.has_value() || other->objective < best->objective))
          best = other;
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



  namespace
  {
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



    // The same without one of its parts, fitted again.
    std::optional<Model> refit_without(Workspace        &workspace,
                                       const Model      &model,
                                       const std::size_t part)
    {
      std::vector<Part> parts = model.parts;
      parts.erase(parts.begin() + part);
      ++workspace.n_refits;
      try
        {
          Model result = make_model(
            workspace.start, parts, model.values(), workspace.tests, &model);
          // The model that it is compared with is not weak in what is missing
          // here.
          result.simulator->correct(result.scaled, correction_share);
          if (workspace.comparison.fit(result, precision))
            return result;
        }
      catch (const InputError &)
        {}
      catch (const RunError &)
        {
          throw_if_stopped();
        }
      return {};
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

      bool exchange_and_prune();

      bool is_soaking_up(const unsigned int n_allowed);

      void prove();

      void drop_weakest();

      bool examine(const std::size_t part);

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



    // The best of those that chance does not explain.
    bool Searcher::add()
    {
      constexpr unsigned int most_tried = 5;

      const View           view = look(workspace, result.model);
      std::optional<Model> best;
      unsigned int         n_tried = 0;
      for (const CandidateView &seen : view.candidates)
        {
          if (!seen.best.has_value() || seen.p > workspace.level ||
              n_tried == most_tried)
            continue;
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
          if (!is_at_bound(*tried) &&
              (!best.has_value() || penalised(*tried) < penalised(*best)))
            best = tried;
        }
      if (!best.has_value() ||
          best->objective > result.model.objective - least_cost)
        return false;
      result.model = *best;
      settle(workspace, result.model);
      tell("added " + result.model.parts.back().name);
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
          return false;
        }
      const double cost = less->objective - result.model.objective;
      const auto   sum  = [](const std::vector<double> &values) {
        return std::accumulate(values.begin(), values.end(), 0.);
      };
      const double left_out_gain =
        sum(left_out_squares(workspace, *less)) -
        sum(left_out_squares(workspace, result.model));
      if (cost < least_cost || (cost < sure_cost && !(left_out_gain > 0.)))
        {
          result.model = *less;
          return true;
        }
      result.costs.push_back(cost);
      result.left_out_gains.push_back(left_out_gain);
      return try_rivals(*less, name, cost);
    }



    // In the place of a name. Returns whether one takes it.
    bool Searcher::try_rivals(const Model       &less,
                              const std::string &name,
                              const double       cost)
    {
      constexpr unsigned int most_rivals = 4;

      const View   view    = look(workspace, less);
      unsigned int n_tried = 0;
      for (const CandidateView &seen : view.candidates)
        {
          const double promised =
            std::pow(seen.score.strength * seen.score.free_length, 2);
          if (!seen.best.has_value() || seen.candidate.name == name ||
              !(seen.score.value > 0.) ||
              promised < promising_share * cost - promising_slack ||
              n_tried == most_rivals)
            continue;
          ++n_tried;
          const std::optional<Model> tried = refit_with(workspace, less, seen);
          if (!tried.has_value() || is_at_bound(*tried))
            continue;
          const double distance = penalised(*tried) - penalised(result.model);
          if (distance < -sure_gain)
            {
              result.model = *tried;
              settle(workspace, result.model);
              return true;
            }
          if (distance < rival_distance)
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
        if (examine(part))
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
        test_gap(workspace, result.model, look(workspace, result.model));
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
      for (unsigned int round = 0; round < workspace.most_effects; ++round)
        {
          if (!add())
            break;
          prove();
          // What was added and taken away again would come back.
          if (result.model.parts.size() <= round)
            break;
          if (is_soaking_up(workspace.most_effects - round - 1))
            break;
        }
      while (is_soaking_up(0))
        {
          const std::size_t n = result.model.parts.size();
          drop_weakest();
          if (result.model.parts.size() == n)
            break;
          prove();
        }
      return result;
    }
  } // namespace



  SearchResult search(Workspace &workspace, const Model &base)
  {
    return Searcher(workspace, base).run();
  }



  // By one step of Gauss and Newton from the optimum of all conditions; by a
  // fit of its own where that goes far.
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
      Eigen::MatrixXd   derivatives = model.derivatives;
      Eigen::VectorXd   residual    = model.residual;
      std::vector<bool> left_out;
      for (const ComparedTest &test : comparison.tests)
        {
          left_out.push_back(test.condition == c);
          if (!left_out.back())
            continue;
          derivatives.middleRows(test.begin, test.size).setZero();
          residual.segment(test.begin, test.size).setZero();
        }
      Model other     = model;
      other.simulator = std::make_shared<Simulator>(*model.simulator);
      const Eigen::MatrixXd curvature = derivatives.transpose() * derivatives;
      const Eigen::VectorXd step =
        curvature.completeOrthogonalDecomposition().solve(
          derivatives.transpose() * residual);
      bool is_near = true;
      for (std::size_t i = 0; i < other.scaled.size(); ++i)
        {
          const double slope =
            natural_slope(model.campaign->fitted[i], model.scaled[i]);
          is_near         = is_near && std::abs(step(i)) * slope < 0.5;
          other.scaled[i] = std::clamp(other.scaled[i] + step(i), 0., 1.);
        }
      if (!is_near)
        {
          other.scaled = model.scaled;
          comparison.fit(other, 1., left_out);
        }
      const Eigen::VectorXd difference =
        comparison.difference(*other.simulator, other.scaled);
      if (difference.size() == 0)
        return;
      RowMatrix whitened = difference;
      comparison.whiten(whitened);
      for (std::size_t t = 0; t < comparison.tests.size(); ++t)
        if (left_out[t])
          {
            const ComparedTest &test = comparison.tests[t];
            squares[t] =
              whitened.middleRows(test.begin, test.size).squaredNorm();
            if (differences != nullptr)
              differences->segment(test.begin, test.size) =
                difference.segment(test.begin, test.size);
          }
    });
    return squares;
  }
} // namespace SlipStep
