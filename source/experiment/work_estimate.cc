#include <slipstep/experiment/work_estimate.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  WorkEstimate::WorkEstimate(const Programme &programme)
    : work_before(0.)
    , total_work(0.)
  {
    unsigned int last = 0;
    for (const Segment &segment : programme.segments())
      {
        const bool moves = segment.end.velocity.norm() > 0.;
        if (statements.empty() || segment.statement != last)
          statements.push_back(
            {segment.start_time, segment.end_time, 1., moves});
        else
          statements.back().is_slide = false;
        statements.back().end_time = segment.end_time;
        if (moves)
          statements.back().work = 10.;
        last = segment.statement;
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
} // namespace SlipStep
