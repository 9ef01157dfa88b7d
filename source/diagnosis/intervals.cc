// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/calibration/profile_side.h>
#include <slipstep/diagnosis/findings.h>
#include <slipstep/diagnosis/refits.h>

#include <Eigen/Dense>

#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace SlipStep
{
  namespace
  {
    /// How far noise moves the parameters, to first order.
    struct Scatter
    {
      Eigen::VectorXd deviations; ///< standard, if the noise were known
      /// Of so many of them is an interval of the confidence asked for: by
      /// draws in which the noise is as uncertain as it is, and never fewer
      /// than by a normal distribution.
      std::vector<double> reach;
    };

    Scatter scatter_of(const Workspace &workspace,
                       const Model     &model,
                       const double     confidence)
    {
      const Eigen::MatrixXd inverse =
        (model.derivatives.transpose() * model.derivatives)
          .completeOrthogonalDecomposition()
          .pseudoInverse();
      const RowMatrix      &draws = workspace.null_draws;
      const Eigen::MatrixXd moved =
        inverse * (model.derivatives.topRows(draws.rows()).transpose() * draws);
      const double least =
        boost::math::quantile(boost::math::normal(), (1. + confidence) / 2.);
      Scatter result;
      result.deviations = inverse.diagonal().cwiseMax(0.).cwiseSqrt();
      for (Eigen::Index i = 0; i < inverse.rows(); ++i)
        {
          std::vector<double> distances;
          for (Eigen::Index draw = 0; draw < moved.cols(); ++draw)
            distances.push_back(std::abs(moved(i, draw)) /
                                std::max(result.deviations(i), 1e-300));
          const auto place =
            distances.begin() +
            static_cast<std::ptrdiff_t>(confidence * (distances.size() - 1));
          std::nth_element(distances.begin(), place, distances.end());
          result.reach.push_back(std::max(least, *place));
        }
      return result;
    }



    // Where the others go to first order.
    Eigen::VectorXd slopes_of(const Model &optimum, const std::size_t parameter)
    {
      Eigen::MatrixXd others = optimum.derivatives;
      others.col(parameter).setZero();
      return -others.completeOrthogonalDecomposition().solve(
        optimum.derivatives.col(parameter));
    }



    ProfileInterval follow_both_ways(const Workspace  &workspace,
                                     const Model      &optimum,
                                     const std::size_t i,
                                     const double      deviation,
                                     const double      threshold)
    {
      std::vector<bool> held(optimum.scaled.size(), false);
      held[i] = true;
      ProfileInterval result;
      result.value   = optimum.scaled[i];
      result.profile = {{result.value, 0.}};
      for (const int sign : {-1, 1})
        {
          Model       model = optimum.copy();
          ProfileSide side(
            [&](const std::vector<double> &from) {
              model.scaled = from;
              workspace.comparison.fit(model, 0.005, {}, held);
              return ProfileSide::Fitted{model.objective, model.scaled};
            },
            {optimum.objective, optimum.scaled},
            slopes_of(optimum, i),
            i,
            threshold,
            sign,
            workspace.comparison.deadline);
          side.follow(std::max(1e-4, deviation * std::sqrt(threshold)));
          side.look_at({0.3, 0.6, 0.85});
          side.add_to(result);
        }
      for (auto &point : result.profile)
        point.second *= threshold;
      const FitParameter &parameter = optimum.campaign->fitted[i];
      return result.converted([&](const double scaled) {
        return parameter.in_unit(parameter.from_scaled(scaled));
      });
    }
  } // namespace



  std::vector<DiagnosedParameter> find_intervals(const Workspace &workspace,
                                                 const Model     &model,
                                                 const double     confidence)
  {
    const Scatter scatter = scatter_of(workspace, model, confidence);
    std::vector<DiagnosedParameter> result(model.scaled.size());
    side_by_side(model.scaled.size(), [&](const std::size_t i) {
      const FitParameter &parameter = model.campaign->fitted[i];
      const Part         *part      = model.owner_of(parameter.path);
      DiagnosedParameter &out       = result[i];
      out.path                      = parameter.path;
      out.name                      = parameter.name;
      out.unit                      = parameter.unit();
      const auto value              = [&](const double scaled) {
        return parameter.in_unit(
          parameter.from_scaled(std::clamp(scaled, 0., 1.)));
      };
      out.value  = value(model.scaled[i]);
      out.least  = value(0.);
      out.most   = value(1.);
      out.before = parameter.in_unit(parameter.start);
      Simulator simulator(*model.campaign);
      out.is_at_bound =
        is_on_bound(model.scaled[i]) ||
        !simulator.condition_beside(model.scaled, i, -1.).empty() ||
        !simulator.condition_beside(model.scaled, i, 1.).empty();
      const double half = scatter.reach[i] * scatter.deviations(i);
      out.lower         = value(model.scaled[i] - half);
      out.upper         = value(model.scaled[i] + half);
      out.is_lower_open = model.scaled[i] - half < 0.;
      out.is_upper_open = model.scaled[i] + half > 1.;
      if (part == nullptr)
        return;
      out.effect = part->name;
      // Those of the starting model have a value before, too.
      if (workspace.start.text("Calibration/Parameters")
            .find(parameter.path + " ") == std::string::npos)
        out.before = std::numeric_limits<double>::quiet_NaN();
      try
        {
          static_cast<ProfileInterval &>(out) =
            follow_both_ways(workspace,
                             model,
                             i,
                             scatter.deviations(i),
                             std::pow(scatter.reach[i], 2));
        }
      catch (const OutOfTime &)
        {
          // The curvature has to do.
        }
    });
    return result;
  }
} // namespace SlipStep
