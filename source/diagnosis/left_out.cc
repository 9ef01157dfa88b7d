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
    // Where a parameter of what was added leaves nothing of it, and how much
    // that is believed where the tests do not tell.
    struct Belief
    {
      Eigen::VectorXd scaled, weight;
    };



    Belief belief_in_nothing(const Model &model)
    {
      constexpr double deviation = 0.5; // of what is allowed

      const std::vector<FitParameter> &fitted = model.campaign->fitted;
      const Eigen::Index               n      = fitted.size();
      Belief result{Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
      for (const Part &part : model.parts)
        for (const TrialFormula::Shape &shape : part.formula.shapes)
          {
            const Values nothing = shape(0.), much = shape(1.);
            for (Eigen::Index i = 0; i < n; ++i)
              {
                const auto found = nothing.find(fitted[i].path);
                if (found == nothing.end() ||
                    found->second == much.at(found->first))
                  continue;
                const double scaled = fitted[i].to_scaled(found->second);
                // On a logarithmic scale it is out of reach.
                result.scaled(i) = scaled > 0. ? std::min(scaled, 1.) : 0.;
                result.weight(i) = 1. / (deviation * deviation);
              }
          }
      return result;
    }



    // A model as fitted to all conditions but one, with its objective of those:
    // by one step of Gauss and Newton from the optimum of all, by a fit of its
    // own where that goes far. What only the one that is left out told of an
    // effect is nothing then: it would predict itself.
    // From then on the model simulates that condition only.
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
      // In the place of what is believed where a fit begins.
      const Belief       belief = belief_in_nothing(model);
      const Eigen::Index n      = belief.scaled.size();
      for (Eigen::Index i = 0; i < n; ++i)
        if (belief.weight(i) > 0.)
          {
            const Eigen::Index row    = comparison.n_rows() + i;
            const double       weight = std::sqrt(belief.weight(i));
            derivatives(row, i)       = weight;
            residual(row) = weight * (belief.scaled(i) - model.scaled[i]);
          }
      Model      result = model.copy();
      const auto normal = Eigen::MatrixXd(derivatives.transpose() * derivatives)
                            .completeOrthogonalDecomposition();
      const Eigen::VectorXd variances = normal.pseudoInverse().diagonal();
      Eigen::VectorXd   step = normal.solve(derivatives.transpose() * residual);
      std::vector<bool> is_untold;
      bool              is_near = true;
      for (Eigen::Index i = 0; i < n; ++i)
        {
          // What is believed of it is most of what is known.
          is_untold.push_back(variances(i) * belief.weight(i) > 0.5);
          const double slope =
            natural_slope(model.campaign->fitted[i], model.scaled[i]);
          is_near          = is_near && std::abs(step(i)) * slope < 0.5;
          result.scaled[i] = is_untold[i] ?
                               belief.scaled(i) :
                               std::clamp(model.scaled[i] + step(i), 0., 1.);
          step(i)          = result.scaled[i] - model.scaled[i];
        }
      is_all_told      = none_of(is_untold, [](const bool is) { return is; });
      result.objective = (residual - derivatives * step).squaredNorm();
      if (!is_near)
        {
          for (Eigen::Index i = 0; i < n; ++i)
            if (!is_untold[i])
              result.scaled[i] = model.scaled[i];
          result.simulator->leave_out(left_out);
          comparison.fit(result, 1., left_out, is_untold);
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
    const LeftOut     a = left_out(workspace, less);
    const LeftOut     b = left_out(workspace, more);
    std::vector<bool> result(a.squares.size(), true);
    for (const std::size_t c : conditions_that_tell(workspace, less, more))
      result[c] = a.squares[c] >= b.squares[c];
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
    const LeftOut           a        = left_out(workspace, model);
    const LeftOut           b        = left_out(workspace, other);
    const std::vector<bool> judges_a = judges(model), judges_b = judges(other);
    double                  lead = 0.;
    // Without a part of it no model can lead.
    for (std::size_t c = 0; c < judges_a.size(); ++c)
      if (judges_a[c] && judges_b[c] && a.others_tell[c] && b.others_tell[c])
        lead += b.squares[c] - a.squares[c];
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
    return gain > 0. || gain <= -least_cost ||
               conditions_that_tell(workspace, less, more).empty() ?
             gain :
             std::numeric_limits<double>::quiet_NaN();
  }
} // namespace SlipStep
