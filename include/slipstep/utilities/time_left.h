// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_time_left_h
#define slipstep_utilities_time_left_h

#include <cstddef>
#include <limits>
#include <vector>

namespace SlipStep
{
  /// Between which times something will be done, from now [s].
  struct TimeRange
  {
    double low  = 0.;
    double high = std::numeric_limits<double>::infinity();

    TimeRange &operator+=(const TimeRange &other);

    /// The middle of a range in which all is close to all; otherwise infinity.
    double middle() const;
  };

  /// Watches something go from 0 to 1 at a rate that changes.
  class RateWatch
  {
  public:
    /// The position @p now [s]; both grow from call to call.
    void add(const double now, const double position);

    /// When it will be at 1: with the rate of the last while on one side, with
    /// a rate that goes on growing or shrinking as it did on the other.
    TimeRange left() const;

  private:
    struct Sample
    {
      double now, position;
    };

    // The last sample at or before a time.
    const Sample &at(const double now) const;

    std::vector<Sample> samples;
    Sample              last{0., 0.};
  };

  /// Tells a time left only if it can be relied upon: neither are its bounds
  /// far from each other, nor has it been foretold differently of late.
  class CautiousTime
  {
  public:
    /// Foretold @p now, in seconds since the work began.
    void add(const double now, const TimeRange &left);

    /// The time left as of the last call of add(), or NaN: better say nothing.
    double left() const;

  private:
    struct Forecast
    {
      double now, end;
    };

    std::vector<Forecast> forecasts;
  };
} // namespace SlipStep

#endif
