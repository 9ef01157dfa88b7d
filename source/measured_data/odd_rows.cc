// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/odd_rows.h>
#include <slipstep/measured_data/rounded_motion.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace SlipStep
{
  double usual_size(std::vector<double> values)
  {
    constexpr double share = 0.95;

    for (double &value : values)
      value = std::abs(value);
    const auto limit =
      values.begin() + std::lround(std::ceil(share * (values.size() - 1)));
    std::nth_element(values.begin(), limit, values.end());
    return *limit;
  }



  namespace
  {
    // Noise turns at two of three rows; rows of a value that is in question say
    // nothing.
    bool scatters_elsewhere(const std::vector<double> &values,
                            const double               repeated)
    {
      constexpr std::size_t least_rows = 20;
      constexpr double      share      = 0.3;

      std::size_t n = 0, n_turns = 0;
      for (std::size_t i = 1; i + 1 < values.size(); ++i)
        {
          if (values[i - 1] == repeated || values[i] == repeated ||
              values[i + 1] == repeated)
            continue;
          ++n;
          n_turns +=
            (values[i] - values[i - 1]) * (values[i + 1] - values[i]) < 0.;
        }
      return n >= least_rows && n_turns > share * n;
    }



    std::vector<double> without_gaps(std::vector<double> values)
    {
      remove_erase_if(values, [](const double x) { return std::isnan(x); });
      return values;
    }



    // The largest size that is there, of a series that stays on it far more
    // often than on the one before: 0 if it does not.
    double limit_of(const std::vector<double> &values, const std::size_t least)
    {
      constexpr double more_often = 5.;

      std::map<double, std::size_t> n_of_size;
      for (const double value : values)
        ++n_of_size[std::abs(value)];
      if (n_of_size.size() < 3)
        return 0.;
      const auto        largest = std::prev(n_of_size.end());
      const std::size_t n       = largest->second;
      return n >= least && n >= more_often * std::prev(largest)->second ?
               largest->first :
               0.;
    }
  } // namespace



  std::vector<double> under_load(std::vector<double> values,
                                 const MeasuredTest &test)
  {
    const double load = 0.5 * median(test.pressure);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (test.pressure[i] < load)
        values[i] = std::numeric_limits<double>::quiet_NaN();
    return values;
  }



  namespace
  {
    // They show no scatter.
    constexpr std::size_t few_rows = 6;

    // How friction scatters in a stretch of rows, of which few may be one end
    // of a rise.
    double scatter_of(const std::vector<double> &friction,
                      const std::size_t          begin,
                      const std::size_t          end)
    {
      if (end - begin >= few_rows)
        return noise_level({friction.begin() + begin, friction.begin() + end});
      double largest = 0.;
      for (std::size_t i = begin; i < end && i + 1 < friction.size(); ++i)
        largest = std::max(largest, std::abs(friction[i] - friction[i + 1]));
      return largest;
    }
  } // namespace



  std::vector<std::size_t> rows_without_load(const MeasuredTest &test)
  {
    constexpr double hardly = 0.05, far = 5., least_share = 0.1;
    const double     load = median(test.pressure);
    if (none_of(test.pressure,
                [&](const double p) { return p < hardly * load; }))
      return {};
    const std::vector<double> friction = sizes_of_friction(test);
    std::vector<double>       loaded;
    for (std::size_t i = 0; i < friction.size(); ++i)
      if (test.pressure[i] >= 0.5 * load)
        loaded.push_back(friction[i]);
    // Adhesion makes more of friction there, too, but smoothly.
    const double usual = usual_size(loaded);
    const double at_least =
      std::max(least_share * usual, far * noise_of_friction(test));
    std::vector<std::size_t> rows;
    for (std::size_t begin = 0, end; begin < test.time.size(); begin = end + 1)
      {
        for (end = begin;
             end < test.time.size() && test.pressure[end] < hardly * load;)
          ++end;
        if (scatter_of(friction, begin, end) >
            (end - begin < few_rows ? 3. * usual : at_least))
          for (std::size_t i = begin; i < end; ++i)
            rows.push_back(i);
      }
    return rows;
  }



  std::optional<RepeatedValue> repeated_value(const std::vector<double> &values)
  {
    constexpr double      share = 0.02;
    constexpr std::size_t few = 10, many = 20;
    const std::size_t     least = std::ceil(share * values.size());

    const std::vector<double> known = without_gaps(values);
    const double              limit = limit_of(known, std::max(few, least));
    if (limit > 0. && scatters_elsewhere(values, limit) &&
        scatters_elsewhere(values, -limit))
      {
        const auto is_at_limit = [&](const double value) {
          return std::abs(value) == limit;
        };
        return RepeatedValue{
          "is exactly " + rounded_text(limit, 6) + " in " +
            std::to_string(count_if(values, is_at_limit)) +
            " rows and never more, while other rows scatter: was the sensor at "
            "its limit?",
          static_cast<std::size_t>(
            std::find_if(values.begin(), values.end(), is_at_limit) -
            values.begin())};
      }
    std::size_t first = 0, longest = 0;
    for (std::size_t begin = 0, end; begin < values.size(); begin = end)
      {
        end = begin + 1; // a gap is not equal to itself
        while (end < values.size() && values[end] == values[begin])
          ++end;
        if (end - begin > longest)
          {
            first   = begin;
            longest = end - begin;
          }
      }
    // Where values are steps of a sensor, some repeat themselves.
    if (longest < std::max(many, least) || coarse_step(known) > 0. ||
        !scatters_elsewhere(values, values[first]))
      return {};
    return RepeatedValue{"is exactly " + rounded_text(values[first], 6) +
                           " in " + std::to_string(longest) +
                           " rows one after the other, while other rows "
                           "scatter: was the sensor dead?",
                         first,
                         longest};
  }



  namespace
  {
    // Of sliding solids.
    constexpr double largest_friction    = 2.;
    constexpr double times_of_excursions = 3.; // usual values



    // Rows, some one after the other at most, to which a series goes in a step
    // far longer than usual and from which it comes back at once.
    std::vector<std::size_t> excursions(const std::vector<double> &x,
                                        const double               least)
    {
      constexpr std::size_t most_rows = 5;
      constexpr double      far = 10., back = 0.2, pattern = 0.05;

      std::vector<double> steps;
      for (std::size_t i = 1; i < x.size(); ++i)
        if (std::abs(x[i] - x[i - 1]) > 0.)
          steps.push_back(x[i] - x[i - 1]);
      // What hardly ever changes has no usual step. In few rows two excursions,
      // forth and back, are not usual yet.
      constexpr std::size_t n_left_out = 4;
      std::sort(steps.begin(), steps.end(), [](const double a, const double b) {
        return std::abs(a) < std::abs(b);
      });
      const bool has_usual = steps.size() > 4 * most_rows;
      if (has_usual)
        steps.resize(steps.size() - n_left_out);
      const double usual = has_usual ? usual_size(steps) : 0.;
      const double limit = std::max(least, far * usual);
      if (!(limit > 0.))
        return {};
      std::vector<std::size_t> rows;
      for (std::size_t i = 1; i < x.size(); ++i)
        {
          const double gone = std::abs(x[i] - x[i - 1]);
          if (!(gone > limit))
            continue;
          for (std::size_t j = i + 1; j < std::min(x.size(), i + most_rows + 1);
               ++j)
            if (std::abs(x[j] - x[i - 1]) < back * gone)
              {
                for (; i < j; ++i)
                  rows.push_back(i);
                break;
              }
        }
      return rows.size() <= std::max<double>(most_rows, pattern * x.size()) ?
               rows :
               std::vector<std::size_t>();
    }



    struct OddRows
    {
      const MeasuredTest &test;
      const TellRow      &warn;

      // What no laboratory measures is a unit, a scale or an offset that went
      // wrong. A few rows do not count: loads that open have any friction.
      void warn_of_scales() const
      {
        constexpr double largest_pressure =
          3e3; // MPa, as the hardest metals bear
        constexpr double smallest_pressure = 1e-5; // MPa, as of a sheet of foil
        constexpr double fastest           = 2e5;  // mm/s
        constexpr double slowest = 1e-8; // mm/s, a third of a mm a year
        constexpr double coldest = -100., hottest = 1500.; // degC

        const std::vector<double> friction = sizes_of_friction(test);
        const double              usual    = usual_size(friction);
        if (usual > largest_friction)
          warn("friction reaches " + rounded_text(usual, 3) +
                 " of the pressure: is it a force or a percentage, or is the "
                 "pressure wrong?",
               0);
        else
          warn_of_strays("friction",
                         friction,
                         std::max(largest_friction, 5. * usual));
        const double pressure = median(test.pressure);
        if (pressure > largest_pressure ||
            (pressure > 0. && pressure < smallest_pressure))
          warn("the pressure is " + rounded_text(pressure, 3) +
                 " MPa: is its unit right, and that of the area?",
               0);
        const double speed =
          path_of(test) / (test.time.back() - test.time.front());
        if (speed > fastest || (speed > 0. && speed < slowest))
          warn("it moves at " + rounded_text(speed, 3) +
                 " mm/s: are the units of displacement and time right?",
               0);
        const double temperature =
          test.temperature.empty() ? 0. : median(test.temperature);
        if (temperature < coldest || temperature > hottest)
          warn("the temperature is " + rounded_text(temperature, 3) +
                 " degC: is its unit right?",
               0);
      }

      void warn_of_rounded_clock() const
      {
        if (const double rounding = rounding_of_time(test.time); rounding > 0.)
          warn("time is rounded to " + rounded_text(rounding, 3) +
                 " s, which makes speeds differ from row to row: fits assume "
                 "equal time steps; record times with more digits",
               0);
      }

      // A step of time far longer than the others, within which it moves on as
      // from row to row: the machine stood, or the clock jumped. Read as it is,
      // it slides slowly there.
      void warn_of_pauses() const
      {
        constexpr std::size_t beside    = 5; // rows
        constexpr double      long_step = 20., slow = 0.05, moves = 0.2;

        std::vector<double> steps;
        for (std::size_t i = 1; i < test.time.size(); ++i)
          steps.push_back(test.time[i] - test.time[i - 1]);
        const double usual = median(steps);
        std::size_t  n = 0, first = 0;
        for (std::size_t i = beside + 1; i + beside < test.time.size(); ++i)
          {
            const double before = distance_between(test, i - 1 - beside, i - 1);
            const double after  = distance_between(test, i, i + beside);
            const double speed =
              std::min(before / (test.time[i - 1] - test.time[i - 1 - beside]),
                       after / (test.time[i + beside] - test.time[i]));
            const double moved = distance_between(test, i - 1, i);
            if (steps[i - 1] > long_step * usual &&
                moved < slow * speed * steps[i - 1] &&
                moved > moves * std::min(before, after) / beside && n++ == 0)
              first = i;
          }
        if (n > 0)
          warn(
            "time goes on by " + rounded_text(steps[first - 1], 3) +
              " s within one row while the displacement changes by " +
              rounded_text(distance_between(test, first - 1, first), 3) +
              " mm, which is read as slow sliding: if the clock jumped or the "
              "machine stood still, correct the times or add a row where it "
              "stopped. Such rows: " +
              std::to_string(n),
            first);
      }

      // From one row to the next against the motion of the rows on both sides,
      // by far more than these move, and a good part of the way: no machine
      // does that.
      void warn_of_jumps() const
      {
        constexpr std::size_t beside = 5; // rows
        constexpr double      far = 3., good_part = 0.05;

        const std::vector<double> &x = test.displacement;
        // An axis along which nothing moves has noise only.
        const double least =
          good_part * std::max(range_of(x), range_of(test.displacement_y));
        std::size_t n     = 0;
        std::size_t first = 0;
        for (std::size_t i = beside + 1; i + beside < x.size(); ++i)
          {
            const double jump   = x[i] - x[i - 1];
            const double before = x[i - 1] - x[i - 1 - beside];
            const double after  = x[i + beside] - x[i];
            if (before * after > 0. && jump * before < 0. &&
                std::abs(jump) > least &&
                std::abs(jump) >
                  far * std::max(std::abs(before), std::abs(after)) &&
                n++ == 0)
              first = i;
          }
        if (n > 0)
          warn(
            "the displacement jumps by " +
              rounded_text(x[first] - x[first - 1], 3) +
              " mm within one row, against the motion before and after: did a "
              "counter wrap, or are rows missing? Such rows: " +
              std::to_string(n),
            first);
      }

      void warn_of_sensors() const
      {
        for (const auto &[name, values] :
             {std::pair{"friction", &test.friction},
              std::pair{"friction_y", &test.friction_y},
              std::pair{"pressure", &test.pressure}})
          if (const auto found = repeated_value(under_load(*values, test)))
            warn(std::string(name) + " " + found->words, found->first);
      }

      void warn_of_no_load() const
      {
        const std::vector<std::size_t> rows = rows_without_load(test);
        if (rows.empty())
          return;
        warn("the pressure is " + rounded_text(test.pressure[rows[0]], 2) +
               " MPa there, compared with a usual " +
               rounded_text(median(test.pressure), 3) +
               " MPa, and friction there is unlike friction under load: noise "
               "over noise. Fits leave such rows out; there are " +
               std::to_string(rows.size()),
             rows[0]);
      }

      // Codes of errors, spikes and drop-outs. Friction may well go there and
      // back for a moment, after a rest or a change of speed, but not to zero,
      // to the other side, or to three times what it is.
      void warn_of_excursions() const
      {
        warn_of_excursions_of_friction();
        tell_excursions("the displacement goes to ",
                        " mm",
                        test.displacement,
                        excursions(test.displacement, 0.));
        tell_excursions("the second displacement goes to ",
                        " mm",
                        test.displacement_y,
                        excursions(test.displacement_y, 0.));
        // From full load, and to it.
        const double             load = 0.5 * median(test.pressure);
        std::vector<double>      decades;
        std::vector<std::size_t> rows;
        for (const double pressure : test.pressure)
          decades.push_back(std::log10(std::max(pressure, 1e-6 * load)));
        for (const std::size_t row :
             excursions(decades, std::log10(times_of_excursions)))
          if (test.pressure[row - 1] >= load ||
              (!rows.empty() && row == rows.back() + 1))
            rows.push_back(row);
        tell_excursions("the pressure goes to ", " MPa", test.pressure, rows);
      }

      void tell_excursions(const std::string              &words,
                           const std::string              &unit,
                           const std::vector<double>      &values,
                           const std::vector<std::size_t> &rows) const
      {
        if (!rows.empty())
          warn(words + rounded_text(values[rows[0]], 4) + unit +
                 " there and back at once: an error code, or a spike? Leave "
                 "out rows that measure nothing. Such rows: " +
                 std::to_string(rows.size()),
               rows[0]);
      }

      void warn_of_excursions_of_friction() const
      {
        constexpr double least_friction = 1e-3;

        // An axis along which nothing moves has noise only.
        const double usual = usual_size(sizes_of_friction(test));
        for (const auto &[name, friction, x] :
             {std::tuple{"friction", &test.friction, &test.displacement},
              std::tuple{"friction_y", &test.friction_y, &test.displacement_y}})
          {
            if (friction->empty())
              continue;
            // There or a row beside.
            const auto turns = [&x = *x](const std::size_t row) {
              for (std::size_t i = std::max<std::size_t>(row, 3) - 1;
                   i < std::min(row + 2, x.size());
                   ++i)
                if ((x[i] - x[i - 1]) * (x[i - 1] - x[i - 2]) < 0.)
                  return true;
              return false;
            };
            std::vector<std::size_t> rows;
            for (const std::size_t row :
                 excursions(under_load(*friction, test), 0.5 * usual))
              {
                const double value = (*friction)[row];
                const double size  = std::abs(value);
                // Beyond the largest friction it has been told already.
                if (size <= largest_friction &&
                    (size < least_friction * usual ||
                     size > times_of_excursions * usual ||
                     (value * (*friction)[row - 1] < 0. && !turns(row))))
                  rows.push_back(row);
              }
            tell_excursions(std::string(name) + " goes to ",
                            "",
                            *friction,
                            rows);
          }
      }

      // Rows far from all others, under load.
      void warn_of_strays(const std::string         &name,
                          const std::vector<double> &values,
                          const double               limit) const
      {
        const double load = 0.5 * median(test.pressure);
        std::size_t  n = 0, first = 0;
        for (std::size_t i = 0; i < values.size(); ++i)
          if (values[i] > limit && test.pressure[i] >= load && n++ == 0)
            first = i;
        if (n > 0)
          warn(name + " is " + rounded_text(values[first], 3) +
                 " there, far from the other rows: an error code, or a spike? "
                 "Leave out rows that measure nothing. Such rows: " +
                 std::to_string(n),
               first);
      }
    };
  } // namespace



  void warn_of_odd_rows(const MeasuredTest &test, const TellRow &warn)
  {
    const OddRows rows{test, warn};
    rows.warn_of_scales();
    rows.warn_of_sensors();
    rows.warn_of_no_load();
    rows.warn_of_excursions();
    rows.warn_of_rounded_clock();
    rows.warn_of_pauses();
    rows.warn_of_jumps();
  }
} // namespace SlipStep
