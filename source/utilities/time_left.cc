// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/time_left.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    // What is told is to be right within this factor.
    constexpr double accuracy = 1.5;

    // Samples per doubling of the time are enough for every look back.
    bool is_close(const double before, const double now, const double since)
    {
      return now - before < (now - since) / 64.;
    }
  } // namespace



  TimeRange &TimeRange::operator+=(const TimeRange &other)
  {
    low += other.low;
    high += other.high;
    return *this;
  }



  // The truth is in the range: a little less than the factor leaves something
  // for what no one knows.
  double TimeRange::middle() const
  {
    return low > 0. && high <= 0.85 * accuracy * accuracy * low ?
             std::sqrt(low * high) :
             infinity;
  }



  void RateWatch::add(const double now, const double position)
  {
    last = {now, position};
    if (samples.empty() ||
        !is_close(samples.back().now, now, samples.front().now))
      samples.push_back(last);
  }



  const RateWatch::Sample &RateWatch::at(const double now) const
  {
    const auto after =
      std::upper_bound(samples.begin(),
                       samples.end(),
                       now,
                       [](double t, const Sample &s) { return t < s.now; });
    return after == samples.begin() ? *after : *(after - 1);
  }



  TimeRange RateWatch::left() const
  {
    constexpr std::size_t least = 5; // samples for a rate
    if (samples.size() < 2 * least + 1)
      return {};
    const double span =
      std::max((last.now - samples.front().now) / 4.,
               last.now - samples[samples.size() - least].now);
    if (samples.front().now > last.now - 2. * span)
      return {};
    const Sample &middle   = at(last.now - span);
    const Sample &first    = at(middle.now - span);
    const double  new_time = last.now - middle.now;
    const double  old_time = middle.now - first.now;
    const double  rate     = (last.position - middle.position) / new_time;
    const double  old_rate = (middle.position - first.position) / old_time;
    if (!(rate > 0.) || !(old_rate > 0.))
      return {};

    // If the rate goes on changing exponentially, the position obeys
    // x = rate (exp(growth t) - 1) / growth.
    const double growth =
      std::log(rate / old_rate) / (0.5 * (new_time + old_time));
    const double constant = (1. - last.position) / rate;
    const double product  = growth * constant;
    const double changing = std::abs(product) < 1e-9 ? constant :
                            product <= -1.           ? infinity :
                                             std::log1p(product) / growth;
    return {std::min(constant, changing), std::max(constant, changing)};
  }



  void CautiousTime::add(const double now, const TimeRange &left)
  {
    const Forecast forecast{now, now + left.middle()};
    // The last one is always kept; with an older one beside it, it goes.
    if (forecasts.size() > 1 &&
        is_close(forecasts[forecasts.size() - 2].now, now, 0.))
      forecasts.pop_back();
    forecasts.push_back(forecast);
  }



  // Seen from now, all forecasts of the last while must agree. What is due soon
  // needs no long memory.
  double CautiousTime::left() const
  {
    constexpr double      nothing = std::numeric_limits<double>::quiet_NaN();
    constexpr std::size_t least   = 5;
    if (forecasts.size() < least)
      return nothing;
    const double now  = forecasts.back().now;
    const double left = forecasts.back().end - now;
    // At first too little is known, and at last single steps count. Who waits
    // for an instant need not be told.
    if (!std::isfinite(left) || left > 9. * now || left < now / 50. ||
        now < 0.5)
      return nothing;
    const double since    = now - std::min(now / 3., std::max(left, now / 16.));
    double       earliest = infinity, latest = 0.;
    for (std::size_t i = forecasts.size(); i-- > 0;)
      {
        earliest = std::min(earliest, forecasts[i].end);
        latest   = std::max(latest, forecasts[i].end);
        if (forecasts[i].now <= since && forecasts.size() - i >= least)
          break;
      }
    return earliest > now && latest - now <= accuracy * (earliest - now) ?
             left :
             nothing;
  }
} // namespace SlipStep
