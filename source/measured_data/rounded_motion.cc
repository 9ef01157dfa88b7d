// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/rounded_motion.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <set>

namespace SlipStep
{
  namespace
  {
    /// Rows of the same value, up to the first row of another one.
    struct Stair
    {
      std::size_t begin = 0, end = 0;
      double      value = 0.;

      bool is_long() const
      {
        return end - begin > 1;
      }
    };



    // Nearly, in units of a step.
    bool is_whole(const double ratio, const double tolerance = 1e-3)
    {
      return std::abs(ratio - std::round(ratio)) <= tolerance;
    }



    std::vector<Stair> find_stairs(const std::vector<double> &values)
    {
      std::vector<Stair> result;
      for (std::size_t i = 0; i < values.size(); ++i)
        if (result.empty() || values[i] != result.back().value)
          result.push_back({i, i + 1, values[i]});
        else
          result.back().end = i + 1;
      return result;
    }



    /// Finds the motion between the stairs.
    struct StairMotion
    {
      const std::vector<double> &time;
      const double               step;
      const std::vector<Stair>   stairs;

      std::vector<double> motion(std::vector<double> values) const
      {
        for (std::size_t s = 0; s < stairs.size(); ++s)
          fill(s, values);
        return values;
      }

      // Where stair s begins: the last half step towards its value takes its
      // share of the interval between the rows.
      double entry(const std::size_t s) const
      {
        const std::size_t row      = stairs[s].begin;
        const double      duration = time[row] - time[row - 1];
        return time[row] - 0.5 * duration * step /
                             std::abs(stairs[s].value - stairs[s - 1].value);
      }

      double exit(const std::size_t s) const
      {
        const std::size_t row      = stairs[s].end;
        const double      duration = time[row] - time[row - 1];
        return time[row - 1] +
               0.5 * duration * step /
                 std::abs(stairs[s + 1].value - stairs[s].value);
      }

      static constexpr double unknown = std::numeric_limits<double>::infinity();

      // Of the first and the last one nobody knows.
      double time_per_step(const std::size_t s) const
      {
        return s > 0 && s + 1 < stairs.size() ? exit(s) - entry(s) : unknown;
      }

      double half_step_to(const std::size_t s, const std::size_t other) const
      {
        return std::copysign(0.5 * step, stairs[other].value - stairs[s].value);
      }

      // From the middle towards the value before it to that towards the next
      // one; or it turns there; or it comes to rest at the value, and leaves it
      // again, as fast as in the stairs beside it.
      void fill(const std::size_t s, std::vector<double> &values) const
      {
        constexpr double much_longer = 3., there_and_back = 2.;

        const Stair &stair = stairs[s];
        if (!stair.is_long() || stairs.size() < 2)
          return;
        const bool   is_first = s == 0, is_last = s + 1 == stairs.size();
        const double begin  = is_first ? time[0] : entry(s);
        const double end    = is_last ? time.back() : exit(s);
        const double from   = is_first ? 0. : half_step_to(s, s - 1);
        const double to     = is_last ? 0. : half_step_to(s, s + 1);
        const double before = is_first ? unknown : time_per_step(s - 1);
        const double after  = is_last ? unknown : time_per_step(s + 1);
        const double usual  = std::min(before, after);
        const bool   passes =
          from * to < 0. && end - begin <= much_longer * usual;
        const bool turns =
          from * to > 0. && end - begin <= there_and_back * usual;
        // The first and the last one have but one end.
        const double longest = (is_first || is_last ? 1. : 0.5) * (end - begin);
        const auto   half_of = [&](const double duration) {
          return std::min(longest,
                          0.5 * (duration < unknown ? duration : usual));
        };
        const double stops  = begin + half_of(before);
        const double starts = end - half_of(after);
        for (std::size_t i = stair.begin; i < stair.end; ++i)
          {
            const double t   = time[i];
            double       off = 0.;
            if (passes)
              off = from + (to - from) * (t - begin) / (end - begin);
            else if (turns)
              off = from * (1. - 2. * std::min(t - begin, end - t) / usual);
            else if (!is_first && t < stops)
              off = from * (stops - t) / (stops - begin);
            else if (!is_last && t > starts)
              off = to * (t - starts) / (end - starts);
            values[i] = stair.value + std::clamp(off, -0.5 * step, 0.5 * step);
          }
      }
    };



