// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/confounding.h>
#include <slipstep/diagnosis/covariate.h>
#include <slipstep/diagnosis/refits.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <array>

namespace SlipStep
{
  namespace
  {
    // What tests are made at, rather than what comes about in them.
    const std::array<std::string, 2> conditions_of_tests = {
      {"pressure", "speed"}};

    bool is_condition(const std::string &along)
    {
      return any_of(conditions_of_tests, [&](const std::string &name) {
        return covariate_called(name).in_expression == along;
      });
    }



    // Those within a twentieth are one.
    std::size_t n_levels(const Eigen::VectorXd &values)
    {
      constexpr double same = 1.05;

      std::vector<double> sorted;
      for (const double value : values)
        if (value > 0.)
          sorted.push_back(value);
      std::sort(sorted.begin(), sorted.end());
      std::size_t n     = 0;
      double      level = 0.;
      for (const double value : sorted)
        if (value > same * level)
          {
            level = value;
            ++n;
          }
      return n;
    }
  } // namespace



  std::vector<Rival> confounded_effects(const Workspace    &workspace,
                                        const Model        &base,
                                        const SearchResult &found)
  {
    constexpr double nearly = 0.8;

    if (effect_names(found.model.parts).size() != 1)
      return {};
    const auto is_rival = [&](const std::string &name) {
      return any_of(found.rivals,
                    [&](const Rival &rival) { return rival.name == name; });
    };
    const Part &named = found.model.parts.front();
    if (!is_condition(named.formula.along))
      return {};
    const double       gain = base.objective - found.model.objective;
    std::vector<Rival> result;
    for (const Model &first : found.first_fits.models)
      {
        const Part &other = first.parts.front();
        if (is_rival(other.name) || !is_condition(other.formula.along) ||
            other.formula.along == named.formula.along)
          continue;
        // Since then some rows may count for less.
        const std::optional<Model> alone =
          fitted_model(workspace, first.parts, first.values(), base, 0.01);
        if (alone.has_value() && !is_at_bound(*alone) &&
            base.objective - alone->objective > nearly * gain &&
            evidence_for(workspace, base, *alone).is_enough())
          result.push_back({other.name,
                            named.name,
                            penalised(*alone) - penalised(found.model),
                            *alone});
      }
    stable_sort(result, [](const Rival &a, const Rival &b) {
      return a.distance < b.distance;
    });
    return result;
  }



  std::vector<EffectsAlong> effects_along_conditions(const Workspace &workspace,
                                                     const Model     &model)
  {
    std::vector<EffectsAlong> result;
    for (const std::string &covariate : conditions_of_tests)
      {
        const Covariate &known = covariate_called(covariate);
        EffectsAlong     along;
        along.covariate = covariate;
        for (const Part &part : model.parts)
          if (part.corrects.empty() &&
              part.formula.along == known.in_expression)
            {
              along.names.push_back(part.name);
              along.n_numbers +=
                part.formula.parameters.size() + part.formula.n_in_texts;
            }
        along.n_levels = n_levels(workspace.covariates.*known.values);
        result.push_back(along);
      }
    return result;
  }



  bool fits_any_friction(const Workspace &workspace, const Model &model)
  {
    return effect_names(model.parts).size() > 2 &&
           any_of(effects_along_conditions(workspace, model),
                  [](const EffectsAlong &along) {
                    return along.names.size() > 1 &&
                           along.n_levels < along.n_numbers;
                  });
  }



  std::string confounding_words(const std::string        &name,
                                const std::vector<Rival> &confounded)
  {
    std::vector<std::string> names;
    for (const Rival &rival : confounded)
      names.push_back(rival.name);
    const std::string other =
      covariate_in_expression(
        confounded.front().model.parts.front().formula.along)
        .name;
    return "These tests hardly separate pressure from speed: " +
           list_text(names, "or") + ", which depends on " + other +
           ", alone explains nearly as much as " + name +
           " does, and only the shapes of the formulas distinguish them. Both "
           "may be missing; tests at one speed under several pressures, and "
           "at several speeds under one pressure, would separate them.";
  }
} // namespace SlipStep
