// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/calibration/advice.h>
#include <slipstep/calibration/calibrate.h>
#include <slipstep/calibration/fit.h>
#include <slipstep/calibration/profile_side.h>
#include <slipstep/experiment/stability.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/measured_data/test_set.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/process.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <numeric>

namespace SlipStep
{
  namespace
  {
    using Report = std::function<void(const std::string &, const double)>;

    // Why a start has no end.
    const std::string no_time = "Calibration/Most time was over";

    /// The work of a calibration, step by step.
    class Calibrator
    {
    public:
      Calibrator(const Parameters &parameters, const Report &progress);

      Calibration run();

      std::string reason_of_jumps(const std::string &failure) const;

    private:
      void search();

      std::vector<double> keep_start();

      void correct_steps();

      std::vector<double> follow_profiles();

      void find_intervals();

      void describe_surroundings();

      void keep_profile(const std::size_t i, const Profile &profile);

      DerivedQuantity derived_quantity(const Derived &quantity);

      void derive();

      void find_constraints();

      void warn();

      void warn_of_time();

      void warn_of_misfit();

      bool noise_is_stated() const;

      std::string noise_words(const double some) const;

      void warn_of_few_tests();

      void tell(const std::string &text, const double share);

      double confidence() const
      {
        return campaign.parameters.number("Calibration/Confidence");
      }

      const Campaign                              campaign;
      const Report                                progress;
      const std::chrono::steady_clock::time_point end_of_search, deadline;
      std::mutex                                  mutex;

      std::vector<double>        best;
      std::unique_ptr<Simulator> planned; ///< at the optimum
      Linearisation              optimum;
      std::vector<char>          is_symmetric; ///< for want of time
      Calibration                result;
    };



    std::vector<double> values_of(const Campaign            &campaign,
                                  const std::vector<double> &scaled)
    {
      std::vector<double> values;
      for (std::size_t i = 0; i < scaled.size(); ++i)
        values.push_back(campaign.fitted[i].from_scaled(scaled[i]));
      return values;
    }



    Calibrator::Calibrator(const Parameters &parameters, const Report &progress)
      : campaign(parameters)
      , progress(progress)
      , end_of_search(
          deadline_after(0.5 * parameters.number("Calibration/Most time")))
      , deadline(deadline_after(parameters.number("Calibration/Most time")))
    {}



    void Calibrator::tell(const std::string &text, const double share)
    {
      const std::lock_guard<std::mutex> lock(mutex);
      if (progress)
        progress(text, share);
    }



    // "; sliding at 1 mm/s has no stable branch", with the values of the case.
    std::string Calibrator::reason_of_jumps(const std::string &failure) const
    {
      if (failure.find("time step") == std::string::npos)
        return "";
      std::vector<double> speeds;
      for (const CampaignTest &test : campaign.tests)
        if (const double speed = mean_speed(test.rows); speed > 0.)
          speeds.push_back(speed);
      const std::string why =
        why_no_branch(FrictionLaw(campaign.parameters),
                      speeds,
                      typical_pressure(campaign.tests.front().rows));
      return (why.empty() ? "" : "; ") + why;
    }



    void Calibrator::search()
    {
      const auto starts =
        spread_starts(campaign,
                      campaign.parameters.integer("Calibration/Starts"));
      std::vector<FitResult>    found(starts.size());
      std::atomic<unsigned int> n_done{0}, n_simulations{0};
      side_by_side(starts.size(), [&](const std::size_t i) {
        if (i > 0 && std::chrono::steady_clock::now() > end_of_search)
          {
            found[i].message = no_time;
            return;
          }
        Simulator simulator(campaign);
        found[i] = fit_exactly(simulator, campaign, starts[i], deadline);
        n_simulations += simulator.n_simulations();
        ++n_done;
        tell(std::to_string(n_done) + " of " + std::to_string(starts.size()) +
               " starts searched",
             0.6 * n_done / starts.size());
      });
      result.n_simulations += n_simulations;
      throw_if_stopped();

      std::size_t first = 0;
      for (std::size_t i = 0; i < starts.size(); ++i)
        {
          const FitResult &end = found[i];
          result.starts.push_back({values_of(campaign, starts[i]),
                                   std::isfinite(end.misfit) ?
                                     values_of(campaign, end.scaled) :
                                     std::vector<double>(),
                                   end.misfit,
                                   end.iterations,
                                   end.message});
          if (end.misfit < found[first].misfit)
            first = i;
        }
      if (!std::isfinite(found[first].misfit))
        throw RunError("no start of the search can be simulated: " +
                       found.front().message);
      best = found[first].scaled;
      if (!found[first].converged)
        result.warnings.push_back(
          "The search did not converge: " + found[first].message + ".");
      stable_sort(result.starts,
                  [](const StartResult &a, const StartResult &b) {
                    return a.misfit < b.misfit;
                  });
    }



