#include <deal.II/base/parallel.h>

#include <slipstep/calibration/advice.h>
#include <slipstep/calibration/calibrate.h>
#include <slipstep/calibration/calibration_report.h>
#include <slipstep/calibration/fit.h>
#include <slipstep/experiment/point_driver.h>
#include <slipstep/experiment/run_recorder.h>
#include <slipstep/utilities/command_line.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/process.h>
#include <slipstep/utilities/progress.h>
#include <slipstep/utilities/write_file.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iostream>
#include <memory>
#include <mutex>
#include <sstream>

namespace SlipStep
{
  namespace
  {
    using Report = std::function<void(const std::string &, const double)>;

    /// The work of a calibration, step by step.
    class Calibrator
    {
    public:
      Calibrator(const Parameters &parameters, const Report &progress);

      Calibration run();

    private:
      void search();

      void correct_steps();

      bool follow_profiles();

      void keep_profile(const std::size_t i, const Profile &profile);

      void derive();

      void warn();

      void tell(const std::string &text, const double share);

      const Campaign campaign;
      const Report   progress;
      std::mutex     mutex;

      std::vector<double>        best;
      std::unique_ptr<Simulator> planned; ///< at the optimum
      Linearisation              optimum;
      Calibration                result;
    };



    // Side by side on the cores; the first exception is thrown again.
    void side_by_side(const std::size_t                             n,
                      const std::function<void(const std::size_t)> &work)
    {
      dealii::parallel::apply_to_subranges(
        std::size_t(0),
        n,
        [&](const std::size_t begin, const std::size_t end) {
          for (std::size_t i = begin; i < end; ++i)
            {
              throw_if_stopped();
              work(i);
            }
        },
        1);
    }



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
    {}



    void Calibrator::tell(const std::string &text, const double share)
    {
      const std::lock_guard<std::mutex> lock(mutex);
      if (progress)
        progress(text, share);
    }



    void Calibrator::search()
    {
      const auto starts =
        spread_starts(campaign,
                      campaign.parameters.integer("Calibration/Starts"));
      std::vector<FitResult>    found(starts.size());
      std::atomic<unsigned int> n_done{0}, n_simulations{0};
      side_by_side(starts.size(), [&](const std::size_t i) {
        Simulator simulator(campaign);
        try
          {
            found[i] = fit(simulator, starts[i], all_parameters(campaign));
          }
        catch (const InputError &error)
          {
            found[i].message = error.what();
          }
        catch (const RunError &error)
          {
            found[i].message = error.what();
          }
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
          "The search did not come to its end: " + found[first].message + ".");
      std::stable_sort(result.starts.begin(),
                       result.starts.end(),
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
          best    = fit(*planned, best, all_parameters(campaign), 0).scaled;
          optimum = linearise(*planned, best, result.tests);
          double moved = 0.;
          for (std::size_t i = 0; i < best.size(); ++i)
            moved = std::max(moved,
                             std::abs(best[i] - before[i]) * optimum.size[i] /
                               optimum.deviations(i));
          if (moved < 0.1)
            return;
        }
      result.warnings.push_back(
        "The error of the time steps moves parameters by more than a tenth of "
        "their standard deviations: take a smaller Time stepping/Tolerance.");
    }



    void Calibrator::keep_profile(const std::size_t i, const Profile &profile)
    {
      const FitParameter &parameter = campaign.fitted[i];
      FittedParameter    &fitted    = result.parameters[i];
      fitted.parameter              = parameter;
      fitted.value                  = parameter.from_scaled(best[i]);
      fitted.deviation =
        optimum.deviations(i) *
        (parameter.is_logarithmic ?
           1. :
           (parameter.upper - parameter.lower) / optimum.size[i]);
      fitted.lower         = parameter.from_scaled(profile.lower);
      fitted.upper         = parameter.from_scaled(profile.upper);
      fitted.is_lower_open = profile.is_lower_open;
      fitted.is_upper_open = profile.is_upper_open;
      fitted.is_at_bound   = best[i] < 1e-6 || best[i] > 1. - 1e-6;
      fitted.profile.clear();
      for (const auto &point : profile.points)
        fitted.profile.emplace_back(parameter.from_scaled(point.first),
                                    point.second);
    }



    // Returns whether a better optimum was met on the way, which is then the
    // best.
    bool Calibrator::follow_profiles()
    {
      const double confidence =
        campaign.parameters.number("Calibration/Confidence");
      std::vector<Profile>      profiles(best.size());
      std::atomic<unsigned int> n_done{0};
      side_by_side(best.size(), [&](const std::size_t i) {
        profiles[i] = profile(*planned, optimum, i, confidence);
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
            const FitResult again =
              fit(*planned, followed.better, all_parameters(campaign));
            if (again.misfit < optimum.misfit)
              {
                best = again.scaled;
                return true;
              }
          }
      return false;
    }



    // To first order in the parameters' natural terms.
    void Calibrator::derive()
    {
      for (const Derived &quantity : campaign.derived)
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
                (evaluate(quantity, planned->with(other)) - derived.value) /
                step / optimum.size[i];
            }
          const Eigen::VectorXd parts =
            (gradient.transpose() * optimum.directions)
              .transpose()
              .cwiseProduct(optimum.direction_deviations.cwiseMin(1e9));
          derived.deviation = parts.norm();
          result.derived.push_back(derived);
        }
    }



