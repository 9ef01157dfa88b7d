// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/calibration/fit.h>
#include <slipstep/calibration/fit_coordinates.h>
#include <slipstep/diagnosis/left_out.h>
#include <slipstep/diagnosis/rules.h>
#include <slipstep/utilities/lists.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace SlipStep
{
  namespace
  {
    /// The parameters of an effect that was added, and how far from the present
    /// ones those of its strength leave nothing of it.
    struct Removal
    {
      std::vector<Eigen::Index> parameters;
      Eigen::VectorXd           to_nothing; ///< change of all FitCoordinates
    };



    // Of effects whose strength is in parameters of their own.
    std::vector<Removal> removals(const Model          &model,
                                  const FitCoordinates &coordinates)
    {
      const std::vector<FitParameter> &fitted = model.campaign->fitted;
      std::vector<Removal>             result;
      for (const Part &part : model.parts)
        {
          Removal removal;
          removal.to_nothing = Eigen::VectorXd::Zero(fitted.size());
          bool has_strength  = false;
          for (std::size_t i = 0; i < fitted.size(); ++i)
            {
              if (model.owner_of(fitted[i].path) != &part)
                continue;
              removal.parameters.push_back(i);
              for (const TrialFormula::Shape &shape : part.formula.shapes)
                {
                  const Values nothing = shape(0.), much = shape(1.);
                  const auto   found = nothing.find(fitted[i].path);
                  if (found == nothing.end() ||
                      found->second == much.at(found->first))
                    continue;
                  const double scaled = fitted[i].to_scaled(found->second);
                  has_strength        = true;
                  // On a logarithmic scale it is out of reach.
                  removal.to_nothing(i) =
                    (scaled > 0. ? std::min(scaled, 1.) : 0.) - model.scaled[i];
                }
            }
          if (!has_strength)
            continue;
          std::vector<double> without = model.scaled;
          for (std::size_t i = 0; i < without.size(); ++i)
            without[i] += removal.to_nothing(i);
          removal.to_nothing =
            coordinates.of(without) - coordinates.of(model.scaled);
          result.push_back(removal);
        }
      return result;
    }



    // A step of Gauss and Newton within bounds; effects without which the rows
    // would hardly be met worse are nothing after it.
    struct Step
    {
      Step(const Eigen::MatrixXd      &derivatives,
           const Eigen::VectorXd      &residual,
           const Eigen::VectorXd      &start,
           const Eigen::Index          n_rows,
           const std::vector<Removal> &removals);

      Eigen::VectorXd   step;
      std::vector<bool> is_untold;
    };



    // The least squares of the parameters that are free; what would leave its
    // bounds stays on them.
    Eigen::VectorXd bounded(const Eigen::MatrixXd &derivatives,
                            const Eigen::VectorXd &residual,
                            const Eigen::VectorXd &start,
                            Eigen::VectorXd        step,
                            std::vector<bool>      is_free)
    {
      const Eigen::Index n = step.size();
      for (Eigen::Index pass = 0; pass <= n; ++pass)
        {
          Eigen::MatrixXd told = derivatives;
          for (Eigen::Index i = 0; i < n; ++i)
            if (is_free[i])
              step(i) = 0.;
            else
              told.col(i).setZero();
          const Eigen::MatrixXd curvature = told.transpose() * told;
          step += curvature.completeOrthogonalDecomposition().solve(
            told.transpose() * (residual - derivatives * step));
          bool is_inside = true;
          for (Eigen::Index i = 0; i < n; ++i)
            {
              const double end = std::clamp(start(i) + step(i), 0., 1.);
              if (!is_free[i] || end == start(i) + step(i))
                continue;
              step(i)    = end - start(i);
              is_free[i] = false;
              is_inside  = false;
            }
          if (is_inside)
            break;
        }
      return step;
    }



    Step::Step(const Eigen::MatrixXd      &derivatives,
               const Eigen::VectorXd      &residual,
               const Eigen::VectorXd      &start,
               const Eigen::Index          n_rows,
               const std::vector<Removal> &removals)
      : is_untold(derivatives.cols(), false)
    {
      const auto step_without =
        [&](const std::vector<const Removal *> &untold) {
          Eigen::VectorXd   fixed = Eigen::VectorXd::Zero(derivatives.cols());
          std::vector<bool> is_free(fixed.size(), true);
          for (const Removal *removal : untold)
            for (const Eigen::Index i : removal->parameters)
              {
                fixed(i)   = removal->to_nothing(i);
                is_free[i] = false;
              }
          return bounded(derivatives, residual, start, fixed, is_free);
        };
      const auto squares = [&](const Eigen::VectorXd &step) {
        return (residual - derivatives * step).head(n_rows).squaredNorm();
      };
      step                               = step_without({});
      const double                 least = squares(step);
      std::vector<const Removal *> untold;
      for (const Removal &removal : removals)
        if (squares(step_without({&removal})) <
            least + cost_of_parameter * removal.parameters.size())
          untold.push_back(&removal);
      for (const Removal *removal : untold)
        for (const Eigen::Index i : removal->parameters)
          is_untold[i] = true;
      if (!untold.empty())
        step = step_without(untold);
    }



    // A model as fitted to all conditions but one, with its objective of those:
    // by one step from the optimum of all, by a fit of its own where that goes
    // far. What only the one that is left out told of an effect is nothing
    // then: it would predict itself. From then on the model simulates that
    // condition only.
    // @param is_all_told whether there was nothing of the kind
    Model fit_without(const Comparison &comparison,
                      const Model      &model,
                      const std::size_t condition,
                      bool             &is_all_told)
    {
      Eigen::MatrixXd   derivatives = model.derivatives;
      Eigen::VectorXd   residual    = model.residual;
      std::vector<bool> left_out, others;
      for (const ComparedTest &test : comparison.tests)
        {
          left_out.push_back(test.condition == condition);
          others.push_back(!left_out.back());
          if (!left_out.back())
            continue;
          derivatives.middleRows(test.begin, test.size).setZero();
          residual.segment(test.begin, test.size).setZero();
        }
      const FitCoordinates  coordinates(*model.campaign,
                                       model.scaled,
                                       all_parameters(*model.campaign));
      const Eigen::VectorXd start = coordinates.of(model.scaled);
      derivatives *= coordinates.jacobian(start);
      const Eigen::Index    n = model.scaled.size();
      const Step            newton(derivatives,
                        residual,
                        start,
                        comparison.n_rows(),
                        removals(model, coordinates));
      Eigen::VectorXd       step    = newton.step;
      Model                 result  = model.copy();
      bool                  is_near = true;
      const Eigen::VectorXd end     = (start + step).cwiseMax(0.).cwiseMin(1.);
      step                          = end - start;
      result.scaled                 = coordinates.scaled(end);
      for (Eigen::Index i = 0; i < n; ++i)
        is_near = is_near && std::abs(result.scaled[i] - model.scaled[i]) *
                                 natural_slope(model.campaign->fitted[i],
                                               model.scaled[i]) <
                               0.5;
      is_all_told = none_of(newton.is_untold, [](const bool is) { return is; });
      result.objective = (residual - derivatives * step).squaredNorm();
      if (!is_near)
        {
          for (Eigen::Index i = 0; i < n; ++i)
            if (!newton.is_untold[i])
              result.scaled[i] = model.scaled[i];
          result.simulator->is_left_out = left_out;
          comparison.fit(result, 1., left_out, newton.is_untold);
        }
      result.simulator->is_left_out = others;
      return result;
    }
  } // namespace



  LeftOut left_out(const Workspace &workspace,
                   const Model     &model,
                   Eigen::VectorXd *differences)
  {
    const Comparison     &comparison = workspace.comparison;
    constexpr std::size_t most_kept  = 4;
    const ModelKey        key(model);
    const auto            known =
      std::find_if(workspace.left_out.begin(),
                   workspace.left_out.end(),
                   [&](const auto &entry) { return entry.first == key; });
    const bool is_known = known != workspace.left_out.end();
    if (differences == nullptr && is_known)
      return known->second;
    // Of a single condition nothing is left to fit.
    constexpr double  none   = std::numeric_limits<double>::quiet_NaN();
    const std::size_t n      = comparison.conditions.size();
    const bool        is_one = n < 2;
    LeftOut           result{std::vector<double>(n, is_one ? none : 0.),
                   std::vector<double>(n, is_one ? none : 0.),
                   std::vector<char>(n, true)};
    if (differences != nullptr)
      *differences =
        Eigen::VectorXd::Constant(comparison.n_rows(), is_one ? none : 0.);
    if (is_one)
      return result;
    side_by_side(n, [&](const std::size_t c) {
      bool        is_all_told = true;
      const Model other       = fit_without(comparison, model, c, is_all_told);
      result.others_tell[c]   = is_all_told;
      Eigen::VectorXd difference = comparison.difference(other);
      result.of_others[c]        = other.objective;
      // What cannot be simulated predicts no friction at all.
      if (difference.size() == 0)
        difference = -comparison.measured;
      RowMatrix whitened = difference;
      comparison.whiten(whitened);
      for (std::size_t t = 0; t < comparison.tests.size(); ++t)
        {
          const ComparedTest &test = comparison.tests[t];
          if (test.condition != c)
            continue;
          result.squares[c] +=
            whitened.middleRows(test.begin, test.size).squaredNorm();
          if (differences != nullptr)
            differences->segment(test.begin, test.size) =
              difference.segment(test.begin, test.size);
        }
    });
    if (!is_known)
      workspace.left_out.emplace_front(key, result);
    if (workspace.left_out.size() > most_kept)
      workspace.left_out.pop_back();
    return result;
  }



  Evidence
  evidence_for(const Workspace &workspace, const Model &less, const Model &more)
  {
    const LeftOut a = left_out(workspace, less);
    const LeftOut b = left_out(workspace, more);
    Evidence      result{less.objective - more.objective};
    double        gain = 0.;
    for (std::size_t c = 0; c < a.squares.size(); ++c)
      {
        const double here = a.squares[c] - b.squares[c];
        const bool   others_ask =
          a.of_others[c] - b.of_others[c] >= least_cost || std::isnan(here);
        if (!others_ask)
          result.told_by.push_back(c);
        result.judges.push_back(others_ask || here >= 0.);
        if (result.judges.back())
          gain += here;
      }
    // What one condition alone tells of, others can only speak against.
    const bool is_known =
      none_of(result.judges, [](const bool judge) { return !judge; }) &&
      (result.told_by.size() != 1 || gain > 0.);
    if (is_known || gain <= -least_cost)
      result.left_out_gain = gain;
    return result;
  }



  bool Evidence::is_enough(const std::size_t n) const
  {
    const bool is_known = !std::isnan(left_out_gain);
    // What can be asked of other conditions has less to show.
    const double least =
      is_known || told_by.size() == 1 ? least_cost : sure_cost;
    return cost >= n * least && !(is_known && left_out_gain <= 0.);
  }



  double left_out_lead(const Workspace &workspace,
                       const Model     &base,
                       const Model     &model,
                       const Model     &other)
  {
    const LeftOut           a = left_out(workspace, model);
    const LeftOut           b = left_out(workspace, other);
    const std::vector<bool> judges_a =
      evidence_for(workspace, base, model).judges;
    const std::vector<bool> judges_b =
      evidence_for(workspace, base, other).judges;
    double lead = 0.;
    // Without a part of it no model can lead.
    for (std::size_t c = 0; c < judges_a.size(); ++c)
      if (judges_a[c] && judges_b[c] && a.others_tell[c] && b.others_tell[c])
        lead += b.squares[c] - a.squares[c];
    return lead;
  }
} // namespace SlipStep
