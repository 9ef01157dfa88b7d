// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/arc.h>
#include <slipstep/measured_data/test_rows.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  using dealii::Tensor;

  namespace
  {
    /// From one row to the next.
    struct Chord
    {
      Tensor<1, 2> velocity; // [mm/s]
      double       duration; // [s]
    };

    Chord chord_to(const MeasuredTest &test, const std::size_t row)
    {
      const double duration = test.time[row] - test.time[row - 1];
      return {(position(test, row) - position(test, row - 1)) / duration,
              duration};
    }



    // Of the parabola through both chords, where they meet.
    Tensor<1, 2> velocity_between(const Chord &a, const Chord &b)
    {
      return (b.duration * a.velocity + a.duration * b.velocity) /
             (a.duration + b.duration);
    }



    // Angle from one chord to the next [rad]; 0 where that is no smooth curve.
    double turn_between(const Chord &a, const Chord &b)
    {
      constexpr double sharp = 0.4, uneven = 3.;

      const double slow = std::min(a.velocity.norm(), b.velocity.norm());
      const double fast = std::max(a.velocity.norm(), b.velocity.norm());
      if (!(slow * uneven > fast))
        return 0.;
      const double turn = std::atan2(a.velocity[0] * b.velocity[1] -
                                       a.velocity[1] * b.velocity[0],
                                     a.velocity * b.velocity);
      return std::abs(turn) < sharp ? turn : 0.;
    }
  } // namespace



  std::vector<PartOfWay> way_to(const MeasuredTest &test, const std::size_t row)
  {
    // A turn [rad] that friction feels, and one of a part; positions that
    // tremble turn to and fro.
    constexpr double felt = 0.005, of_part = 0.004, alike = 3.,
                     most_parts = 12.;
    constexpr double last_part  = 0.1;

    const Chord                  now      = chord_to(test, row);
    const std::vector<PartOfWay> straight = {{position(test, row), 0., 1.}};
    if (test.displacement_y.empty() || row < 2 || row + 1 >= test.time.size())
      return straight;
    const Chord before  = chord_to(test, row - 1),
                after   = chord_to(test, row + 1);
    const double first  = turn_between(before, now),
                 second = turn_between(now, after);
    if (!(first * second > 0.) ||
        std::max(first / second, second / first) > alike ||
        std::abs(first + second) < 2. * felt)
      return straight;

    const Tensor<1, 2> at_start = velocity_between(before, now),
                       at_end   = velocity_between(now, after);
    const auto way_until        = [&](const double t) {
      return now.duration *
             (t * at_start +
              t * t * (3. * now.velocity - 2. * at_start - at_end) +
              t * t * t * (at_start + at_end - 2. * now.velocity));
    };
    const double n =
      std::clamp(std::ceil(std::abs(first + second) / 2. / of_part),
                 2.,
                 most_parts);
    const Tensor<1, 2>     start = position(test, row - 1);
    std::vector<PartOfWay> parts;
    double                 begin = 0.;
    for (double i = 1.; i <= n; ++i)
      {
        const double end = i < n ? i / n : 1. - last_part / n;
        parts.push_back({start + way_until(end), begin, end});
        begin = end;
      }
    parts.push_back({position(test, row), begin, 1.});
    return parts;
  }
} // namespace SlipStep
