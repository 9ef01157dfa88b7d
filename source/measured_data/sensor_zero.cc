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
    };

    /// Those forth and those back.
    using StepsByWay = std::array<std::vector<MovingStep>, 2>;

    StepsByWay moving_steps(const std::vector<double> &time,
                            const std::vector<double> &displacement,
                            const std::vector<double> &signal)
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
        without_jitter(positions, 0.005 * range_of(positions));
      StepsByWay steps;
      for (std::size_t k = 1; k < rows.size(); ++k)
        if (smooth[k] != smooth[k - 1])
          steps[smooth[k] < smooth[k - 1]].push_back(
            {std::abs(smooth[k] - smooth[k - 1]),
             0.5 * (time[rows[k]] + time[rows[k - 1]]),
             0.5 * (signal[rows[k]] + signal[rows[k - 1]])});
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

    double mean_of_strokes(const std::vector<double> &time,
                           const std::vector<double> &displacement,
                           const std::vector<double> &signal)
    {
      constexpr double least_share = 0.2;
      const StepsByWay steps       = moving_steps(time, displacement, signal);
      const double     forth       = path_of_steps(steps[0]),
                   back            = path_of_steps(steps[1]);
      if (std::min(forth, back) <= least_share * std::max(forth, back))
        throw InputError("it takes strokes both ways, and the record moves " +
                         rounded_text(forth, 3) + " mm forth and " +
                         rounded_text(back, 3) + " mm back");
      return 0.5 * (mean_over_path(steps[0], &MovingStep::signal) +
                    mean_over_path(steps[1], &MovingStep::signal));
    }

    double mean_of_first(const double               duration,
                         const std::vector<double> &time,
                         const std::vector<double> &signal)
    {
      double first = std::nan("");
      for (const double t : time)
        if (!std::isnan(t))
          first = std::fmin(first, t);
      double      sum = 0.;
      std::size_t n   = 0;
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
    const std::string of_first = "mean of the first ";
    double            value    = 0.;
    if (zero == "mean of strokes")
      value = mean_of_strokes(time, displacement, signal);
    else if (zero.rfind(of_first, 0) == 0)
      {
        const double duration =
          parse_quantity(zero.substr(of_first.size()), Dimension::time, true);
        if (!(duration >= 0.))
          throw InputError("a time of 0 s or more is needed");
        value = mean_of_first(duration, time, signal);
      }
    else if (zero != "none")
      throw InputError("allowed: none, mean of strokes, mean of the first 2 s");
    for (double &row : signal)
      row -= value;
    return value;
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
      throw InputError("the record does not move, so a drift of the sensor is "
                       "not to be told from friction");
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
} // namespace SlipStep