    /// Rows during which a motion is even.
    struct EvenMotion
    {
      std::size_t begin = 0, end = 0;
      double      time = 0., value = 0., speed = 0.; ///< of the middle

      double at(const double t) const
      {
        return value + speed * (t - time);
      }
    };



    /// Makes a motion even over as many rows as the rounding lets it be.
    struct Evener
    {
      const std::vector<double> &time, &recorded;
      const double               step;
      const std::vector<double> &motion; ///< between the stairs

      // One piece goes over into the next where they meet.
      std::vector<double> evened() const
      {
        std::vector<EvenMotion> pieces = certain_pieces();
        if (pieces.empty())
          return motion;
        for (std::size_t p = 1; p < pieces.size(); ++p)
          {
            EvenMotion  &a = pieces[p - 1], &b = pieces[p];
            const double meet =
              a.time + (b.at(a.time) - a.value) / (a.speed - b.speed);
            // A rest of minutes is no creep towards a row that just moves.
            const auto middle = [&](const std::size_t i) {
              return 0.5 * (time[i] + time[i + 1]);
            };
            while (
              b.begin - a.begin > 1 && is_within_rounding(b, b.begin - 1) &&
              meet < (a.speed == 0. ? middle(b.begin - 2) : time[b.begin - 1]))
              a.end = --b.begin;
            while (b.end - b.begin > 1 && is_within_rounding(a, b.begin) &&
                   meet > (b.speed == 0. ? middle(b.begin) : time[b.begin]))
              a.end = ++b.begin;
          }
        std::vector<double> result;
        for (const EvenMotion &piece : pieces)
          for (std::size_t i = piece.begin; i < piece.end; ++i)
            result.push_back(std::clamp(piece.at(time[i]),
                                        recorded[i] - 0.5 * step,
                                        recorded[i] + 0.5 * step));
        return result;
      }

      // By least squares.
      EvenMotion fit(const std::size_t begin, const std::size_t end) const
      {
        EvenMotion   result{begin, end};
        const double n = end - begin;
        for (std::size_t i = begin; i < end; ++i)
          {
            result.time += time[i] / n;
            result.value += motion[i] / n;
          }
        double tt = 0., tv = 0.;
        for (std::size_t i = begin; i < end; ++i)
          {
            const double t = time[i] - result.time;
            tt += t * t;
            tv += t * (motion[i] - result.value);
          }
        result.speed = tt > 0. ? tv / tt : 0.;
        return result;
      }

      // Without the first and the last stair, in which another motion may
      // begin.
      EvenMotion fit_core(const std::size_t begin, const std::size_t end) const
      {
        std::size_t first = begin, last = end;
        while (first < end && recorded[first] == recorded[begin])
          ++first;
        while (last > first && recorded[last - 1] == recorded[end - 1])
          --last;
        EvenMotion result =
          last - first > 2 ? fit(first, last) : fit(begin, end);
        result.begin = begin;
        result.end   = end;
        return result;
      }

      bool is_within_rounding(const EvenMotion &piece,
                              const std::size_t row) const
      {
        constexpr double nearly = 1.1;

        return std::abs(piece.at(time[row]) - recorded[row]) <=
               0.5 * nearly * step;
      }

      bool is_within_rounding(const EvenMotion &piece) const
      {
        for (std::size_t i = piece.begin; i < piece.end; ++i)
          if (!is_within_rounding(piece, i))
            return false;
        return true;
      }

      bool is_rest(const EvenMotion &piece) const
      {
        return piece.end - piece.begin > 1 &&
               motion[piece.end - 1] == motion[piece.begin];
      }

      // A rest, or far enough to know the speed.
      bool is_certain(const EvenMotion &piece) const
      {
        constexpr double steps = 2.;

        return is_rest(piece) ||
               std::abs(recorded[piece.end - 1] - recorded[piece.begin]) >=
                 steps * step * (1. - 1e-6);
      }

      // What lies between goes over from one to the other.
      std::vector<EvenMotion> certain_pieces() const
      {
        const auto way = [&](const std::size_t i) {
          return (motion[i + 1] > motion[i]) - (motion[i + 1] < motion[i]);
        };
        std::vector<EvenMotion> all, result;
        for (std::size_t begin = 0, end = 1; begin < time.size(); begin = end)
          {
            end = begin + 1;
            while (end < time.size() && way(end - 1) == way(begin))
              ++end;
            add_pieces(begin, end, all);
          }
        for (const EvenMotion &piece : all)
          if (is_certain(piece))
            {
              result.push_back(piece);
              if (is_rest(piece))
                result.back().speed = 0.;
              result.back().begin =
                result.size() > 1 ? result[result.size() - 2].end : 0;
            }
          else if (!result.empty())
            result.back().end = piece.end;
        return result;
      }

