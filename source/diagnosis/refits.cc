// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/refits.h>
#include <slipstep/diagnosis/rules.h>

#include <algorithm>

namespace SlipStep
{
  namespace
  {
    // Precision of the objective in fits that decide.
    constexpr double precision = 0.1;



    std::optional<Model> fitted(const Comparison         &comparison,
                                Model                     model,
                                const Comparison::FitEnd &end)
    {
      return comparison.fit(model, end) ? std::make_optional(std::move(model)) :
                                          std::nullopt;
    }
  } // namespace



  std::optional<Model> fitted_model(const Workspace          &workspace,
                                    const std::vector<Part>  &parts,
                                    const Values             &values,
                                    const Model              &like,
                                    const Comparison::FitEnd &end)
  {
    return if_possible([&]() {
      return fitted(
        workspace.comparison,
        make_model(workspace.start, parts, values, workspace.tests, like),
        end);
    });
  }



  namespace
  {
    // With the effect at a strength, less if that cannot be simulated.
    std::optional<Model> fit_from(const Workspace &workspace,
                                  const Model     &model,
                                  const Candidate &candidate,
                                  const Direction &direction,
                                  const Values    &values,
                                  const double     strength,
                                  const double     goal)
    {
      const TrialFormula::Shape &shape =
        candidate.formulas[direction.formula].shapes[direction.shape];
      for (const double share : {1., 0.1})
        if (std::optional<Model> result =
              fitted_model(workspace,
                           with_part(model.parts, candidate, direction.formula),
                           merged(values, shape(share * strength)),
                           model,
                           {precision, goal}))
          return result;
      return {};
    }



    // By one formula.
    std::optional<Model> refit_by(const Workspace          &workspace,
                                  const Model              &model,
                                  const Candidate          &candidate,
                                  const CandidateView::Way &way,
                                  double                    goal)
    {
      // Above, in units of the noise, a model is so far off that its
      // parameters have been pulled anywhere: those of the start are as good,
      // unless what was added leads to the tests from there.
      const double far = 2. * workspace.comparison.n_rows();

      // To first order; less where that is far.
      double strength = std::clamp(way.score.strength, -50., 100.);
      if (way.direction.is_one_sided)
        strength = std::max(strength, 0.1);
      std::optional<Model> best = fit_from(workspace,
                                           model,
                                           candidate,
                                           way.direction,
                                           model.values(),
                                           strength,
                                           goal);
      if (model.objective < far || (best.has_value() && best->objective < far))
        return best;
      Values start = model.values();
      for (const FitParameter &parameter : model.campaign->fitted)
        start[parameter.path] = parameter.start;
      for (const double share : {1., 0.2})
        {
          if (best.has_value())
            goal = std::min(goal, best->objective);
          const std::optional<Model> other = fit_from(workspace,
                                                      model,
                                                      candidate,
                                                      way.direction,
                                                      start,
                                                      share * strength,
                                                      goal);
          if (!other.has_value())
            continue;
          // Where all that did not lead elsewhere, less of it will not.
          const bool is_elsewhere =
            !best.has_value() || other->objective < best->objective - sure_gain;
          if (!best.has_value() || other->objective < best->objective)
            best = other;
          if (!is_elsewhere)
            break;
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
  } // namespace



  bool is_at_bound(const Model &model)
  {
    for (const Part &part : model.parts)
      for (const CandidateParameter &parameter : part.formula.parameters)
        if (ends_at_bound(parameter, model))
          return true;
    return false;
  }



  std::optional<Model> refit_with(Workspace           &workspace,
                                  const Model         &model,
                                  const CandidateView &view,
                                  const double         goal)
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
          refit_by(workspace,
                   model,
                   view.candidate,
                   way,
                   best.has_value() && !is_at_bound(*best) ?
                     std::min(goal, penalised(*best)) :
                     goal);
        if (tried.has_value() &&
            (!best.has_value() || rank(*tried) < rank(*best)))
          best = tried;
      }
    return best;
  }



