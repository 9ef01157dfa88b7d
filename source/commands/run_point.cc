// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <slipstep/commands/commands.h>
#include <slipstep/experiment/rate_and_state.h>
#include <slipstep/experiment/point_driver.h>
#include <slipstep/experiment/run_recorder.h>
#include <slipstep/experiment/stability.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/process.h>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    // Most laws slide backwards as they slide forwards.
    bool is_like(const StabilitySummary &a, const StabilitySummary &b)
    {
      const auto differ = [](const double x, const double y) {
        return x != y && !(std::abs(x - y) <= 1e-6 * std::abs(y));
      };
      return !differ(a.speed, b.speed) && !differ(a.pressure, b.pressure) &&
             !differ(a.critical_stiffness, b.critical_stiffness);
    }

    // -180 to 180 degrees, without the sign of a zero.
    double direction_of(const dealii::Tensor<1, 2> &velocity)
    {
      return std::atan2(velocity[1] + 0., velocity[0]) * 180. /
             dealii::numbers::PI;
    }



    std::vector<StabilitySummary> stability_of(const FrictionLaw &law,
                                               const Programme   &programme,
                                               const Machine     &machine)
    {
      // A replayed test has too many to be told.
      constexpr std::size_t         most = 20;
      std::vector<StabilitySummary> result;
      const std::vector<Loading>    slides = steady_slides(programme, most + 1);
      if (slides.size() > most)
        return {};
      for (const Loading &now : slides)
        {
          const SteadySliding sliding(law, now.velocity, now.pressure);
          if (!sliding.exists())
            continue;
          const StabilityLimit   limit = sliding.limit(machine.mass());
          const StabilitySummary summary{now.velocity.norm(),
                                         now.pressure,
                                         sliding.friction(),
                                         machine.stiffness(),
                                         limit.stiffness,
                                         limit.frequency /
                                           (2. * dealii::numbers::PI),
                                         direction_of(now.velocity)};
          if (none_of(result, [&](const auto &other) {
                return is_like(summary, other);
              }))
            result.push_back(summary);
        }
      return result;
    }
  } // namespace



  Summary run_point(const Parameters &parameters, const RunOptions &options)
  {
    const FrictionLaw law(parameters);
    const Programme   programme = parse_programme(parameters);
    const Machine     machine(parameters);
    RunRecorder       recorder(parameters, options, "point", law, programme);
    if (!machine.is_rigid())
      {
        recorder.summary.stability = stability_of(law, programme, machine);
        if (recorder.summary.stability.empty() &&
            !steady_slides(programme, 1).empty())
          recorder.announce(
            "The stability of sliding is not assessed: the law has no steady "
            "state at these speeds, as with friction that depends on the "
            "position, or there are too many speeds.");
      }
    if (options.resume)
      recorder.announce(
        "A contact point writes no checkpoints: the run starts anew.");
    for (const RateAndState &reading :
         rate_and_state(parameters, law, programme))
      recorder.announce(reading.in_words());
    try
      {
        const StepControl control = drive_point(
          law,
          programme,
          StepControl(parameters, programme, law),
          [&](const HistoryRow &row) {
            recorder.record(row);
            if (SignalGuard::caught() != 0)
              throw RunError(SignalGuard::in_words());
            ++recorder.summary.newton_iterations;
          },
          machine);
        recorder.summary.rejected_steps = control.n_rejected();
        for (const std::string &warning :
             {control.warning(), control.warning_of_swing()})
          if (!warning.empty())
            recorder.summary.warnings.push_back(warning);
        recorder.finish();
      }
    catch (const RunError &error)
      {
        recorder.finish(error.what());
      }
    return recorder.summary;
  }
} // namespace SlipStep