      // Of rows that go one way, or rest: from the left as long ones as can be,
      // up to where it would take too long to try.
      void add_pieces(const std::size_t        begin,
                      const std::size_t        end,
                      std::vector<EvenMotion> &pieces) const
      {
        constexpr std::size_t most_rows = 2000;

        for (std::size_t from = begin; from < end; from = pieces.back().end)
          {
            const std::size_t last = std::min(from + most_rows, end);
            std::size_t       good = std::min(from + 2, end), bad = last + 1;
            while (bad - good > 1)
              {
                const std::size_t to = bad > last ? last : (good + bad) / 2;
                (is_within_rounding(fit(from, to)) ? good : bad) = to;
              }
            pieces.push_back(fit_core(from, good));
          }
      }
    };
  } // namespace



  double rounding_of_motion(const std::vector<double> &values)
  {
    constexpr double      largest_share = 0.01; // of the range
    constexpr std::size_t least_stairs = 3, least_sizes = 3, many_stairs = 20;

    const std::vector<Stair> stairs = find_stairs(values);
    double                   step   = std::numeric_limits<double>::infinity();
    for (std::size_t s = 1; s < stairs.size(); ++s)
      step = std::min(step, std::abs(stairs[s].value - stairs[s - 1].value));
    if (!(step < largest_share * range_of(values)))
      return 0.;
    std::size_t      n_stairs = 0;
    std::set<double> sizes;
    for (std::size_t s = 1; s < stairs.size(); ++s)
      {
        const double ratio = (stairs[s].value - stairs[s - 1].value) / step;
        if (!is_whole(ratio))
          return 0.;
        sizes.insert(std::abs(std::round(ratio)));
        // Between two single steps in one direction: what takes several of them
        // in a row and then stays is a stroke.
        if (stairs[s].is_long() && s + 1 < stairs.size() &&
            std::abs(ratio) < 1.5)
          {
            const double next = (stairs[s + 1].value - stairs[s].value) / step;
            n_stairs += next * ratio > 0. && std::abs(next) < 1.5;
          }
      }
    // Few equal strokes, each passed within a row, look alike, but have one
    // size.
    return n_stairs >=
               (sizes.size() < least_sizes ? many_stairs : least_stairs) ?
             step :
             0.;
  }



  std::vector<double> without_stairs(const std::vector<double> &time,
                                     const std::vector<double> &values,
                                     const double               step)
  {
    const std::vector<double> motion =
      StairMotion{time, step, find_stairs(values)}.motion(values);
    return Evener{time, values, step, motion}.evened();
  }



  namespace
  {
    // Between rows so many apart, the steps of an even clock differ by one of
    // rounding at most.
    bool is_even_at(const std::vector<double> &time,
                    const std::size_t          row,
                    const double               rounding)
    {
      for (const std::size_t lag : {1, 2, 4, 8})
        if (std::abs(time[row + lag] - 2. * time[row] + time[row - lag]) >
            1.01 * rounding)
          return false;
      return true;
    }
  } // namespace



  double rounding_of_time(const std::vector<double> &time)
  {
    constexpr std::size_t farthest = 8, fewest_rows = 20;
    constexpr double      least_share = 0.01, most_share = 0.9, alike = 1e-6,
                     mostly = 0.9, often = 0.05;

    if (time.size() < fewest_rows)
      return 0.;
    std::vector<double> steps;
    for (std::size_t i = 1; i < time.size(); ++i)
      steps.push_back(time[i] - time[i - 1]);
    const double usual    = median(steps);
    double       rounding = std::numeric_limits<double>::infinity();
    std::size_t  n_other = 0, n_even = 0;
    for (std::size_t i = 1; i < steps.size(); ++i)
      if (const double other = std::abs(steps[i] - steps[i - 1]);
          other > alike * usual)
        {
          rounding = std::min(rounding, other);
          ++n_other;
        }
    // Twice the usual step is a row that is missing.
    if (n_other < often * steps.size() || rounding < least_share * usual ||
        rounding > most_share * usual)
      return 0.;
    for (const double step : steps)
      if (step < 1e2 * usual && !is_whole(step / rounding))
        return 0.;
    for (std::size_t i = farthest; i + farthest < time.size(); ++i)
      n_even += is_even_at(time, i, rounding);
    return n_even >= mostly * (time.size() - 2 * farthest) ? rounding : 0.;
  }



