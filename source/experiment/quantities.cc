// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/quantities.h>

#include <slipstep/utilities/lists.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace SlipStep
{
  double monotone_interpolation(const std::vector<double> &abscissas,
                                const std::vector<double> &values,
                                const double               x)
  {
    const std::size_t n = abscissas.size();
    if (n == 0 || !(x >= abscissas.front() && x <= abscissas.back()))
      return QuantityOfInterest::undefined;
    if (n == 1)
      return values.front();
    const std::size_t right = std::min<std::size_t>(
      n - 1,
      std::max<std::size_t>(
        1,
        std::lower_bound(abscissas.begin(), abscissas.end(), x) -
          abscissas.begin()));
    const auto step = [&](const std::size_t i) {
      return abscissas[i + 1] - abscissas[i];
    };
    const auto secant = [&](const std::size_t i) {
      return (values[i + 1] - values[i]) / step(i);
    };

    // The slope of a parabola through three points, kept within what leaves the
    // cubic monotone; none where the secants change sign.
    const auto slope = [&](const std::size_t i) {
      if (n == 2)
        return secant(0);
      if (i == 0 || i == n - 1)
        {
          const std::size_t near = i == 0 ? 0 : n - 2, far = i == 0 ? 1 : n - 3;
          const double      h = step(near), H = step(far);
          const double      d = secant(near), D = secant(far);
          const double      parabola = ((2. * h + H) * d - h * D) / (h + H);
          // Undefined neighbours leave the straight line.
          if (!std::isfinite(parabola))
            return d;
          return parabola * d <= 0. ? 0. :
                 d * D <= 0. && std::abs(parabola) > 3. * std::abs(d) ?
                                      3. * d :
                                      parabola;
        }
      const double d = secant(i - 1), D = secant(i);
      if (!std::isfinite(d) || !std::isfinite(D))
        return std::isfinite(d) ? d : D;
      if (d * D <= 0.)
        return 0.;
      const double h = step(i - 1), H = step(i);
      const double parabola = (H * d + h * D) / (h + H);
      const double limit    = 3. * std::min(std::abs(d), std::abs(D));
      return std::copysign(std::min(std::abs(parabola), limit), d);
    };

    const std::size_t left = right - 1;
    const double      h    = step(left);
    const double      t    = (x - abscissas[left]) / h;
    if (t == 0. || t == 1.)
      return values[t == 0. ? left : right];
    const double s = 1. - t;
    return s * s * (1. + 2. * t) * values[left] +
           t * t * (1. + 2. * s) * values[right] +
           t * s * h * (s * slope(left) - t * slope(right));
  }



  namespace
  {
    using Kind = QuantityOfInterest::Kind;

    /// A parabola through three points.
    struct Parabola
    {
      Parabola(const std::array<double, 3> &x, const std::array<double, 3> &y)
        : middle(x[1])
        , value(y[1])
      {
        const double h = x[1] - x[0], H = x[2] - x[1];
        const double d = (y[1] - y[0]) / h, D = (y[2] - y[1]) / H;
        if (h > 0. && H > 0.)
          {
            curvature = (D - d) / (h + H);
            slope     = (H * d + h * D) / (h + H);
          }
      }

      double at(const double x) const
      {
        return value + (slope + curvature * (x - middle)) * (x - middle);
      }

      double middle, value;  ///< of the points
      double curvature = 0.; ///< half of it
      double slope     = 0.; ///< at the point in the middle
    };



    /// What a history says between its rows.
    struct HistoryReader
    {
      const Programme               &programme;
      const std::vector<HistoryRow> &history;
      const SlidingPath              path;

      /// @param displacement path of the drive [mm]; NaN for the end
      template <typename Value>
      double at(const double displacement, const Value &value) const
      {
        std::size_t  segment = programme.segments().size() - 1;
        const double time    = std::isnan(displacement) ?
                                 programme.end_time() :
                                 time_of(displacement, segment);
        return interpolate(segment, time, value);
      }

      /// Force against the motion of the drive, at a path of the drive.
      double friction_force(const double displacement) const
      {
        std::size_t segment = 0;
        const auto  time    = time_of(displacement, segment);
        const auto  motion  = programme.segments()[segment].end.velocity;
        return interpolate(segment, time, [&](const HistoryRow &row) {
          return (motion[0] * row.tangential_load +
                  motion[1] * row.friction_y * row.normal_load) /
                 motion.norm();
        });
      }

      /// Path and value of the largest friction coefficient: the vertex of the
      /// parabola through it and its neighbours, so that the place does not
      /// depend on where the steps fall. There is none in a corner, which is
      /// bent far more than what is beside it, nor above a plateau, which the
      /// next parabola shows.
      std::pair<double, double> peak() const
      {
        constexpr double corner = 3.;

        const auto magnitude = [](const HistoryRow &row) {
          return std::hypot(row.friction, row.friction_y);
        };
        double largest = 0.;
        for (const HistoryRow &row : history)
          largest = std::max(largest, magnitude(row));
        std::size_t i = 0;
        while (i < history.size() &&
               magnitude(history[i]) < (1. - 1e-9) * largest)
          ++i;
        if (i == history.size())
          return {QuantityOfInterest::undefined, QuantityOfInterest::undefined};

        const double x1 = path_of_row(i), y1 = magnitude(history[i]);
        const auto [begin, end] = times_of_statement(history[i].time);
        const auto is_near =
          [&, begin = begin, end = end](const std::size_t row) {
            return row < history.size() &&
                   history[row].time >= begin - round_off() &&
                   history[row].time <= end + round_off();
          };
        const auto around = [&](const std::size_t row) {
          std::array<double, 3> x, y;
          for (std::size_t k = 0; k < 3; ++k)
            {
              x[k] = path_of_row(row - 1 + k);
              y[k] = magnitude(history[row - 1 + k]);
            }
          return Parabola(x, y);
        };
        // Beyond the first row they are as far as can be.
        if (!is_near(i - 1) || !is_near(i + 1))
          return {x1, y1};
        const Parabola      top = around(i);
        std::vector<double> beside;
        if (is_near(i - 2))
          beside.push_back(around(i - 1).curvature);
        if (is_near(i + 2))
          beside.push_back(around(i + 1).curvature);
        if (!(top.curvature < 0.) ||
            (!beside.empty() &&
             top.curvature <
               corner *
                 std::min(0., *std::min_element(beside.begin(), beside.end()))))
          return {x1, y1};
        const double vertex = x1 - top.slope / (2. * top.curvature);
        const double height = top.at(vertex);
        if (vertex > x1 && is_near(i + 2) &&
            around(i + 1).at(vertex) < 0.5 * (y1 + height))
          return {x1, y1};
        return {vertex, height};
      }

      double time_of(const double displacement, std::size_t &segment) const
      {
        const std::vector<double> &path_after = path.after_segments();
        segment =
          std::min<std::size_t>(path_after.size() - 1,
                                std::lower_bound(path_after.begin(),
                                                 path_after.end(),
                                                 displacement * (1. - 1e-12)) -
                                  path_after.begin());
        const Segment &moving = programme.segments()[segment];
        const double   before = segment == 0 ? 0. : path_after[segment - 1];
        const double   share =
          (displacement - before) / (path_after[segment] - before);
        return moving.start_time +
               std::min(share, 1.) * (moving.end_time - moving.start_time);
      }

      /// Begin and end of a statement, of two the first [s].
      /// A replayed test has a segment per sample, which says nothing about the
      /// friction: only the borders of statements are kinks.
      std::pair<double, double> times_of_statement(const double time) const
      {
        const auto &segments = programme.segments();
        std::size_t first    = 0;
        while (first + 1 < segments.size() &&
               segments[first].end_time < time - round_off())
          ++first;
        std::size_t last = first;
        while (first > 0 &&
               segments[first - 1].statement == segments[last].statement)
          --first;
        while (last + 1 < segments.size() &&
               segments[last + 1].statement == segments[first].statement)
          ++last;
        return {segments[first].start_time, segments[last].end_time};
      }

      /// Path of the drive, with what pushes moved.
      double path_of_row(const std::size_t row) const
      {
        const auto &segments = programme.segments();
        if (none_of(segments, [](const Segment &one) { return one.pushes; }))
          return path.at(history[row].time);
        double sum =
          std::hypot(history[0].displacement, history[0].displacement_y);
        for (std::size_t i = 1; i <= row; ++i)
          sum +=
            std::hypot(history[i].displacement - history[i - 1].displacement,
                       history[i].displacement_y -
                         history[i - 1].displacement_y);
        return sum;
      }

      /// Steps end at the borders of segments but for round-off.
      double round_off() const
      {
        return 8. * std::numeric_limits<double>::epsilon() *
               programme.end_time();
      }

      template <typename Value>
      double interpolate(const std::size_t segment,
                         const double      time,
                         const Value      &value) const
      {
        const auto [begin, end] =
          times_of_statement(programme.segments()[segment].end_time);
        std::vector<double> times, values;
        for (const HistoryRow &row : history)
          if (row.time >= begin - round_off() && row.time <= end + round_off())
            {
              times.push_back(row.time);
              values.push_back(value(row));
            }
        if (!times.empty() && std::abs(time - times.back()) <= round_off())
          return values.back();
        return monotone_interpolation(times, values, time);
      }
    };



    std::string unit(const Kind kind, const unsigned int dimension)
    {
      const std::string per = per_size(dimension);
      switch (kind)
        {
          case Kind::friction_force:
          case Kind::force:
            return "N" + per;
          case Kind::moment:
          case Kind::dissipated_energy:
            return "N mm" + per;
          case Kind::pressure:
          case Kind::largest_pressure:
          case Kind::smallest_pressure:
            return "MPa";
          case Kind::peak_coefficient:
            return "";
          default:
            return "mm";
        }
    }
  } // namespace



  std::string per_size(const unsigned int dimension)
  {
    return dimension == 0 ? "/mm^2" : dimension == 2 ? "/mm" : "";
  }



  std::vector<QuantityValue>
  evaluate_quantities(const std::vector<QuantityOfInterest> &quantities,
                      const Programme                       &programme,
                      const std::vector<HistoryRow>         &history,
                      const unsigned int                     dimension)
  {
    const HistoryReader reader{programme, history, SlidingPath(programme)};
    std::vector<QuantityValue> values;
    std::size_t                n_probes = 0;
    for (const QuantityOfInterest &quantity : quantities)
      {
        QuantityValue result;
        result.name = quantity.name;
        result.unit = unit(quantity.kind, dimension);
        if (quantity.is_probe())
          {
            const std::size_t probe = n_probes++;
            result.value =
              reader.at(quantity.displacement, [&](const HistoryRow &row) {
                return dimension > 0 && probe < row.probes.size() ?
                         row.probes[probe] :
                         QuantityOfInterest::undefined;
              });
          }
        else if (quantity.kind == Kind::friction_force)
          result.value = reader.friction_force(quantity.displacement);
        else if (quantity.kind == Kind::dissipated_energy)
          result.value =
            reader.at(quantity.displacement, [](const HistoryRow &row) {
              return row.dissipated_energy;
            });
        else
          result.value = quantity.kind == Kind::peak_coefficient ?
                           reader.peak().second :
                           reader.peak().first;
        values.push_back(result);
      }
    return values;
  }
} // namespace SlipStep
