// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/look_alike.h>
#include <slipstep/diagnosis/refits.h>
#include <slipstep/diagnosis/rules.h>
#include <slipstep/diagnosis/workspace.h>
#include <slipstep/utilities/lists.h>

#include <Eigen/QR>

#include <algorithm>

namespace SlipStep
{
  namespace
  {
    using Kind = LookAlike::Kind;

    // Of the friction along the first axis.
    std::vector<CampaignTest> without(std::vector<CampaignTest> tests,
                                      const LookAlike          &look_alike)
    {
      for (CampaignTest &test : tests)
        for (std::size_t i = 0; i < test.rows.friction.size(); ++i)
          if (test.rows.pressure[i] > 0.)
            {
              const double zero = look_alike.kind == Kind::load_zero ?
                                    look_alike.value / test.rows.pressure[i] :
                                    look_alike.value;
              test.rows.friction[i] -= test.axes[0].cosine * zero;
              if (!test.rows.friction_y.empty())
                test.rows.friction_y[i] -= test.axes[0].sine * zero;
            }
      return tests;
    }



    // What a unit of it adds to the numbers compared.
    Eigen::VectorXd unit_of(const Workspace &workspace, const Kind kind)
    {
      const Covariates &at     = workspace.covariates;
      Eigen::VectorXd   result = Eigen::VectorXd::Zero(at.axis.size());
      for (Eigen::Index i = 0; i < result.size(); ++i)
        if (at.axis(i) < 0.5 && at.pressure(i) > 0.)
          result(i) = kind == Kind::load_zero ? 1. / at.pressure(i) : 1.;
      return result;
    }



    // The best one next to what a model can fit, to first order.
    double best_value(const Model &model, const RowMatrix &unit)
    {
      Eigen::MatrixXd columns(unit.rows(), model.scaled.size() + 1);
      columns << model.derivatives.topRows(unit.rows()), unit;
      return columns.completeOrthogonalDecomposition().solve(
        model.residual.head(unit.rows()))(columns.cols() - 1);
    }



    // The starting model, fitted to tests without a zero of this kind, and how
    // much of that there is.
    std::optional<Model> fit_without(const Workspace &workspace,
                                     const Model     &base,
                                     LookAlike       &look_alike)
    {
      constexpr unsigned int n_steps = 3; // it is nearly linear

      RowMatrix unit = unit_of(workspace, look_alike.kind);
      workspace.comparison.whiten(unit);
      std::optional<Model> model = base;
      for (unsigned int step = 0; step < n_steps && model.has_value(); ++step)
        {
          look_alike.value += best_value(*model, unit);
          model = if_possible([&]() -> std::optional<Model> {
            Model other = make_model(workspace.start,
                                     {},
                                     model->values(),
                                     without(workspace.tests, look_alike),
                                     base);
            if (!workspace.comparison.fit(other, 0.01))
              return std::nullopt;
            return other;
          });
        }
      return model;
    }



    /// Keeps what explains the tests best.
    class Best
    {
    public:
      Best(const Comparison &comparison,
           const Model      &base,
           const Model      &found,
           const double      excess)
        : comparison(comparison)
        , base(base)
        , found(found)
        , excess(excess)
        , least(base.objective)
      {}

      // What makes the gap has to go, too, and not by the weights of the fit
      // alone.
      void consider(const LookAlike            &look_alike,
                    const std::optional<Model> &model)
      {
        constexpr double least_gain = 4., most = 0.8;
        if (!model.has_value())
          return;
        const double gain  = base.objective - model->objective;
        const double bound = std::max(most * excess, least_gain);
        const bool   is_as_good =
          found.parts.empty() ||
          penalised(*model) <= penalised(found) + rival_distance;
        if (gain >= bound && is_as_good && model->objective < least &&
            relative_rms(comparison, *model) <= relative_rms(comparison, base))
          {
            least  = model->objective;
            result = look_alike;
          }
      }

      std::optional<LookAlike> result;

    private:
      const Comparison &comparison;
      const Model      &base, &found;
      const double      excess;
      double            least;
    };