  void undo_rounding_of_time(MeasuredTest &test)
  {
    const double rounding = rounding_of_time(test.time);
    if (rounding == 0.)
      return;
    std::vector<double> rows(test.time.size());
    std::iota(rows.begin(), rows.end(), 0.);
    const std::vector<double> even =
      Evener{rows, test.time, rounding, test.time}.evened();
    // Where the clock changes, two stamps might meet.
    if (std::adjacent_find(even.begin(),
                           even.end(),
                           std::greater_equal<double>()) == even.end())
      test.time = even;
  }



  bool are_multiples(const std::vector<double> &values,
                     const double               step,
                     const double               tolerance)
  {
    return step > 0. && all_of(values, [&](const double value) {
             return is_whole(value / step, tolerance);
           });
  }



  namespace
  {
    // Of one axis: that seen in its stairs, or that of other records.
    double rounding_of_axis(const std::vector<double> &values,
                            const double               of_others)
    {
      const double own = rounding_of_motion(values);
      return own == 0. && are_multiples(values, of_others) ? of_others : own;
    }
  } // namespace



  double rounding_of_motion(const MeasuredTest &test, const double of_others)
  {
    return std::max(rounding_of_axis(test.displacement, of_others),
                    test.displacement_y.empty() ?
                      0. :
                      rounding_of_axis(test.displacement_y, of_others));
  }



  namespace
  {
    /// The straight line of least squares through places in the plane.
    class StraightLine
    {
    public:
      StraightLine(const std::vector<double> &x, const std::vector<double> &y)
        : middle_x(std::accumulate(x.begin(), x.end(), 0.) / x.size())
        , middle_y(std::accumulate(y.begin(), y.end(), 0.) / y.size())
      {
        double xx = 0., xy = 0., yy = 0.;
        for (std::size_t i = 0; i < x.size(); ++i)
          {
            const double dx = x[i] - middle_x, dy = y[i] - middle_y;
            xx += dx * dx;
            xy += dx * dy;
            yy += dy * dy;
          }
        const double angle = 0.5 * std::atan2(2. * xy, xx - yy);
        cosine             = std::cos(angle);
        sine               = std::sin(angle);
      }

      // Whether it passes all places rounded to this step, nearly.
      bool passes(const std::vector<double> &x,
                  const std::vector<double> &y,
                  const double               step) const
      {
        constexpr double nearly = 1.2;

        const double most =
          0.5 * nearly * step * (std::abs(cosine) + std::abs(sine));
        for (std::size_t i = 0; i < x.size(); ++i)
          if (std::abs((y[i] - middle_y) * cosine - (x[i] - middle_x) * sine) >
              most)
            return false;
        return true;
      }

      void project(double &x, double &y) const
      {
        const double along = (x - middle_x) * cosine + (y - middle_y) * sine;
        x                  = middle_x + along * cosine;
        y                  = middle_y + along * sine;
      }

    private:
      const double middle_x, middle_y;
      double       cosine = 1., sine = 0.;
    };
  } // namespace



  void undo_rounding_of_motion(MeasuredTest &test, const double of_others)
  {
    const std::vector<double> recorded   = test.displacement;
    const std::vector<double> recorded_y = test.displacement_y;
    double                    largest    = 0.;
    for (std::vector<double> *values :
         {&test.displacement, &test.displacement_y})
      {
        const double step =
          values->empty() ? 0. : rounding_of_axis(*values, of_others);
        largest = std::max(largest, step);
        if (step > 0.)
          *values = without_stairs(test.time, *values, step);
      }
    if (largest > 0. && !recorded_y.empty())
      {
        const StraightLine line(recorded, recorded_y);
        if (line.passes(recorded, recorded_y, largest))
          for (std::size_t i = 0; i < test.time.size(); ++i)
            line.project(test.displacement[i], test.displacement_y[i]);
      }
    if (largest > 0.)
      test.warnings.push_back(
        test.file.string() + ": the displacement is rounded to " +
        short_text(largest) +
        " mm: between these steps the motion is taken to be uniform; record "
        "positions with more digits");
  }
} // namespace SlipStep