    // The steps of a search are chosen for speed: without their error, until
    // the parameters stay within a tenth of their standard deviations.
    void Calibrator::correct_steps()
    {
      planned->plan(best);
      for (unsigned int n = 0; n < 4; ++n)
        {
          planned->correct(best);
          const std::vector<double> before = best;
          best =
            fit(*planned, best, all_parameters(campaign), 0, deadline).scaled;
          optimum      = linearise(*planned, best, result.tests);
          double moved = 0.;
          for (std::size_t i = 0; i < best.size(); ++i)
            moved = std::max(moved,
                             std::abs(best[i] - before[i]) * optimum.size[i] /
                               optimum.deviations(i));
          if (moved < 0.1)
            return;
          if (std::chrono::steady_clock::now() > deadline)
            break;
        }
      const std::string warning =
        "The error of the time steps moves parameters by more than a tenth of "
        "their standard deviations: " +
        (std::chrono::steady_clock::now() > deadline ?
           no_time + " before it was corrected." :
           "take a smaller Time stepping/Tolerance.");
      if (!holds(result.warnings, warning))
        result.warnings.push_back(warning);
    }



    void Calibrator::keep_profile(const std::size_t i, const Profile &profile)
    {
      const FitParameter &parameter          = campaign.fitted[i];
      FittedParameter    &fitted             = result.parameters[i];
      static_cast<ProfileInterval &>(fitted) = profile.converted(
        [&](const double scaled) { return parameter.from_scaled(scaled); });
      fitted.parameter = parameter;
      fitted.deviation =
        optimum.deviations(i) *
        (parameter.is_logarithmic ?
           1. :
           (parameter.upper - parameter.lower) / optimum.size[i]);
      fitted.is_at_bound = is_on_bound(best[i]);
    }



    // Returns a better optimum if one was met on the way, else nothing.
    std::vector<double> Calibrator::follow_profiles()
    {
      std::vector<Profile> profiles(best.size());
      is_symmetric.assign(best.size(), 0);
      std::atomic<unsigned int> n_done{0};
      side_by_side(best.size(), [&](const std::size_t i) {
        try
          {
            profiles[i] = profile(*planned, optimum, i, confidence(), deadline);
          }
        catch (const OutOfTime &)
          {
            profiles[i]     = symmetric_profile(optimum, i, confidence());
            is_symmetric[i] = 1;
          }
        ++n_done;
        tell("interval " + std::to_string(n_done) + " of " +
               std::to_string(best.size()),
             0.6 + 0.35 * n_done / best.size());
      });
      result.parameters.resize(best.size());
      for (std::size_t i = 0; i < best.size(); ++i)
        keep_profile(i, profiles[i]);
      for (const Profile &followed : profiles)
        if (!followed.better.empty())
          {
            const FitResult again = fit(
              *planned, followed.better, all_parameters(campaign), 0, deadline);
            if (again.misfit < optimum.misfit - 0.01 * optimum.inflation)
              return again.scaled;
          }
      return {};
    }



