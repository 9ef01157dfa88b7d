// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/work_estimate.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  WorkEstimate::WorkEstimate(const Programme &programme)
  {
    unsigned int last  = 0;
    const auto  &all   = programme.segments();
    std::size_t  first = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
      {
        const Segment &segment = all[i];
        const bool     moves   = segment.end.velocity.norm() > 0.;
        if (statements.empty() || segment.statement != last)
          {
            Statement statement;
            statement.start_time = segment.start_time;
            statement.is_slide   = moves;
            statements.push_back(statement);
            first = i;
          }
        else
          statements.back().is_slide = false;
        statements.back().end_time = segment.end_time;
        statements.back().ends.push_back(segment.end_time);
        if (moves)
          statements.back().work = 10.;
        last = segment.statement;
        if (i + 1 == all.size() || all[i + 1].statement != last)
          statements.back().kind = find_kind(all[first], segment);
      }
    for (const Statement &statement : statements)
      total_work += statement.work;
  }



  double WorkEstimate::share_done(const double time)
  {
    while (present < statements.size() &&
           time >= statements[present].end_time * (1. - 1e-12))
      {
        work_before += statements[present].work;
        ++present;
        first_step = 0.;
      }
    if (present == statements.size())
      return 1.;

    const Statement &now      = statements[present];
    const double     since    = std::max(time - now.start_time, 0.);
    const double     duration = now.end_time - now.start_time;
    double           share    = since / duration;
    if (now.is_slide && since > 0.)
      {
        if (first_step == 0.)
          first_step = since;
        share =
          std::log1p(since / first_step) / std::log1p(duration / first_step);
      }
    return (work_before + share * now.work) / total_work;
  }



  std::size_t WorkEstimate::find_kind(const Segment &first, const Segment &last)
  {
    Kind kind;
    kind.what = {{last.end_time - first.start_time,
                  (last.end.displacement - first.start.displacement).norm(),
                  first.start.pressure,
                  last.end.pressure,
                  static_cast<double>(statements.back().ends.size())}};
    const auto found =
      std::find_if(kinds.begin(), kinds.end(), [&kind](const Kind &other) {
        return std::equal(kind.what.begin(),
                          kind.what.end(),
                          other.what.begin(),
                          [](const double a, const double b) {
                            return std::abs(a - b) <= 1e-6 * std::abs(b);
                          });
      });
    const std::size_t number = found - kinds.begin();
    if (found == kinds.end())
      kinds.push_back(kind);
    ++kinds[number].n_to_come;
    return number;
  }



  void WorkEstimate::resume()
  {
    for (; timed < present; ++timed)
      --kinds[statements[timed].kind].n_to_come;
    is_timed_from_start = false;
  }



  // A statement that was entered in the middle, by a run that goes on, tells
  // nothing about its like.
  void WorkEstimate::start_statement(const double now)
  {
    if (is_timed_from_start)
      kinds[statements[timed].kind].cost = std::max(now - began, 1e-9);
    resume();
    is_timed_from_start = true;
    began               = now;
    watch               = RateWatch();
    watch.add(now, 0.);
  }



  // From 0 to 1 within the present statement; of a replayed test by its rows.
  double WorkEstimate::position(const double time) const
  {
    const std::vector<double> &ends = statements[present].ends;
    const std::size_t          i =
      std::lower_bound(ends.begin(), ends.end(), time) - ends.begin();
    if (i == ends.size())
      return 1.;
    const double start = i > 0 ? ends[i - 1] : statements[present].start_time;
    return (i + (time - start) / (ends[i] - start)) / ends.size();
  }



  TimeRange WorkEstimate::cost_of(const Kind &kind) const
  {
    if (kind.cost > 0.)
      return {0.85 * kind.cost, 1.2 * kind.cost};
    if (!kind.is_rest())
      return {};
    // What does not move takes little.
    double most = 0.;
    for (const Kind &other : kinds)
      if (other.is_rest())
        most = std::max(most, other.cost);
    return most > 0. ? TimeRange{0., 2. * most} : TimeRange();
  }



  TimeRange WorkEstimate::left_of_present(const double now) const
  {
    const TimeRange by_rate = watch.left();
    const TimeRange cost    = cost_of(kinds[statements[present].kind]);
    const double    spent   = now - began;
    if (std::isfinite(by_rate.middle()) || !(cost.high > spent) ||
        !std::isfinite(cost.high))
      return by_rate;
    return {std::max(cost.low - spent, 0.), cost.high - spent};
  }



  double WorkEstimate::time_left(const double time, const double now)
  {
    if (present == statements.size())
      return 0.;
    if (timed != present)
      start_statement(now);
    watch.add(now, position(time));
    // A forecast now and then is enough.
    if (now < 1.005 * forecast_at && !(now > forecast_at + 0.02 * told))
      return told - (now - forecast_at);
    forecast_at    = now;
    TimeRange left = left_of_present(now);
    for (const Kind &kind : kinds)
      {
        const bool is_present = &kind == &kinds[statements[present].kind];
        const unsigned int n_to_come = kind.n_to_come - (is_present ? 1 : 0);
        if (n_to_come == 0)
          continue;
        const TimeRange cost = cost_of(kind);
        left += {n_to_come * cost.low, n_to_come * cost.high};
      }
    forecast.add(now, left);
    told = forecast.left();
    return told;
  }
} // namespace SlipStep