  std::optional<Model> refit_with_pair(Workspace             &workspace,
                                       const Model           &model,
                                       const View            &view,
                                       const ScoreTest::Pair &pair)
  {
    // Less of both if they cannot be simulated.
    for (const double share : {1., 0.3, 0.1})
      {
        std::vector<Part> parts  = model.parts;
        Values            values = model.values();
        const auto add = [&](const std::size_t number, const double strength) {
          const Direction    &direction = view.set.directions[number];
          const Candidate    &candidate = view.of(direction).candidate;
          const TrialFormula &formula   = candidate.formulas[direction.formula];
          parts.push_back({candidate.name, formula});
          values =
            merged(values,
                   formula.shapes[direction.shape](
                     share * std::clamp(strength,
                                        formula.is_one_sided ? 0.1 : -50.,
                                        100.)));
        };
        add(pair.first, pair.first_strength);
        add(pair.second, pair.second_strength);
        ++workspace.n_refits;
        const std::optional<Model> tried =
          fitted_model(workspace, parts, values, model, precision);
        if (tried.has_value())
          return tried;
      }
    return {};
  }



  Model refit_from_starts(Workspace &workspace, const Model &model)
  {
    // Strengths of an effect that begins anew.
    constexpr double strength = 2.;

    Model best = model;
    for (const Part &part : model.parts)
      for (const std::size_t shape :
           {std::size_t(0), part.formula.shapes.size() - 1})
        {
          if (part.formula.shapes.empty() || workspace.is_late())
            continue;
          ++workspace.n_refits;
          const std::optional<Model> tried =
            fitted_model(workspace,
                         model.parts,
                         merged(model.values(),
                                part.formula.shapes[shape](strength)),
                         model,
                         {precision, best.objective});
          if (tried.has_value() && !is_at_bound(*tried) &&
              tried->objective < best.objective - sure_gain)
            best = *tried;
        }
    if (best.objective < model.objective)
      settle(workspace, best);
    return best;
  }



  bool replan(Model &model, const Simulator *like)
  {
    Model planned = model.copy();
    try
      {
        planned.simulator->plan(model.scaled, like);
        planned.simulator->correct(model.scaled);
      }
    catch (const RunError &)
      {
        throw_if_stopped();
        return false;
      }
    model = planned;
    return true;
  }



  void settle(const Workspace &workspace, Model &model)
  {
    Model settled = model.copy();
    if (replan(settled, model.simulator.get()) &&
        workspace.comparison.fit(settled, 0.01))
      model = settled;
  }



  std::optional<Model> fit_plainly(const Workspace &workspace,
                                   const Model     &model)
  {
    constexpr double share = 0.01;

    Comparison plain = workspace.comparison;
    for (ComparedTest &test : plain.tests)
      for (Series &series : test.series)
        {
          std::fill(series.row_noise.begin(),
                    series.row_noise.end(),
                    share * test.level);
          series.row_share = 0.;
        }
    plain.set_noise(Noise(), plain.measured);
    return fitted(plain, model.copy(), 1.);
  }



  double penalised(const Model &model)
  {
    std::size_t n = model.scaled.size();
    for (const Part &part : model.parts)
      n += part.formula.n_in_texts + part.formula.n_assumed;
    return model.objective + cost_of_parameter * n;
  }



  std::optional<Model> refit_without(Workspace        &workspace,
                                     const Model      &model,
                                     const std::size_t part)
  {
    std::vector<Part> parts;
    for (std::size_t i = 0; i < model.parts.size(); ++i)
      if (i != part && (!model.parts[part].corrects.empty() ||
                        model.parts[i].corrects != model.parts[part].name))
        parts.push_back(model.parts[i]);
    ++workspace.n_refits;
    return if_possible([&]() {
      Model result = make_coarse_model(
        workspace.start, parts, model.values(), workspace.tests, &model);
      // The model that it is compared with is not weak in what is missing
      // here.
      result.simulator->correct(result.scaled);
      return fitted(workspace.comparison, std::move(result), precision);
    });
  }
} // namespace SlipStep