    // To first order in the parameters' natural terms.
    DerivedQuantity Calibrator::derived_quantity(const Derived &quantity)
    {
      DerivedQuantity derived;
      derived.name    = quantity.name;
      derived.formula = quantity.formula;
      derived.value   = evaluate(quantity, planned->with(best));
      Eigen::VectorXd gradient(best.size());
      for (std::size_t i = 0; i < best.size(); ++i)
        {
          const double        step  = best[i] > 0.5 ? -1e-6 : 1e-6;
          std::vector<double> other = best;
          other[i] += step;
          gradient(i) =
            (evaluate(quantity, planned->with(other)) - derived.value) / step /
            optimum.size[i];
        }
      derived.deviation =
        std::hypot((gradient.transpose() * optimum.directions)
                     .transpose()
                     .cwiseProduct(optimum.bounded_deviations)
                     .norm(),
                   optimum.gain *
                     (gradient.transpose() * optimum.by_gains).norm());
      for (std::size_t i = 0; i < best.size(); ++i)
        if (std::isinf(optimum.deviations(i)) &&
            std::abs(gradient(i)) > 1e-3 * gradient.cwiseAbs().maxCoeff())
          derived.deviation = std::numeric_limits<double>::infinity();
      return derived;
    }



    // What has no value there is no reason to lose the rest.
    void Calibrator::derive()
    {
      constexpr double none = std::numeric_limits<double>::quiet_NaN();
      for (const Derived &quantity : campaign.derived)
        try
          {
            result.derived.push_back(derived_quantity(quantity));
          }
        catch (const InputError &error)
          {
            result.derived.push_back(
              {quantity.name, quantity.formula, none, none});
            result.warnings.push_back(error.what());
          }
    }



    // A fit that would go where the law takes no values ends beside them, at a
    // bound that the case does not state.
    void Calibrator::find_constraints()
    {
      constexpr double significant = 4.;

      const std::size_t   n = campaign.n_residuals();
      std::vector<double> residuals(n), derivatives(n);
      for (unsigned int i = 0; i < best.size(); ++i)
        for (const double direction : {-1., 1.})
          {
            // What the case states stops it first.
            if (is_on_bound(best[i]))
              break;
            const std::string condition =
              planned->condition_beside(best, i, direction);
            if (condition.empty())
              continue;
            FittedParameter &fitted = result.parameters[i];
            fitted.is_at_bound      = true;
            fitted.constraint       = condition;
            planned->residuals(best, residuals.data());
            planned->derivatives(best,
                                 {i},
                                 residuals.data(),
                                 derivatives.data());
            const auto product = [&](const std::vector<double> &x) {
              return std::inner_product(x.begin(),
                                        x.end(),
                                        derivatives.begin(),
                                        0.);
            };
            // What a step of Gauss and Newton would gain.
            const double slope = direction * product(residuals);
            fitted.is_wanted_beyond =
              slope < 0. && slope * slope > significant * product(derivatives);
          }
      // They tell of the surroundings of an optimum, which this is not.
      auto &weak = result.weak;
      remove_erase_if(weak, [&](const WeakDirection &direction) {
        return any_of(direction.members, [&](const std::size_t i) {
          return !result.parameters[i].constraint.empty();
        });
      });
    }



    void Calibrator::warn()
    {
      for (const std::string &sentence : constraint_sentences(result))
        result.warnings.push_back(sentence);
      for (const FittedParameter &fitted : result.parameters)
        if (fitted.is_at_bound && fitted.constraint.empty())
          result.warnings.push_back(
            fitted.parameter.path + " is at its bound " +
            fitted.parameter.text(fitted.value, 6) +
            ": the tests favour a value beyond it, or do not need this "
            "parameter.");
      unsigned int n_elsewhere = 0;
      for (const StartComparison &start : compare_starts(result))
        n_elsewhere += start.has_end && !start.is_equal;
      if (n_elsewhere > 0)
        result.warnings.push_back(
          std::to_string(n_elsewhere) + " of " +
          std::to_string(result.starts.size()) +
          " starts ended in a worse optimum: the problem is not convex, take "
          "more Calibration/Starts to be sure.");

      warn_of_time();
      warn_of_misfit();
    }



