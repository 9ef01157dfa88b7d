// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/rate_and_state.h>

#include <slipstep/experiment/stability.h>
#include <slipstep/utilities/text.h>

#include <cmath>
#include <limits>

namespace SlipStep
{
  std::string RateAndState::in_words() const
  {
    const double      change = friction_faster - friction;
    const std::string faster = std::isnan(change) ?
                                 "" :
                                 (change < 0. ? " falls by " : " rises by ") +
                                   short_text(std::abs(change), 3) +
                                   " with ten times the speed";
    return "rate and state at " + short_text(speed, 4) + " mm/s, " +
           short_text(pressure, 4) + " MPa: a = " + short_text(a, 3) +
           ", b = " + short_text(b, 3) + ", D_c = " + short_text(length, 4) +
           " mm; steady friction " + short_text(friction, 4) + faster;
  }



  namespace
  {
    // NaN if there is no steady state.
    double steady_friction(const FrictionLaw &law,
                           const Loading     &slide,
                           const double       factor_of_speed = 1.)
    {
      const SteadySliding sliding(law,
                                  factor_of_speed * slide.velocity,
                                  slide.pressure);
      return sliding.exists() ? sliding.friction() :
                                std::numeric_limits<double>::quiet_NaN();
    }
  } // namespace



  std::vector<RateAndState> rate_and_state(const Parameters  &parameters,
                                           const FrictionLaw &law,
                                           const Programme   &programme)
  {
    constexpr std::size_t    most = 4;
    constexpr double         step = 1e-3; // of a logarithm
    std::vector<std::string> evolving;
    for (const std::string &name : law.effects())
      if (name == "ageing" || name == "slip_law")
        evolving.push_back(name);
    if (evolving.size() != 1)
      return {};
    const std::string section   = "Friction/" + evolving[0] + "/";
    const std::string time      = section + "Time";
    const auto        with_time = [&](const double factor) {
      Parameters changed = parameters;
      changed.set(time,
                  plain_text(factor * parameters.number(time), 17),
                  "rate and state");
      return FrictionLaw(changed);
    };
    const FrictionLaw sooner = with_time(std::exp(-step));
    const FrictionLaw later  = with_time(std::exp(step));

    std::vector<RateAndState> result;
    for (const Loading &slide : steady_slides(programme, most))
      {
        RateAndState reading;
        reading.speed           = slide.velocity.norm();
        reading.pressure        = slide.pressure;
        reading.friction        = steady_friction(law, slide);
        reading.friction_faster = steady_friction(law, slide, 10.);
        reading.length = parameters.number(section + (evolving[0] == "ageing" ?
                                                        "Renewal length" :
                                                        "Slip length"));
        // The law takes the state only as a ratio to this time: d/d ln(state)
        // is minus d/d ln(time).
        reading.b =
          (steady_friction(sooner, slide) - steady_friction(later, slide)) /
          (2. * step);
        const double slope = (steady_friction(law, slide, std::exp(step)) -
                              steady_friction(law, slide, std::exp(-step))) /
                             (2. * step);
        reading.a = slope + reading.b;
        if (std::isfinite(reading.a))
          result.push_back(reading);
      }
    return result;
  }
} // namespace SlipStep
