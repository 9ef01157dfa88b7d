// SPDX-License-Identifier: LGPL-2.1-or-later
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
    // A model as fitted to all conditions but one, with its objective of those:
    // by one step of Gauss and Newton from the optimum of all, by a fit of its
    // own where that goes far. From then on it simulates that condition only.
    Model fit_without(const Comparison &comparison,
                      const Model      &model,
                      const std::size_t condition)
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
      Model                 result    = model.copy();
      const Eigen::MatrixXd curvature = derivatives.transpose() * derivatives;
      Eigen::VectorXd step = curvature.completeOrthogonalDecomposition().solve(
        derivatives.transpose() * residual);
      bool is_near = true;
      for (std::size_t i = 0; i < result.scaled.size(); ++i)
        {
          const double slope =
            natural_slope(model.campaign->fitted[i], model.scaled[i]);
          is_near          = is_near && std::abs(step(i)) * slope < 0.5;
          result.scaled[i] = std::clamp(result.scaled[i] + step(i), 0., 1.);
          step(i)          = result.scaled[i] - model.scaled[i];
        }
      result.objective = (residual - derivatives * step).squaredNorm();
      if (!is_near)
        {
          result.scaled = model.scaled;
          result.simulator->leave_out(left_out);
          comparison.fit(result, 1., left_out);
        }
      result.simulator->leave_out(others);
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
                   std::vector<double>(n, is_one ? none : 0.)};
    if (differences != nullptr)
      *differences =
        Eigen::VectorXd::Constant(comparison.n_rows(), is_one ? none : 0.);
    if (is_one)
      return result;
    side_by_side(n, [&](const std::size_t c) {
      const Model           other      = fit_without(comparison, model, c);
      const Eigen::VectorXd difference = comparison.difference(other);
      result.of_others[c]              = other.objective;
      if (difference.size() == 0)
        return;
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



  std::vector<std::size_t> conditions_that_tell(const Workspace &workspace,
                                                const Model     &less,
                                                const Model     &more)
  {
    const std::vector<double> a = left_out(workspace, less).of_others;
    const std::vector<double> b = left_out(workspace, more).of_others;
    std::vector<std::size_t>  result;
    for (std::size_t c = 0; c < a.size(); ++c)
      if (a[c] - b[c] < least_cost)
        result.push_back(c);
    return result;
  }



  std::vector<bool> conditions_that_judge(const Workspace &workspace,
                                          const Model     &less,
                                          const Model     &more)
  {
    std::vector<bool> result(workspace.comparison.conditions.size(), true);
    for (const std::size_t c : conditions_that_tell(workspace, less, more))
      result[c] = false;
    return result;
  }



  double left_out_lead(const Workspace &workspace,
                       const Model     &base,
                       const Model     &model,
                       const Model     &other)
  {
    const auto judges = [&](const Model &more) {
      return conditions_that_judge(workspace, base, more);
    };
    const std::vector<double> of_a     = left_out(workspace, model).squares;
    const std::vector<double> of_b     = left_out(workspace, other).squares;
    const std::vector<bool>   judges_a = judges(model);
    const std::vector<bool>   judges_b = judges(other);
    double                    lead     = 0.;
    for (std::size_t c = 0; c < of_a.size(); ++c)
      if (judges_a[c] && judges_b[c])
        lead += of_b[c] - of_a[c];
    return lead;
  }



  double left_out_gain(const Workspace &workspace,
                       const Model     &less,
                       const Model     &more)
  {
    const LeftOut           a = left_out(workspace, less);
    const LeftOut           b = left_out(workspace, more);
    const std::vector<bool> judges =
      conditions_that_judge(workspace, less, more);
    double gain = 0.;
    for (std::size_t c = 0; c < judges.size(); ++c)
      if (judges[c])
        gain += a.squares[c] - b.squares[c];
    // What one condition alone tells of, others can only speak against.
    return none_of(judges, [](const bool judge) { return !judge; }) ||
               gain <= -least_cost ?
             gain :
             std::numeric_limits<double>::quiet_NaN();
  }
} // namespace SlipStep