    void Calibrator::warn_of_time()
    {
      const std::string over =
        SignalGuard::caught() != 0 ?
          SignalGuard::in_words() + " before " :
          "Calibration/Most time = " +
            campaign.parameters.text("Calibration/Most time") +
            " was over before ";
      const std::size_t n_left_out =
        count_if(result.starts, [](const StartResult &start) {
          return start.message == no_time;
        });
      if (n_left_out > 0)
        result.warnings.push_back(over + std::to_string(n_left_out) + " of " +
                                  counted(result.starts.size(), "start") +
                                  " began: there may be a better optimum.");
      std::vector<std::string> names;
      for (std::size_t i = 0; i < is_symmetric.size(); ++i)
        if (is_symmetric[i] != 0)
          names.push_back(campaign.fitted[i].path);
      if (!names.empty())
        result.warnings.push_back(
          over + "the " + (names.size() > 1 ? "intervals" : "interval") +
          " of " + list_text(names) +
          " could be followed: the curvature at the optimum alone is used "
          "instead.");
    }



    // As many parameters as tests take up whatever differs between these.
    void Calibrator::warn_of_few_tests()
    {
      constexpr std::size_t enough = 3; // tests more than parameters
      constexpr double      share = 0.01, noticed = 2.;

      if (campaign.tests.size() >= best.size() + enough)
        return;
      const auto wider = [&](const Eigen::MatrixXd &moves) {
        std::vector<std::string> result;
        for (Eigen::Index i = 0; i < moves.rows(); ++i)
          {
            const double times =
              share * moves.row(i).norm() / optimum.deviations(i);
            if (times > noticed)
              result.push_back(campaign.fitted[i].path + " " +
                               rounded_text(times, 2));
          }
        return list_text(result);
      };
      const std::string by_gains  = wider(optimum.by_gains);
      const std::string by_drifts = wider(optimum.by_drifts);
      if (by_gains.empty() && by_drifts.empty())
        return;
      result.warnings.push_back(
        counted(campaign.tests.size(), "test") + " for " +
        counted(best.size(), "parameter") +
        " cannot show whether tests differ from one another: intervals would "
        "be wider by these factors" +
        (by_gains.empty() ? "" : ", if gains differ by 1 %: " + by_gains) +
        (by_drifts.empty() ?
           "" :
           (by_gains.empty() ? "" : ";") +
             std::string(" if friction drifts by 1 % within each test: ") +
             by_drifts) +
        ". Replicates would show it.");
    }



    // What a fit hides in parameters, and what it cannot hide.
    void Calibrator::warn_of_misfit()
    {
      constexpr double      some = 2., far = 10.;
      constexpr std::size_t many_rows = 50;

      std::vector<std::string> wider;
      for (std::size_t i = 0; i < best.size(); ++i)
        if (optimum.differ_in(i))
          wider.push_back(campaign.fitted[i].path + " " +
                          rounded_text(optimum.between_tests(i), 2));
      if (!wider.empty())
        result.warnings.push_back(
          "The tests differ from one another by more than their rows scatter, "
          "as if a gain or a zero changed from test to test: judged by these "
          "differences, and by leaving out one test at a time, intervals are "
          "wider than by rows alone by these factors: " +
          list_text(wider) + ".");
      else
        warn_of_few_tests();
      const double ratio = std::sqrt(result.misfit / result.n_rows);
      if (ratio > some)
        result.warnings.push_back(
          (ratio > far ? "the law does not describe these tests, which differ "
                         "from it by " :
                         "these tests differ from the fitted law by ") +
          rounded_text(ratio, 2) + " times " + noise_words(some) +
          (ratio > far ?
             ": slipstep diagnose looks for what is missing" :
             ": the noise is correlated over many rows, or something is "
             "missing, which slipstep diagnose looks for") +
          "; a unit, a scale or a zero of the records may be wrong, too.");
      // Whatever the law, it is not closer to rows than these to one another.
      if (ratio < 1. / some && noise_is_stated() && result.n_rows > many_rows)
        result.warnings.push_back(
          "these tests differ from the fitted law by only " +
          rounded_text(ratio, 2) +
          " times the noise that is stated (Calibration/Noise, or '# noise' "
          "in a test): the stated noise is too large, and the intervals are "
          "too wide.");
    }



    bool Calibrator::noise_is_stated() const
    {
      return any_of(campaign.tests, [](const CampaignTest &test) {
        return test.noise_is_stated;
      });
    }



