// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/calibration/uncertainty.h>
#include <slipstep/diagnosis/intervals.h>
#include <slipstep/diagnosis/refits.h>

#include <Eigen/Dense>

#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// Follows one parameter away from the optimum.
    class Follower
    {
    public:
      Follower(const Workspace  &workspace,
               const Model      &optimum,
               const std::size_t parameter,
               const double      threshold)
        : workspace(workspace)
        , optimum(optimum)
        , parameter(parameter)
        , threshold(threshold)
        , held(optimum.scaled.size(), false)
      {
        held[parameter] = true;
        // Where the others go to first order.
        Eigen::MatrixXd others = optimum.derivatives;
        others.col(parameter).setZero();
        slopes = -others.completeOrthogonalDecomposition().solve(
          optimum.derivatives.col(parameter));
        slopes(parameter) = 1.;
      }

      RiseEnd follow(const int sign, const double deviation)
      {
        model              = optimum;
        model.simulator    = std::make_shared<Simulator>(*optimum.simulator);
        const double  at   = optimum.scaled[parameter];
        const double  room = sign > 0 ? 1. - at : at;
        const RiseEnd end  = follow_rise(
          [&](const double distance) { return rise(at + sign * distance); },
          std::min(room, std::max(1e-4, deviation * std::sqrt(threshold))),
          room);
        // So that the curve can be drawn.
        for (const double share : {0.3, 0.6, 0.85})
          rise(at + sign * share * end.distance);
        return end;
      }

      std::vector<std::pair<double, double>> points; ///< scaled, objective

    private:
      double rise(const double scaled)
      {
        const double distance = scaled - optimum.scaled[parameter];
        for (std::size_t i = 0; i < model.scaled.size(); ++i)
          model.scaled[i] =
            std::clamp(optimum.scaled[i] + distance * slopes(i), 0., 1.);
        if (!workspace.comparison.fit(model, 0.005, {}, held))
          {
            model.scaled = optimum.scaled;
            return std::numeric_limits<double>::infinity();
          }
        const double increase = model.objective - optimum.objective;
        points.emplace_back(scaled, increase);
        return std::max(0., increase / threshold);
      }

      const Workspace  &workspace;
      const Model      &optimum;
      Model             model;
      const std::size_t parameter;
      const double      threshold;
      std::vector<bool> held;
      Eigen::VectorXd   slopes; ///< of all, per distance
    };



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



    void follow_both_ways(const Workspace    &workspace,
                          const Model        &model,
                          const std::size_t   i,
                          const double        deviation,
                          const double        threshold,
                          DiagnosedParameter &result)
    {
      const FitParameter &parameter = model.campaign->fitted[i];
      Follower            follower(workspace, model, i, threshold);
      const RiseEnd       below = follower.follow(-1, deviation);
      const RiseEnd       above = follower.follow(1, deviation);
      const auto          value = [&](const double scaled) {
        return parameter.in_unit(parameter.from_scaled(scaled));
      };
      result.lower         = value(model.scaled[i] - below.distance);
      result.upper         = value(model.scaled[i] + above.distance);
      result.is_lower_open = below.is_open;
      result.is_upper_open = above.is_open;
      result.profile.emplace_back(result.value, 0.);
      for (const auto &point : follower.points)
        result.profile.emplace_back(value(point.first), point.second);
      std::sort(result.profile.begin(), result.profile.end());
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
      out.before = parameter.in_unit(parameter.start);
      Simulator simulator(*model.campaign);
      out.is_at_bound =
        model.scaled[i] < 1e-6 || model.scaled[i] > 1. - 1e-6 ||
        !simulator.condition_beside(model.scaled, i, -1.).empty() ||
        !simulator.condition_beside(model.scaled, i, 1.).empty();
      if (part != nullptr)
        {
          out.effect = part->name;
          follow_both_ways(workspace,
                           model,
                           i,
                           scatter.deviations(i),
                           std::pow(scatter.reach[i], 2),
                           out);
          // Those of the starting model have a value before, too.
          if (workspace.start.text("Calibration/Parameters")
                .find(parameter.path + " ") == std::string::npos)
            out.before = std::numeric_limits<double>::quiet_NaN();
          return;
        }
      const double half = scatter.reach[i] * scatter.deviations(i);
      out.lower         = value(model.scaled[i] - half);
      out.upper         = value(model.scaled[i] + half);
      out.is_lower_open = model.scaled[i] - half < 0.;
      out.is_upper_open = model.scaled[i] + half > 1.;
    });
    return result;
  }
} // namespace SlipStep
