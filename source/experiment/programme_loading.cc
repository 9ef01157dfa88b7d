// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/programme.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace SlipStep
{
  namespace
  {
    // The last one beyond the end.
    std::size_t index_at(const std::vector<Segment> &segments,
                         const double                time)
    {
      Assert(!segments.empty(), dealii::ExcNotInitialized());
      return std::lower_bound(segments.begin(),
                              segments.end() - 1,
                              time,
                              [](const Segment &segment, const double t) {
                                return segment.end_time < t;
                              }) -
             segments.begin();
    }
  } // namespace



  const Segment &Programme::segment_at(const double time) const
  {
    return segment_list[index_at(segment_list, time)];
  }



  double Programme::weight_of_error(const double begin, const double end) const
  {
    const Segment &segment = segment_at(end);
    if (segment.end.pressure > 0. || !(segment.start.pressure > 0.))
      return 1.;
    return std::min(1., at(begin).pressure / segment.start.pressure);
  }



  Loading Programme::at(const double time) const
  {
    const Segment &segment = segment_at(time);
    if (time >= segment.end_time)
      return segment.end;

    const double weight = std::max(0., time - segment.start_time) /
                          (segment.end_time - segment.start_time);
    Loading loading = segment.start;
    loading.pressure +=
      weight * (segment.end.pressure - segment.start.pressure);
    loading.displacement +=
      weight * (segment.end.displacement - segment.start.displacement);
    return loading;
  }



  double Programme::largest_pressure() const
  {
    double largest = 0.;
    for (const Segment &segment : segment_list)
      largest = std::max(largest, segment.end.pressure);
    return largest;
  }



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
    if (segments.empty() || time > segments.back().end_time)
      return whole();
    const std::size_t i      = index_at(segments, time);
    const Segment    &now    = segments[i];
    const double      before = i == 0 ? 0. : path_after[i - 1];
    const double      share =
      (time - now.start_time) / (now.end_time - now.start_time);
    return before + std::min(share, 1.) * (path_after[i] - before);
  }
} // namespace SlipStep
