// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/sensor_zero.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/units.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// A step between rows that moves.
    struct MovingStep
    {
      double path;   ///< [mm]
      double time;   ///< in its middle [s]
      double signal; ///< in its middle
      double place;  ///< likewise [mm]
    };

    /// Those forth and those back.
    using StepsByWay = std::array<std::vector<MovingStep>, 2>;

    // What turns within a band trembles.
    constexpr double least_band = 0.005; // of the range

    StepsByWay moving_steps(const std::vector<double> &time,
                            const std::vector<double> &displacement,
                            const std::vector<double> &signal,
                            const double               multiple_of_noise = 0.)
    {
      std::vector<std::size_t> rows;
      std::vector<double>      positions;
      for (std::size_t i = 0; i < signal.size(); ++i)
        if (!std::isnan(time[i]) && !std::isnan(displacement[i]) &&
            !std::isnan(signal[i]))
          {
            rows.push_back(i);
            positions.push_back(displacement[i]);
          }
      const std::vector<double> smooth =
        without_jitter(positions,
                       std::max(least_band * range_of(positions),
                                multiple_of_noise > 0. ?
                                  multiple_of_noise * noise_level(positions) :
                                  0.));
      StepsByWay steps;
      for (std::size_t k = 1; k < rows.size(); ++k)
        if (smooth[k] != smooth[k - 1])
          steps[smooth[k] < smooth[k - 1]].push_back(
            {std::abs(smooth[k] - smooth[k - 1]),
             0.5 * (time[rows[k]] + time[rows[k - 1]]),
             0.5 * (signal[rows[k]] + signal[rows[k - 1]]),
             0.5 * (smooth[k] + smooth[k - 1])});
      return steps;
    }

    double path_of_steps(const std::vector<MovingStep> &steps)
    {
      double path = 0.;
      for (const MovingStep &step : steps)
        path += step.path;
      return path;
    }

    double mean_over_path(const std::vector<MovingStep> &steps,
                          double MovingStep::*value)
    {
      double sum = 0.;
      for (const MovingStep &step : steps)
        sum += step.path * (step.*value);
      return sum / path_of_steps(steps);
    }

    bool goes_both_ways(const StepsByWay &steps)
    {
      constexpr double least_share = 0.2;

      const double forth = path_of_steps(steps[0]),
                   back  = path_of_steps(steps[1]);
      return std::min(forth, back) > least_share * std::max(forth, back);
    }

    // By the path, not by time.
    double correlation(const std::vector<MovingStep> &steps,
                       double MovingStep::*a,
                       double MovingStep::*b)
    {
      const double mean_a = mean_over_path(steps, a),
                   mean_b = mean_over_path(steps, b);
      double aa = 0., ab = 0., bb = 0.;
      for (const MovingStep &step : steps)
        {
          aa += step.path * std::pow(step.*a - mean_a, 2);
          bb += step.path * std::pow(step.*b - mean_b, 2);
          ab += step.path * (step.*a - mean_a) * (step.*b - mean_b);
        }
      return ab / std::sqrt(std::max(aa * bb, 1e-300));
    }

    double mean_of_strokes(const std::vector<double> &time,
                           const std::vector<double> &displacement,
                           const std::vector<double> &signal)
    {
      const StepsByWay steps = moving_steps(time, displacement, signal);
      const double     forth = path_of_steps(steps[0]),
                   back      = path_of_steps(steps[1]);
      if (!goes_both_ways(steps))
        throw InputError("it needs strokes in both directions, but the record "
                         "moves " +
                         rounded_text(forth, 3) + " mm forth and " +
                         rounded_text(back, 3) + " mm back");
      return 0.5 * (mean_over_path(steps[0], &MovingStep::signal) +
                    mean_over_path(steps[1], &MovingStep::signal));
    }

    const std::string of_first = "mean of the first ";

    double duration_of(const std::string &zero)
    {
      const double duration =
        parse_quantity(zero.substr(of_first.size()), Dimension::time, true);
      if (!(duration >= 0.))
        throw InputError("a time of 0 s or more is needed");
      return duration;
    }

    double least_of(const std::vector<double> &time)
    {
      double first = std::nan("");
      for (const double t : time)
        if (!std::isnan(t))
          first = std::fmin(first, t);
      return first;
    }

    double mean_of_first(const double               duration,
                         const std::vector<double> &time,
                         const std::vector<double> &signal)
    {
      const double first = least_of(time);
      double       sum   = 0.;
      std::size_t  n     = 0;
      for (std::size_t i = 0; i < signal.size(); ++i)
        if (time[i] <= first + duration && !std::isnan(signal[i]))
          {
            sum += signal[i];
            ++n;
          }
      if (n == 0)
        throw InputError("no row of the first " + rounded_text(duration, 4) +
                         " s has a value");
      return sum / n;
    }
  } // namespace



  double take_off_zero(const std::string         &zero,
                       const std::vector<double> &time,
                       const std::vector<double> &displacement,
                       std::vector<double>       &signal)
  {
    double value = 0.;
    if (zero == "mean of strokes")
      value = mean_of_strokes(time, displacement, signal);
    else if (zero.rfind(of_first, 0) == 0)
      value = mean_of_first(duration_of(zero), time, signal);
    else if (zero != "none")
      throw InputError("allowed: none, mean of strokes, mean of the first 2 s");
    for (double &row : signal)
      row -= value;
    return value;
  }



  bool moves_in_first(const std::string         &zero,
                      const std::vector<double> &time,
                      const std::vector<double> &displacement)
  {
    const double        last = least_of(time) + duration_of(zero);
    std::vector<double> all, first;
    for (std::size_t i = 0; i < time.size(); ++i)
      if (!std::isnan(time[i]) && !std::isnan(displacement[i]))
        {
          all.push_back(displacement[i]);
          if (time[i] <= last)
            first.push_back(displacement[i]);
        }
    return range_of(first) >
           2. * std::max(least_band * range_of(all), 3. * noise_level(all));
  }



  double take_off_drift(const std::string         &drift,
                        const std::vector<double> &time,
                        const std::vector<double> &displacement,
                        std::vector<double>       &signal)
  {
    if (drift == "none")
      return 0.;
    if (drift != "linear")
      throw InputError("allowed: none, linear");

    // With a mean of its own each way counts about its mean only.
    double product = 0., square = 0.;
    for (const auto &steps : moving_steps(time, displacement, signal))
      if (!steps.empty())
        {
          const double mean_time = mean_over_path(steps, &MovingStep::time);
          for (const MovingStep &step : steps)
            {
              product += step.path * (step.time - mean_time) * step.signal;
              square += step.path * std::pow(step.time - mean_time, 2);
            }
        }
    if (!(square > 0.))
      throw InputError("the record has no motion, so a drift of the sensor "
                       "cannot be told from friction");
    const double slope = product / square;

    std::vector<double> known;
    for (const double t : time)
      if (!std::isnan(t))
        known.push_back(t);
    const auto [first, last] = std::minmax_element(known.begin(), known.end());
    const double middle      = 0.5 * (*first + *last);
    for (std::size_t i = 0; i < signal.size(); ++i)
      signal[i] -= slope * (time[i] - middle);
    return slope;
  }



  std::optional<OneSign>
  friction_of_one_sign(const std::vector<double> &time,
                       const std::vector<double> &displacement,
                       const std::vector<double> &friction)
  {
    constexpr double steady = 0.3, most_of_it = 0.6, elastic = 0.5;
    constexpr double multiple_of_noise = 6.;

    // A counter that wraps jumps back.
    constexpr std::size_t jumps = 10;

    const StepsByWay steps =
      moving_steps(time, displacement, friction, multiple_of_noise);
    if (!goes_both_ways(steps) || jumps * steps[1].size() < steps[0].size() ||
        jumps * steps[0].size() < steps[1].size())
      return {};
    const std::array<double, 2> means = {
      {mean_over_path(steps[0], &MovingStep::signal),
       mean_over_path(steps[1], &MovingStep::signal)}};
    if (!(means[0] * means[1] > 0.))
      return {};
    double scatter = 0.;
    for (const unsigned int way : {0, 1})
      {
        const double whole = path_of_steps(steps[way]);
        double       path = 0., square = 0.;
        for (const MovingStep &step : steps[way])
          {
            const double off = step.signal - means[way];
            square += step.path * off * off / whole;
            if (std::abs(off) <= steady * std::abs(means[way]))
              path += step.path;
          }
        if (path < most_of_it * whole ||
            std::abs(correlation(steps[way],
                                 &MovingStep::signal,
                                 &MovingStep::place)) > elastic)
          return {};
        scatter = std::max(scatter, std::sqrt(square));
      }
    return OneSign{means[0], means[1], scatter};
  }



  void give_sign_of_motion(const std::vector<double> &time,
                           const std::vector<double> &displacement,
                           std::vector<double>       &friction)
  {
    const auto is_known = [](const double value) { return !std::isnan(value); };
    const auto first    = std::find_if(time.begin(), time.end(), is_known);
    const auto last     = std::find_if(time.rbegin(), time.rend(), is_known);
    const bool is_newest_first =
      first != time.end() && last != time.rend() && *first > *last;
    const auto turn_round = [&](std::vector<double> &values) {
      if (is_newest_first)
        std::reverse(values.begin(), values.end());
    };
    std::vector<double> positions = displacement;
    turn_round(positions);
    turn_round(friction);
    // Gaps stay where the row before them is.
    const auto known =
      std::find_if(positions.begin(), positions.end(), is_known);
    double before = known == positions.end() ? 0. : *known;
    for (double &position : positions)
      position = before = is_known(position) ? position : before;
    const std::vector<double> smooth =
      without_jitter(positions, least_band * range_of(positions));
    const auto way_of = [&](const std::size_t i) {
      return i > 0 && smooth[i] != smooth[i - 1] ?
               std::copysign(1., smooth[i] - smooth[i - 1]) :
               0.;
    };
    double way = 0.;
    for (std::size_t i = 0; i < smooth.size() && way == 0.; ++i)
      way = way_of(i);
    if (way == 0.)
      throw InputError("the record does not move, so that its friction gets no "
                       "sign of a motion");
    for (std::size_t i = 0; i < friction.size(); ++i)
      {
        way         = way_of(i) != 0. ? way_of(i) : way;
        friction[i] = way * std::abs(friction[i]);
      }
    turn_round(friction);
  }
} // namespace SlipStep