    // Numbers of the starting model's effects that nobody fits.
    std::vector<std::string> held_parameters(const Parameters &start,
                                             const Campaign   &campaign)
    {
      std::vector<std::string> paths = {"Friction/Static coefficient"};
      for (const std::string &effect : start.list("Friction/Effects"))
        for (const std::string &path : start.paths("Friction/" + effect + "/"))
          paths.push_back(path);
      remove_erase_if(paths, [&](const std::string &path) {
        return dynamic_cast<const Quantity *>(
                 start.entry(path).pattern.get()) == nullptr ||
               lists(campaign.fitted, path) ||
               any_of(campaign.derived,
                      [&](const Derived &one) { return one.name == path; });
      });
      return paths;
    }



    // A few times larger, as far as is allowed: down to nothing and to the
    // other sign, or as many times smaller where it has to be positive.
    CandidateParameter range_of_parameter(const Parameters  &start,
                                          const std::string &path)
    {
      constexpr double few = 5.;

      const auto &allowed =
        dynamic_cast<const Quantity &>(*start.entry(path).pattern);
      const double held = start.number(path);
      const double far  = held == 0. ? 1. : few * std::abs(held);
      const bool   is_positive =
        held > 0. && allowed.minimum >= 0. &&
        (allowed.minimum > 0. || allowed.minimum_is_excluded);
      return {path,
              std::max(is_positive ? held / few : -far, allowed.minimum),
              std::min(far, allowed.maximum),
              is_positive};
    }



    // The model with one more parameter of the starting model fitted, if that
    // ends between its bounds, or at nothing where less is not allowed. In the
    // place of a name, which is a small part of the gap, it may end at any:
    // farther off is as well then.
    std::optional<Model> fit_with(const Workspace   &workspace,
                                  const Model       &base,
                                  const std::string &path,
                                  LookAlike         &look_alike)
    {
      constexpr double at_bound = 0.01;

      const CandidateParameter parameter =
        range_of_parameter(workspace.start, path);
      std::vector<Part> parts = base.parts;
      parts.push_back({"held", {}});
      parts.back().formula.parameters = {parameter};
      Values values                   = base.values();
      values[path]                    = workspace.start.number(path);
      const std::optional<Model> model =
        fitted_model(workspace, parts, values, base, 0.01);
      if (!model.has_value())
        return {};
      const double scaled = model->scaled.back();
      const bool   is_off = parameter.lower == 0. && scaled < at_bound;
      if (look_alike.instead_of.empty() && !is_off &&
          (scaled < at_bound || scaled > 1. - at_bound))
        return {};
      look_alike.value = is_off ? 0. : model->values().at(path);
      look_alike.path  = path;
      look_alike.text =
        quantity_text(workspace.start, path, look_alike.value, 3);
      look_alike.held_text = workspace.start.text(path);
      return model;
    }



    // One of several names.
    void consider_instead(Workspace        &workspace,
                          const Model      &found,
                          const std::size_t part,
                          Best             &best)
    {
      if (!found.parts[part].corrects.empty() || workspace.is_late())
        return;
      const std::optional<Model> less = refit_without(workspace, found, part);
      if (!less.has_value())
        return;
      for (const std::string &path :
           held_parameters(workspace.start, *less->campaign))
        {
          LookAlike look_alike{Kind::held_parameter};
          look_alike.instead_of = found.parts[part].name;
          const auto model      = fit_with(workspace, *less, path, look_alike);
          best.consider(look_alike, model);
        }
    }
  } // namespace



  std::optional<LookAlike> find_look_alike(Workspace   &workspace,
                                           const Model &base,
                                           const Model &found,
                                           const double excess)
  {
    Best best(workspace.comparison, base, found, excess);
    for (const Kind kind : {Kind::friction_zero, Kind::load_zero})
      {
        if (workspace.is_late())
          break;
        LookAlike  look_alike{kind};
        const auto model = fit_without(workspace, base, look_alike);
        best.consider(look_alike, model);
      }
    for (const std::string &path :
         held_parameters(workspace.start, *base.campaign))
      {
        if (workspace.is_late())
          break;
        LookAlike  look_alike{Kind::held_parameter};
        const auto model = fit_with(workspace, base, path, look_alike);
        best.consider(look_alike, model);
      }
    // Before a second name.
    const std::vector<Part> &parts = found.parts;
    if (effect_names(parts).size() > 1)
      for (std::size_t i = 0; i < parts.size(); ++i)
        consider_instead(workspace, found, i, best);
    return best.result;
  }
} // namespace SlipStep