    // "their noise", by which rows scatter, or is stated, in spite of these.
    std::string Calibrator::noise_words(const double some) const
    {
      if (!noise_is_stated())
        return "their noise, the scatter of neighbouring rows";
      const double scatter = scatter_over_stated(campaign.tests);
      return "the noise that is stated (Calibration/Noise, or '# noise' in a "
             "test)" +
             (scatter > some ?
                ", which is too small, since neighbouring rows scatter by " +
                  rounded_text(scatter, 2) + " times as much" :
                "");
    }



    // What the start values give: rms of every test.
    std::vector<double> Calibrator::keep_start()
    {
      std::vector<double> residuals(campaign.n_residuals());
      planned->residuals(campaign.scaled_start(), residuals.data());
      std::vector<double> rms;
      const double       *part = residuals.data();
      for (const CampaignTest &test : campaign.tests)
        {
          rms.push_back(test.root_mean_square(part));
          result.start_misfit +=
            std::inner_product(part, part + test.n_residuals(), part, 0.);
          part += test.n_residuals();
        }
      return rms;
    }



    // By profiles, and as long as these lead to a better optimum. Who stops it
    // then does not lose the values that were found.
    void Calibrator::find_intervals()
    {
      constexpr unsigned int most_turns = 6;

      try
        {
          for (unsigned int n = 0; n < most_turns; ++n)
            {
              const std::vector<double> better = follow_profiles();
              if (better.empty())
                return;
              best = better;
              correct_steps();
            }
          result.warnings.push_back(
            "The search for the intervals still finds better values: treat "
            "values and intervals with caution.");
        }
      catch (const RunError &)
        {
          if (SignalGuard::caught() == 0)
            throw;
          best = optimum.scaled;
          is_symmetric.assign(best.size(), 1);
          result.parameters.resize(best.size());
          for (std::size_t i = 0; i < best.size(); ++i)
            keep_profile(i, symmetric_profile(optimum, i, confidence()));
        }
    }



    void Calibrator::describe_surroundings()
    {
      tell("weak directions", 0.96);
      try
        {
          result.weak = find_weak_directions(
            *planned,
            optimum,
            deadline_after(
              0.25 * campaign.parameters.number("Calibration/Most time")));
          find_constraints();
        }
      catch (const RunError &)
        {
          if (SignalGuard::caught() == 0)
            throw;
        }
    }



    Calibration Calibrator::run()
    {
      const ResourceUsage begin = ResourceUsage::now();
      tell("reading", 0.);
      result.warnings = campaign.warnings();
      check_influence(campaign);
      search();

      planned = std::make_unique<Simulator>(campaign);
      planned->plan(campaign.scaled_start());
      const std::vector<double> start_rms = keep_start();
      correct_steps();
      find_intervals();

      for (std::size_t i = 0; i < result.tests.size(); ++i)
        result.tests[i].start_rms = start_rms[i];
      result.misfit      = optimum.misfit;
      result.n_rows      = campaign.n_residuals();
      result.n_effective = optimum.n_effective;
      result.inflation   = optimum.inflation;
      result.confidence  = confidence();
      result.correlation.assign(best.size(), std::vector<double>(best.size()));
      for (std::size_t i = 0; i < best.size(); ++i)
        for (std::size_t j = 0; j < best.size(); ++j)
          result.correlation[i][j] = optimum.correlation(i, j);
      derive();
      describe_surroundings();
      warn();
      result.n_simulations += planned->n_simulations();
      result.n_steps          = planned->n_steps();
      const ResourceUsage end = ResourceUsage::now();
      result.wall_time        = end.wall_time - begin.wall_time;
      result.cpu_time         = end.cpu_time - begin.cpu_time;
      return result;
    }
  } // namespace



  Calibration calibrate(const Parameters &parameters, const Report &progress)
  {
    Calibrator calibrator(parameters, progress);
    try
      {
        return calibrator.run();
      }
    catch (const RunError &error)
      {
        throw_if_stopped();
        throw RunError(error.what() + calibrator.reason_of_jumps(error.what()));
      }
  }
} // namespace SlipStep
