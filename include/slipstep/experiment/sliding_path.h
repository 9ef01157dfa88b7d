// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_experiment_sliding_path_h
#define slipstep_experiment_sliding_path_h

#include <slipstep/experiment/programme.h>

#include <vector>

namespace SlipStep
{
  /// Path of the drive: the distance it has moved since the beginning of the
  /// programme, whatever the direction.
  class SlidingPath
  {
  public:
    explicit SlidingPath(const Programme &programme);

    /// At a time of the programme [mm].
    double at(const double time) const;

    /// At the end of each segment [mm].
    const std::vector<double> &after_segments() const
    {
      return path_after;
    }

    /// At the end [mm].
    double whole() const
    {
      return path_after.empty() ? 0. : path_after.back();
    }

  private:
    std::vector<Segment> segments;
    std::vector<double>  path_after;
  };
} // namespace SlipStep

#endif