    void Calibrator::warn()
    {
      for (const FittedParameter &fitted : result.parameters)
        if (fitted.is_at_bound)
          result.warnings.push_back(
            fitted.parameter.path + " is at its bound " +
            fitted.parameter.text(fitted.value, 6) +
            ": the tests want it beyond, or do not need it.");
      unsigned int n_elsewhere = 0;
      for (const StartResult &start : result.starts)
        if (!start.end.empty() &&
            start.misfit > result.misfit * 1.01 + optimum.inflation)
          ++n_elsewhere;
      if (n_elsewhere > 0)
        result.warnings.push_back(
          std::to_string(n_elsewhere) + " of " +
          std::to_string(result.starts.size()) +
          " starts ended in a worse optimum: the problem is not convex, take "
          "more Calibration/Starts to be sure.");
    }



    Calibration Calibrator::run()
    {
      const ResourceUsage begin = ResourceUsage::now();
      tell("reading", 0.);
      result.warnings = campaign.warnings();
      check_influence(campaign);
      search();

      planned = std::make_unique<Simulator>(campaign);
      std::vector<TestMisfit> at_start;
      planned->plan(campaign.scaled_start());
      result.start_misfit =
        linearise(*planned, campaign.scaled_start(), at_start).misfit;
      correct_steps();
      for (unsigned int n = 0; n < 5 && follow_profiles(); ++n)
        correct_steps();

      for (std::size_t i = 0; i < result.tests.size(); ++i)
        result.tests[i].start_rms = at_start[i].rms;
      result.misfit      = optimum.misfit;
      result.n_rows      = campaign.n_residuals();
      result.n_effective = optimum.n_effective;
      result.inflation   = optimum.inflation;
      result.confidence  = campaign.parameters.number("Calibration/Confidence");
      result.correlation.assign(best.size(), std::vector<double>(best.size()));
      for (std::size_t i = 0; i < best.size(); ++i)
        for (std::size_t j = 0; j < best.size(); ++j)
          result.correlation[i][j] = optimum.correlation(i, j);
      derive();
      tell("weak directions", 0.96);
      result.weak = find_weak_directions(*planned, optimum);
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
    return Calibrator(parameters, progress).run();
  }



  Parameters fitted_case(const Parameters  &parameters,
                         const Calibration &calibration)
  {
    Parameters result = parameters;
    for (const FittedParameter &fitted : calibration.parameters)
      result.set(fitted.parameter.path,
                 fitted.parameter.text(fitted.value),
                 "calibration");
    apply_ties(read_derived(result), result);
    return result;
  }



  void run_calibration(const Parameters &parameters, const RunOptions &options)
  {
    const std::string name = parameters.case_file().stem().string();
    Calibration       calibration;
    {
      Progress progress(options.quiet, name);
      calibration =
        calibrate(parameters, [&](const std::string &text, const double share) {
          progress.update(share, text);
        });
      progress.finish();
    }

    create_output_folder(options.output);
    remove_earlier_results(options.output);
    const std::filesystem::path file = options.output / "fitted.prm";
    std::ostringstream          text;
    relocated_case(fitted_case(parameters, calibration), options.output)
      .print(text, Parameters::Format::prm, options.inactive_sections);
    write_file(file, text.str());
    write_calibration_json(options.output / "calibration.json",
                           parameters,
                           calibration);
    print_warnings(
      write_calibration_report(options.output, parameters, calibration));
    print_warnings(calibration.warnings);
    if (!options.quiet)
      std::cout << calibration_table(calibration)
                << "\nParameters: " << file.string()
                << "\nReport: " << (options.output / "report.html").string()
                << std::endl;
  }
} // namespace SlipStep
