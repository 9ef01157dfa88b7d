// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/programme.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace SlipStep
{
  const Segment &Programme::segment_at(const double time) const
  {
    Assert(!segment_list.empty(), dealii::ExcNotInitialized());
    const auto found =
      std::lower_bound(segment_list.begin(),
                       segment_list.end(),
                       time,
                       [](const Segment &segment, const double t) {
                         return segment.end_time < t;
                       });
    return found == segment_list.end() ? segment_list.back() : *found;
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
} // namespace SlipStep
