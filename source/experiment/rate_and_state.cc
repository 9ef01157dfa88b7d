// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/rate_and_state.h>

#include <slipstep/experiment/stability.h>
#include <slipstep/utilities/text.h>

#include <cmath>

namespace SlipStep
{
  std::string RateAndState::in_words() const
  {
    const double fall = b - a;
    return "rate and state at " + short_text(speed, 4) + " mm/s, " +
           short_text(pressure, 4) + " MPa: a = " + short_text(a, 3) +
           ", b = " + short_text(b, 3) + ", D_c = " + short_text(length, 4) +
           " mm; steady friction " + short_text(friction, 4) +
           (fall > 0. ? " falls by " : " rises by ") +
           short_text(std::abs(fall) * std::log(10.), 3) +
           " with ten times the speed";
  }



  std::vector<RateAndState> rate_and_state(const Parameters  &parameters,
                                           const FrictionLaw &law,
                                           const Programme   &programme)
  {
    constexpr std::size_t    most = 4;
    std::vector<std::string> evolving;
    for (const std::string &name : law.effects())
      if (name == "ageing" || name == "slip_law")
        evolving.push_back(name);
    if (evolving.size() != 1)
      return {};
    const std::string section = "Friction/" + evolving[0] + "/";
    const double      growth  = parameters.number(section + "Growth");
    const double      time    = parameters.number(section + "Time");
    const double      length  = parameters.number(
      section + (evolving[0] == "ageing" ? "Renewal length" : "Slip length"));

    std::vector<RateAndState> result;
    for (const Loading &slide : steady_slides(programme, most))
      {
        const SteadySliding sliding(law, slide.velocity, slide.pressure);
        if (!sliding.exists())
          continue;
        RateAndState reading;
        reading.speed      = slide.velocity.norm();
        reading.pressure   = slide.pressure;
        reading.friction   = sliding.friction();
        reading.length     = length;
        const double share = 1e-4;
        reading.a          = reading.friction *
                    std::log(law.steady_ratio(reading.speed * (1. + share)) /
                             law.steady_ratio(reading.speed * (1. - share))) /
                    std::log((1. + share) / (1. - share));
        const double theta = length / reading.speed;
        reading.b          = reading.friction /
                    (1. + growth * std::log1p(theta / time)) * growth * theta /
                    (time + theta);
        result.push_back(reading);
      }
    return result;
  }
} // namespace SlipStep
