// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/calibration/fit.h>
#include <slipstep/calibration/fit_coordinates.h>
#include <slipstep/calibration/row_matrix.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/lists.h>

#include <boost/random/sobol.hpp>
#include <boost/random/uniform_01.hpp>

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace SlipStep
{
  namespace
  {
    /// Simulates for CampaignCost, and is asked before it: what Ceres is
    /// refused it puts into words, row by row, and a million take seconds. This
    /// has one row, which is zero.
    class SimulatedCampaign : public ceres::CostFunction
    {
    public:
      /// @param start of the coordinates; those not named stay
      SimulatedCampaign(Simulator                       &simulator,
                        const FitCoordinates            &coordinates,
                        const Eigen::VectorXd           &start,
                        const std::vector<unsigned int> &free)
        : residuals(simulator.campaign.n_residuals())
        , derivatives(residuals.size(), free.size())
        , simulator(simulator)
        , coordinates(coordinates)
        , start(start)
        , free(free)
      {
        set_num_residuals(1);
        mutable_parameter_block_sizes()->push_back(free.size());
      }

      // False where the law refuses the values or a test cannot be simulated:
      // the step is then made smaller.
      virtual bool Evaluate(double const *const *values,
                            double              *zero,
                            double             **jacobians) const override
      {
        Eigen::VectorXd point = start;
        for (std::size_t i = 0; i < free.size(); ++i)
          point(free[i]) = values[0][i];
        *zero = 0.;
        return if_possible([&]() {
          throw_if_stopped();
          simulator.residuals(coordinates.scaled(point), residuals.data());
          if (jacobians != nullptr && jacobians[0] != nullptr)
            {
              find_derivatives(point);
              std::fill_n(jacobians[0], free.size(), 0.);
            }
          return true;
        });
      }

      mutable std::vector<double> residuals;
      mutable RowMatrix           derivatives;

    private:
      // By those of the scaled values that the free coordinates move.
      void find_derivatives(const Eigen::VectorXd &point) const
      {
        const Eigen::MatrixXd     all = coordinates.jacobian(point);
        std::vector<unsigned int> moved;
        for (unsigned int i = 0; i < all.rows(); ++i)
          if (any_of(free,
                     [&](const unsigned int j) { return all(i, j) != 0.; }))
            moved.push_back(i);
        RowMatrix       by_scaled(residuals.size(), moved.size());
        Eigen::MatrixXd jacobian(moved.size(), free.size());
        for (std::size_t i = 0; i < moved.size(); ++i)
          for (std::size_t j = 0; j < free.size(); ++j)
            jacobian(i, j) = all(moved[i], free[j]);
        simulator.derivatives(coordinates.scaled(point),
                              moved,
                              residuals.data(),
                              by_scaled.data());
        derivatives.noalias() = by_scaled * jacobian;
      }

      Simulator                      &simulator;
      const FitCoordinates           &coordinates;
      const Eigen::VectorXd           start;
      const std::vector<unsigned int> free;
    };



    /// Residuals of the campaign as a function of the free parameters.
    class CampaignCost : public ceres::CostFunction
    {
    public:
      explicit CampaignCost(const SimulatedCampaign &simulated)
        : simulated(simulated)
      {
        set_num_residuals(simulated.residuals.size());
        *mutable_parameter_block_sizes() = simulated.parameter_block_sizes();
      }

      virtual bool Evaluate(double const *const *,
                            double  *residuals,
                            double **jacobians) const override
      {
        std::copy(simulated.residuals.begin(),
                  simulated.residuals.end(),
                  residuals);
        if (jacobians != nullptr && jacobians[0] != nullptr)
          std::copy_n(simulated.derivatives.data(),
                      simulated.derivatives.size(),
                      jacobians[0]);
        return true;
      }

    private:
      const SimulatedCampaign &simulated;
    };



    /// Ends a fit behind its deadline, unless it is likely to end soon.
    class Deadline : public ceres::IterationCallback
    {
    public:
      explicit Deadline(const std::chrono::steady_clock::time_point deadline)
        : deadline(deadline)
      {}

      virtual ceres::CallbackReturnType
      operator()(const ceres::IterationSummary &now) override
      {
        return now.iteration >= usual_iterations &&
                   std::chrono::steady_clock::now() > deadline ?
                 ceres::SOLVER_TERMINATE_SUCCESSFULLY :
                 ceres::SOLVER_CONTINUE;
      }

    private:
      static constexpr int usual_iterations = 20;

      const std::chrono::steady_clock::time_point deadline;
    };



    std::string reason(const ceres::Solver::Summary &summary)
    {
      if (summary.termination_type == ceres::USER_SUCCESS)
        return "its time was over";
      if (summary.termination_type == ceres::NO_CONVERGENCE)
        return "the largest number of iterations was reached";
      // "Function tolerance reached. |cost_change|/cost: ..."
      const std::string &message = summary.message;
      return message.substr(0, message.find('.'));
    }



    // With the steps as they are planned.
    void solve(Simulator                                  &simulator,
               const FitCoordinates                       &coordinates,
               const std::vector<unsigned int>            &free,
               const double                                precision,
               const std::chrono::steady_clock::time_point deadline,
               FitResult                                  &result)
    {
      // A start that the law refuses is no error of Ceres' to be printed.
      static const bool is_quiet =
        (FLAGS_minloglevel = google::GLOG_FATAL) == google::GLOG_FATAL;
      (void)is_quiet;

      Eigen::VectorXd     point = coordinates.of(result.scaled);
      std::vector<double> values;
      for (const unsigned int i : free)
        values.push_back(point(i));

      ceres::Problem problem;
      auto          *simulated =
        new SimulatedCampaign(simulator, coordinates, point, free);
      problem.AddResidualBlock(simulated, nullptr, values.data());
      problem.AddResidualBlock(new CampaignCost(*simulated),
                               nullptr,
                               values.data());
      for (std::size_t i = 0; i < free.size(); ++i)
        {
          problem.SetParameterLowerBound(values.data(), i, 0.);
          problem.SetParameterUpperBound(values.data(), i, 1.);
        }

      ceres::Solver::Options options;
      options.linear_solver_type                = ceres::DENSE_QR;
      options.logging_type                      = ceres::SILENT;
      options.num_threads                       = 1;
      options.max_num_iterations                = 100;
      options.max_num_consecutive_invalid_steps = 20;
      options.function_tolerance                = precision;
      options.gradient_tolerance                = 1e-14;
      options.parameter_tolerance               = 1e-3 * std::sqrt(precision);
      // Ceres tries each step with bounds by a search along it; not by cubics,
      // which need all derivatives at each point.
      options.line_search_interpolation_type = ceres::QUADRATIC;
      Deadline callback(deadline);
      options.callbacks.push_back(&callback);
      ceres::Solver::Summary summary;
      ceres::Solve(options, &problem, &summary);

      for (std::size_t i = 0; i < free.size(); ++i)
        point(free[i]) = values[i];
      result.scaled = coordinates.scaled(point);
      result.misfit = summary.IsSolutionUsable() ?
                        2. * summary.final_cost :
                        std::numeric_limits<double>::infinity();
      result.iterations += summary.iterations.size();
      result.converged = summary.termination_type == ceres::CONVERGENCE;
      result.message   = reason(summary);
    }



    // At a bound Ceres cuts a step, and so holds up what the others would do:
    // they are fitted by themselves, and then all once more, since a bound may
    // be left again.
    void solve_at_bounds(Simulator                                  &simulator,
                         const std::vector<unsigned int>            &free,
                         const double                                precision,
                         const std::chrono::steady_clock::time_point deadline,
                         FitResult                                  &result)
    {
      constexpr unsigned int most = 5;

      const FitCoordinates coordinates(simulator.campaign, result.scaled, free);
      solve(simulator, coordinates, free, precision, deadline, result);
      const auto improve = [&](const std::vector<unsigned int> &some) {
        FitResult better = result;
        solve(simulator, coordinates, some, precision, deadline, better);
        result.iterations = better.iterations;
        if (!(better.misfit < result.misfit))
          return false;
        const double gain = result.misfit - better.misfit;
        result            = better;
        return gain > precision * result.misfit;
      };
      const auto is_late = [&]() {
        return std::chrono::steady_clock::now() > deadline;
      };
      for (unsigned int n = 0; n < most; ++n)
        {
          const Eigen::VectorXd     point = coordinates.of(result.scaled);
          std::vector<unsigned int> inside;
          for (const unsigned int i : free)
            if (point(i) > 0. && point(i) < 1.)
              inside.push_back(i);
          if (inside.empty() || inside.size() == free.size() || is_late() ||
              !improve(inside) || is_late() || !improve(free))
            return;
        }
    }
  } // namespace



  FitResult fit(Simulator                                  &simulator,
                const std::vector<double>                  &scaled_start,
                const std::vector<unsigned int>            &free,
                const unsigned int                          replans,
                const std::chrono::steady_clock::time_point deadline)
  {
    FitResult result;
    result.scaled = scaled_start;
    if (free.empty())
      {
        try
          {
            result.misfit    = simulator.misfit(result.scaled);
            result.converged = true;
          }
        catch (const InputError &error)
          {
            result.message = error.what();
          }
        return result;
      }
    if (replans > 0)
      simulator.plan(result.scaled);
    solve_at_bounds(
      simulator, free, replans > 0 ? 1e-5 : 1e-9, deadline, result);
    for (unsigned int n = 0; n < replans; ++n)
      {
        const std::vector<double> before = result.scaled;
        simulator.plan(result.scaled);
        solve_at_bounds(simulator, free, 1e-7, deadline, result);
        double moved = 0.;
        for (const unsigned int i : free)
          moved = std::max(moved, std::abs(result.scaled[i] - before[i]));
        if (moved < 1e-3)
          break;
      }
    return result;
  }



  std::vector<unsigned int> all_parameters(const Campaign &campaign)
  {
    std::vector<unsigned int> all(campaign.fitted.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }



  FitResult fit_exactly(Simulator                 &simulator,
                        const Campaign            &campaign,
                        const std::vector<double> &scaled_start,
                        const std::chrono::steady_clock::time_point deadline)
  {
    const std::vector<unsigned int> all = all_parameters(campaign);
    FitResult                       result;
    try
      {
        result = fit(simulator, scaled_start, all, 2, deadline);
        if (!std::isfinite(result.misfit))
          return result;
        const unsigned int iterations = result.iterations;
        simulator.plan(result.scaled);
        simulator.correct(result.scaled);
        result = fit(simulator, result.scaled, all, 0, deadline);
        result.iterations += iterations;
      }
    catch (const InputError &error)
      {
        result.message = error.what();
      }
    catch (const RunError &error)
      {
        result.message = error.what();
      }
    return result;
  }



  std::vector<std::vector<double>> spread_starts(const Campaign    &campaign,
                                                 const unsigned int n_starts)
  {
    std::vector<std::vector<double>> starts = {campaign.scaled_start()};
    Simulator                        simulator(campaign);
    boost::random::sobol             sobol(campaign.fitted.size());
    boost::random::uniform_01<>      uniform;
    for (unsigned int trial = 0;
         starts.size() < n_starts && trial < 20 * n_starts;
         ++trial)
      {
        // Not on the bounds, where a law may be an extreme one.
        std::vector<double> point;
        for (std::size_t i = 0; i < campaign.fitted.size(); ++i)
          point.push_back(0.05 + 0.9 * uniform(sobol));
        try
          {
            const FrictionLaw law(simulator.with(point));
            starts.push_back(point);
          }
        catch (const InputError &)
          {}
      }
    return starts;
  }
} // namespace SlipStep
