// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/correction.h>
#include <slipstep/diagnosis/ingest.h>
#include <slipstep/utilities/exceptions.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>

namespace SlipStep
{
  namespace
  {
    constexpr unsigned int n_knots = 6;

    /// A covariate that effect 'expression' knows.
    struct Covariate
    {
      std::string     key;
      Eigen::VectorXd x; ///< NaN where there is none
    };



    std::optional<Covariate> covariate_of(const Workspace   &workspace,
                                          const std::string &name)
    {
      const Covariates     &covariates = workspace.covariates;
      const Eigen::VectorXd values     = values_of(covariates, name);
      if (name == "speed")
        return Covariate{"log10 speed", values.unaryExpr([](const double v) {
                           return v > 0. ?
                                    std::log10(v) :
                                    std::numeric_limits<double>::quiet_NaN();
                         })};
      if (name == "pressure" || name == "path")
        return Covariate{name, values};
      return {};
    }



    std::vector<double> knots_of(const Eigen::VectorXd &x)
    {
      std::vector<double> values;
      for (const double value : x)
        if (std::isfinite(value))
          values.push_back(value);
      std::sort(values.begin(), values.end());
      std::vector<double> knots;
      if (values.empty() || !(values.back() > values.front()))
        return knots;
      for (unsigned int k = 0; k < n_knots; ++k)
        knots.push_back(values.front() +
                        (values.back() - values.front()) * k / (n_knots - 1.));
      return knots;
    }



    // Hat functions around the knots, constant beyond them.
    double
    hat(const std::vector<double> &knots, const std::size_t k, const double x)
    {
      const double at    = std::clamp(x, knots.front(), knots.back());
      const double width = knots[1] - knots[0];
      return std::max(0., 1. - std::abs(at - knots[k]) / width);
    }



    // 1 + corrections, piecewise linear: a sum of max(0, x - x_k).
    std::string formula_of(const std::vector<double> &knots,
                           const Eigen::VectorXd     &corrections)
    {
      std::ostringstream out;
      out.imbue(std::locale::classic());
      out << std::setprecision(5) << 1. + corrections(0);
      double slope = 0.;
      for (std::size_t k = 0; k + 1 < knots.size(); ++k)
        {
          const double next =
            (corrections(k + 1) - corrections(k)) / (knots[k + 1] - knots[k]);
          out << " + (" << next - slope << ") * max(0, x - (" << knots[k]
              << "))";
          slope = next;
        }
      return out.str();
    }



    std::string number(const double value)
    {
      std::ostringstream out;
      out.imbue(std::locale::classic());
      out << std::setprecision(10) << value;
      return out.str();
    }



    // How strong the hats are in the correction that explains most.
    Eigen::VectorXd smooth_corrections(const Workspace           &workspace,
                                       const Model               &base,
                                       const Eigen::VectorXd     &x,
                                       const std::vector<double> &knots)
    {
      std::vector<Direction> directions(n_knots);
      for (unsigned int k = 0; k < n_knots; ++k)
        directions[k].friction =
          x.unaryExpr([&](const double value) {
             return std::isfinite(value) ? hat(knots, k, value) : 0.;
           })
            .cwiseProduct(workspace.covariates.friction);
      Eigen::VectorXd result =
        ScoreTest(workspace.comparison, base, workspace.null_draws, directions)
          .mixture(0.01);
      // What is the same everywhere belongs to the coefficients.
      result.array() -= result.mean();
      return result.cwiseMax(-0.9).cwiseMin(3.);
    }



    std::optional<Correction> correct_along(const Workspace   &workspace,
                                            const Model       &base,
                                            const Judgement   &judgement,
                                            const std::string &name)
    {
      const std::optional<Covariate> covariate = covariate_of(workspace, name);
      if (!covariate.has_value())
        return {};
      const std::vector<double> knots = knots_of(covariate->x);
      if (knots.empty())
        return {};
      Correction result;
      result.covariate = covariate->key;
      result.formula =
        formula_of(knots,
                   smooth_corrections(workspace, base, covariate->x, knots));
      TrialFormula formula;
      formula.effect = "expression";
      formula.texts  = {{"Friction/expression/Covariate", result.covariate},
                        {"Friction/expression/Formula", result.formula},
                        {"Friction/expression/From", number(knots.front())},
                        {"Friction/expression/To", number(knots.back())}};
      auto model     = if_possible([&]() -> std::optional<Model> {
        return make_model(workspace.start,
                          {{"expression", formula}},
                          base.values(),
                          workspace.tests,
                          &base);
      });
      if (!model.has_value())
        return {};
      result.model = std::move(*model);
      if (!workspace.comparison.fit(result.model, 0.05))
        return {};
      const GapTest after =
        test_gap(workspace.comparison,
                 workspace.covariates,
                 result.model,
                 workspace.null_draws,
                 smooth_directions(workspace, judgement.view));
      result.share = judgement.gap.excess > 0. ?
                       1. - after.excess / judgement.gap.excess :
                       0.;
      return result;
    }
    // What names have to show, and no worse in per cent of friction either.
    bool is_an_improvement(const Workspace &workspace,
                           const Model     &base,
                           const Model     &corrected)
    {
      if (!is_needed(base.objective - corrected.objective,
                     left_out_gain(workspace, base, corrected)))
        return false;
      const Comparison &comparison = workspace.comparison;
      const auto        rms        = [&](const Model &model) {
        return relative_rms(comparison,
                            comparison.difference(*model.simulator,
                                                  model.scaled));
      };
      const auto left_out_rms = [&](const Model &model) {
        Eigen::VectorXd differences;
        left_out_squares(workspace, model, &differences);
        return relative_rms(comparison, differences);
      };
      return rms(corrected) < rms(base) &&
             (comparison.conditions.size() < 2 ||
              left_out_rms(corrected) < left_out_rms(base));
    }
  } // namespace



  std::optional<Correction>
  find_correction(const Workspace                 &workspace,
                  const Model                     &base,
                  const Judgement                 &judgement,
                  const std::vector<Localisation> &where)
  {
    constexpr double least_share = 0.5;

    const std::vector<std::string> effects =
      workspace.start.list("Friction/Effects");
    if (std::find(effects.begin(), effects.end(), "expression") !=
        effects.end())
      return {};
    for (const Localisation &place : where)
      {
        const std::optional<Correction> correction =
          correct_along(workspace, base, judgement, place.covariate);
        if (correction.has_value())
          return correction->share >= least_share &&
                     is_an_improvement(workspace, base, correction->model) ?
                   correction :
                   std::nullopt;
      }
    return {};
  }
} // namespace SlipStep
