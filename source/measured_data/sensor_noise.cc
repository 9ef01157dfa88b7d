// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/resample.h>
#include <slipstep/measured_data/sensor_noise.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace SlipStep
{
  namespace
  {
    using Rows = std::vector<std::size_t>;

    /// What one sensor showed.
    struct Signal
    {
      const std::vector<double> *values;
      double                     deviation; ///< of its noise
    };

    // Of a white noise one row in a billion is as far off.
    constexpr double farthest_off = 6.;

    // A symmetric tridiagonal system of equations, by elimination.
    std::vector<double> solve(std::vector<double>        diagonal,
                              const std::vector<double> &beside,
                              std::vector<double>        right)
    {
      const std::size_t n = diagonal.size();
      for (std::size_t k = 1; k < n; ++k)
        {
          const double factor = beside[k - 1] / diagonal[k - 1];
          diagonal[k] -= factor * beside[k - 1];
          right[k] -= factor * right[k - 1];
        }
      for (std::size_t k = n; k-- > 0;)
        right[k] = (right[k] - (k + 1 < n ? beside[k] * right[k + 1] : 0.)) /
                   diagonal[k];
      return right;
    }



    // Of the piecewise linear function with these knots that is closest to the
    // values: what it is at the knots.
    std::vector<double> fit_lines(const std::vector<double> &time,
                                  const std::vector<double> &values,
                                  const Rows                &knots)
    {
      std::vector<double> diagonal(knots.size(), 0.), beside(diagonal),
        right(diagonal);
      for (std::size_t k = 0; k + 1 < knots.size(); ++k)
        {
          const std::size_t begin = knots[k], end = knots[k + 1];
          const bool        is_last = k + 2 == knots.size();
          for (std::size_t i = begin; i < end + is_last; ++i)
            {
              const double there =
                (time[i] - time[begin]) / (time[end] - time[begin]);
              const double here = 1. - there;
              diagonal[k] += here * here;
              diagonal[k + 1] += there * there;
              beside[k] += here * there;
              right[k] += here * values[i];
              right[k + 1] += there * values[i];
            }
        }
      return solve(diagonal, beside, right);
    }



    /// A straight line through rows that are sure to lie on one.
    struct Line
    {
      double n = 0., time = 0., mean = 0., slope = 0.;
      bool   is_level = false;
    };

    /// Straight lines of one signal between knots, level where noise may have
    /// made them rise.
    class Lines
    {
    public:
      Lines(const std::vector<double> &time,
            const Signal              &signal,
            const Rows                &knots)
        : time(time)
        , values(*signal.values)
        , deviation(signal.deviation)
        , knots(knots)
        , heights(fit_lines(time, values, knots))
      {
        for (std::size_t k = 0; k + 1 < knots.size(); ++k)
          lines.push_back(line_through(k));
        level();
      }

      // When a level line meets its neighbour at a knot, and by how many
      // deviations of the noise they part in a second.
      std::pair<double, double> meeting(const std::size_t knot) const
      {
        const Line &before = lines[knot - 1], &after = lines[knot];
        if (before.is_level == after.is_level)
          return {0., 0.};
        const double parts = before.slope - after.slope;
        return {(after.mean - after.slope * after.time - before.mean +
                 before.slope * before.time) /
                  parts,
                std::abs(parts) / deviation};
      }

      std::vector<double> at_all_rows() const
      {
        std::vector<double> result(values.size());
        for (std::size_t k = 0; k + 1 < knots.size(); ++k)
          {
            const std::size_t begin = knots[k], end = knots[k + 1];
            for (std::size_t i = begin; i <= end; ++i)
              {
                const double there =
                  (time[i] - time[begin]) / (time[end] - time[begin]);
                result[i] = heights[k] + there * (heights[k + 1] - heights[k]);
              }
          }
        return result;
      }

    private:
      // By so many rows noise hides where a line goes over into the next one.
      std::size_t hidden_rows(const std::size_t knot) const
      {
        const auto rise = [&](const std::size_t line) {
          return (heights[line + 1] - heights[line]) /
                 (knots[line + 1] - knots[line]);
        };
        const double per_row = std::abs(rise(knot) - rise(knot - 1));
        return std::ceil(
          std::min<double>(farthest_off * deviation / std::max(per_row, 1e-300),
                           values.size()));
      }

      Line line_through(const std::size_t line) const
      {
        constexpr std::size_t least_rows = 5;
        constexpr double      sure       = 4.;

        const std::size_t quarter = (knots[line + 1] - knots[line]) / 4;
        std::size_t       begin = knots[line], end = knots[line + 1] + 1;
        if (line > 0)
          begin += std::min(hidden_rows(line), quarter);
        if (line + 2 < knots.size())
          end -= std::min(hidden_rows(line + 1), quarter);
        Line result;
        result.n = end - begin;
        for (std::size_t i = begin; i < end; ++i)
          {
            result.mean += values[i] / result.n;
            result.time += time[i] / result.n;
          }
        double rises = 0., squares = 0.;
        for (std::size_t i = begin; i < end; ++i)
          {
            rises += (values[i] - result.mean) * (time[i] - result.time);
            squares += std::pow(time[i] - result.time, 2);
          }
        result.is_level =
          result.n >= least_rows &&
          std::abs(rises) <= sure * deviation * std::sqrt(squares);
        result.slope = result.is_level ? 0. : rises / squares;
        return result;
      }

      // Neighbours become one.
      void level()
      {
        for (std::size_t begin = 0; begin < lines.size(); ++begin)
          {
            std::size_t end = begin;
            double      sum = 0., weight = 0.;
            for (; end < lines.size() && lines[end].is_level; ++end)
              {
                sum += lines[end].n * lines[end].mean;
                weight += lines[end].n;
              }
            for (std::size_t k = begin; k <= end && weight > 0.; ++k)
              heights[k] = sum / weight;
            begin = std::max(begin, end - (end > begin));
          }
      }

      const std::vector<double> &time, &values;
      const double               deviation;
      const Rows                &knots;
      std::vector<double>        heights; // at the knots
      std::vector<Line>          lines;
    };



    // Move the knots to where level lines meet their neighbours, of the signal
    // which tells that best.
    Rows moved_knots(const std::vector<double> &time,
                     const std::vector<Signal> &signals,
                     const Rows                &knots)
    {
      std::vector<Lines> lines;
      for (const Signal &signal : signals)
        lines.emplace_back(time, signal, knots);
      Rows result = knots;
      for (std::size_t k = 1; k + 1 < knots.size(); ++k)
        {
          std::pair<double, double> best(0., 0.);
          for (const Lines &one : lines)
            {
              const auto meeting = one.meeting(k);
              if (meeting.second > best.second)
                best = meeting;
            }
          if (best.second == 0.)
            continue;
          const double meet  = best.first;
          const auto   later = std::lower_bound(time.begin(), time.end(), meet);
          std::size_t  row   = later - time.begin();
          if (row > 0 &&
              (later == time.end() || *later - meet > meet - later[-1]))
            --row;
          if (row > result[k - 1] && row < knots[k + 1])
            result[k] = row;
        }
      return result;
    }



    // As noise_level(), but of rows at uneven times, where that takes a motion
    // for noise: about the polynomial through the neighbours, a line for a
    // reach of 1, a cubic for 2. Of motion that bends more it is too much.
    double noise_about_neighbours(const std::vector<double> &time,
                                  const std::vector<double> &values,
                                  const std::size_t          reach)
    {
      std::vector<double> distances;
      for (std::size_t i = reach; i + reach < values.size(); ++i)
        {
          double there = 0., squares = 1.;
          for (std::size_t j = i - reach; j <= i + reach; ++j)
            {
              double weight = j == i ? 0. : 1.;
              for (std::size_t k = i - reach; k <= i + reach && j != i; ++k)
                if (k != i && k != j)
                  weight *= (time[i] - time[k]) / (time[j] - time[k]);
              there += weight * values[j];
              squares += weight * weight;
            }
          distances.push_back(std::abs(values[i] - there) / std::sqrt(squares));
        }
      return distances.empty() ? std::numeric_limits<double>::infinity() :
                                 median(std::move(distances)) / 0.6745;
    }



    // Whether values go on by a few different steps, as of a counter or of
    // digits that hide the noise: white noise makes more of them.
    bool is_counted(const std::vector<double> &values)
    {
      constexpr std::size_t few   = 10;
      constexpr double      alike = 1e-9;

      std::vector<double> steps;
      for (std::size_t i = 1; i < values.size(); ++i)
        steps.push_back(values[i] - values[i - 1]);
      std::sort(steps.begin(), steps.end());
      const double size =
        std::max(std::abs(steps.front()), std::abs(steps.back()));
      std::size_t n = 1;
      for (std::size_t i = 1; i < steps.size(); ++i)
        n += steps[i] - steps[i - 1] > alike * size;
      return n < few;
    }



    // Of few rows nothing tells bends from scatter, but that what stands still
    // to the last digit does not tremble.
    bool stands_still(const std::vector<double> &values)
    {
      constexpr std::size_t few_rows = 100, least_pairs = 2;

      std::size_t n = 0;
      for (std::size_t i = 1; i < values.size(); ++i)
        n += values[i] == values[i - 1];
      return values.size() < few_rows && n >= least_pairs;
    }



    double white_noise(const std::vector<double> &time,
                       const std::vector<double> &values)
    {
      return is_counted(values) || stands_still(values) ?
               0. :
               std::min({noise_level(values),
                         noise_about_neighbours(time, values, 1),
                         noise_about_neighbours(time, values, 2)});
    }



    // Whether what is left of a signal is its noise, and nothing that lasts.
    bool is_noise(const std::vector<double> &values,
                  const std::vector<double> &lines,
                  const double               deviation)
    {
      constexpr double larger = 2., lasting = 0.1, sure = 3.;

      double       square = 0., next = 0.;
      const double n = values.size();
      for (std::size_t i = 0; i < values.size(); ++i)
        {
          const double here = values[i] - lines[i];
          square += here * here;
          if (i > 0)
            next += here * (values[i - 1] - lines[i - 1]);
        }
      return std::sqrt(square / n) <= larger * deviation &&
             next <= (lasting + sure / std::sqrt(n)) * square;
    }
  } // namespace



  bool take_off_noise(const std::vector<double>         &time,
                      std::vector<std::vector<double> *> channels,
                      const std::vector<double>         &deviations)
  {
    constexpr std::size_t least_rows = 3; // per line
    constexpr double      finest     = 0.05;

    const double largest =
      *std::max_element(deviations.begin(), deviations.end());
    if (!(largest > 0.))
      return false;
    std::vector<Signal>         signals;
    std::vector<BendingChannel> series;
    for (std::size_t i = 0; i < channels.size(); ++i)
      {
        const double deviation = std::max(deviations[i], finest * largest);
        signals.push_back({channels[i], deviation});
        series.push_back({channels[i], farthest_off * deviation});
      }
    Rows knots = rows_of_bends(time, series, {0, time.size() - 1});
    if (least_rows * knots.size() > time.size())
      return false;
    knots = moved_knots(time, signals, knots);
    std::vector<std::vector<double>> results;
    for (const Signal &signal : signals)
      results.push_back(Lines(time, signal, knots).at_all_rows());
    for (std::size_t i = 0; i < channels.size(); ++i)
      if (deviations[i] > finest * largest &&
          !is_noise(*channels[i], results[i], deviations[i]))
        return false;
    for (std::size_t i = 0; i < channels.size(); ++i)
      if (deviations[i] > finest * largest)
        *channels[i] = results[i];
    return true;
  }



  void take_off_noise_of_motion(MeasuredTest &test, const double felt)
  {
    constexpr double felt_of_pressure = 2.5e-4;

    const auto clean = [&](const std::vector<std::vector<double> *> &channels,
                           const double                              least,
                           const std::string                        &words,
                           const std::string                        &unit) {
      std::vector<double> deviations;
      for (const std::vector<double> *values : channels)
        deviations.push_back(white_noise(test.time, *values));
      const double largest =
        *std::max_element(deviations.begin(), deviations.end());
      if (largest > least && take_off_noise(test.time, channels, deviations))
        test.warnings.push_back(
          test.file.string() + ": the " + words + " trembles by " +
          rounded_text(largest, 2) + ' ' + unit +
          " (standard deviation), which a contact would respond to: this is "
          "taken for noise of the sensor and removed");
    };
    std::vector<std::vector<double> *> motion = {&test.displacement};
    if (!test.displacement_y.empty())
      motion.push_back(&test.displacement_y);
    clean(motion, felt, "displacement", "mm");
    std::vector<double> pressure = test.pressure;
    clean({&pressure},
          felt_of_pressure * median(test.pressure),
          "pressure",
          "MPa");
    // Lines may end below nothing.
    for (std::size_t i = 0; i < pressure.size(); ++i)
      if (pressure[i] > 0. && test.pressure[i] > 0.)
        test.pressure[i] = pressure[i];
  }
} // namespace SlipStep
