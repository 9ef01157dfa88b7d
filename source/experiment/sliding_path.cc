// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/sliding_path.h>

#include <algorithm>

namespace SlipStep
{
  SlidingPath::SlidingPath(const Programme &programme)
    : segments(programme.segments())
  {
    double path = 0.;
    for (const Segment &segment : segments)
      {
        path += (segment.end.displacement - segment.start.displacement).norm();
        path_after.push_back(path);
      }
  }



  double SlidingPath::at(const double time) const
  {
    const auto found =
      std::lower_bound(segments.begin(),
                       segments.end(),
                       time,
                       [](const Segment &segment, const double t) {
                         return segment.end_time < t;
                       });
    if (found == segments.end())
      return whole();
    const std::size_t i      = found - segments.begin();
    const double      before = i == 0 ? 0. : path_after[i - 1];
    const double      share =
      (time - found->start_time) / (found->end_time - found->start_time);
    return before + std::min(share, 1.) * (path_after[i] - before);
  }
} // namespace SlipStep
