// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/odd_rows.h>
#include <slipstep/measured_data/test_rows.h>

#include <slipstep/utilities/lists.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace SlipStep
{
  std::vector<const Channel *> filled_channels(const MeasuredTest &test)
  {
    std::vector<const Channel *> filled;
    for (const Channel &channel : channels())
      if (!(test.*channel.values).empty())
        filled.push_back(&channel);
    return filled;
  }



  std::string name_in_messages(const MeasuredTest &test)
  {
    return test.file.empty() ? test.name : test.file.string();
  }



  void keep_rows(MeasuredTest &test, const std::vector<std::size_t> &rows)
  {
    for (const Channel *channel : filled_channels(test))
      {
        auto &values = test.*(channel->values);
        values       = chosen(values, rows);
      }
  }



  dealii::Tensor<1, 2> position(const MeasuredTest &test, const std::size_t row)
  {
    dealii::Tensor<1, 2> result;
    result[0] = test.displacement[row];
    if (!test.displacement_y.empty())
      result[1] = test.displacement_y[row];
    return result;
  }



  double distance_between(const MeasuredTest &test,
                          const std::size_t   from,
                          const std::size_t   to)
  {
    return (position(test, to) - position(test, from)).norm();
  }



  std::vector<double> without_jitter(const std::vector<double> &displacement,
                                     const double               band)
  {
    std::vector<double> smooth(displacement);
    for (std::size_t i = 1; i < smooth.size(); ++i)
      smooth[i] = std::clamp(smooth[i - 1],
                             displacement[i] - band,
                             displacement[i] + band);
    return smooth;
  }



  std::vector<std::size_t> turning_rows(const std::vector<double> &displacement,
                                        const double               band)
  {
    const std::vector<double> smooth = without_jitter(displacement, band);
    std::vector<std::size_t>  rows;
    std::size_t               farthest  = 0;
    double                    direction = 0.;
    for (std::size_t i = 1; i < smooth.size(); ++i)
      {
        const double step = smooth[i] - smooth[i - 1];
        if (step != 0. && direction == 0.)
          direction = std::copysign(1., step);
        if (step * direction < 0.)
          {
            rows.push_back(farthest);
            farthest  = i;
            direction = -direction;
          }
        if (direction * (displacement[i] - displacement[farthest]) > 0.)
          farthest = i;
      }
    return rows;
  }



  double range_of(const std::vector<double> &values)
  {
    if (values.empty())
      return 0.;
    const auto [least, most] =
      std::minmax_element(values.begin(), values.end());
    return *most - *least;
  }



  std::vector<double> at_times(const std::vector<double> &times,
                               const std::vector<double> &values,
                               const std::vector<double> &wanted_times)
  {
    std::vector<double> result;
    result.reserve(wanted_times.size());
    std::size_t i = 0;
    for (const double time : wanted_times)
      {
        while (i + 1 < times.size() && times[i] < time)
          ++i;
        const std::size_t before = i == 0 ? 0 : i - 1;
        const double      length = times[i] - times[before];
        const double      share =
          length > 0. ? std::clamp((time - times[before]) / length, 0., 1.) :
                             1.;
        result.push_back((1. - share) * values[before] + share * values[i]);
      }
    return result;
  }



  double median(std::vector<double> values)
  {
    if (values.empty())
      return 0.;
    const auto middle = values.begin() + values.size() / 2;
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }



  namespace
  {
    /// The steps of values that are mostly constant.
    struct Steps
    {
      explicit Steps(const std::vector<double> &values)
      {
        constexpr std::size_t just = 3; // rows

        const auto step = [&](const std::size_t i) {
          return i > 0 && i < values.size() ? values[i] - values[i - 1] : 0.;
        };
        for (std::size_t i = 1; i < values.size(); ++i)
          {
            largest = std::max(largest, std::abs(values[i]));
            if (step(i) == 0.)
              continue;
            n_back += !rows.empty() && i - rows.back() <= just &&
                      sizes.back() * step(i) < 0.;
            rows.push_back(i);
            sizes.push_back(step(i));
            if (step(i - 1) * step(i) <= 0. && step(i) * step(i + 1) <= 0.)
              alone.push_back(std::abs(step(i)));
          }
      }

      std::vector<std::size_t> rows;  ///< of all that are not 0
      std::vector<double>      sizes; ///< with their signs
      std::vector<double>      alone; ///< without sign: no neighbour goes on
      std::size_t              n_back  = 0;  ///< that take back one just made
      double                   largest = 0.; ///< of the values, without sign
    };



    // Of equal steps in one direction, one after the other about as long.
    std::size_t
    longest_stairs(const Steps &steps, const double size, const double unlike)
    {
      constexpr double about = 4.;

      const auto rest = [&](const std::size_t i) {
        return static_cast<double>(steps.rows[i] - steps.rows[i - 1]);
      };
      std::size_t longest = 0, n = 0;
      for (std::size_t i = 0; i < steps.sizes.size(); ++i)
        {
          const bool is_equal =
            std::abs(std::abs(steps.sizes[i]) - size) <= unlike * size;
          const bool goes_on =
            n == 0 || (steps.sizes[i] * steps.sizes[i - 1] > 0. &&
                       (n == 1 || (rest(i) <= about * rest(i - 1) &&
                                   rest(i - 1) <= about * rest(i))));
          n       = !is_equal ? 0 : goes_on ? n + 1 : 1;
          longest = std::max(longest, n);
        }
      return longest;
    }



    // How far values that are mostly constant have been rounded; 0 if they are
    // constant, or ramps and jumps between constants. Rounding makes steps that
    // stand alone: small ones, or of one size and its multiples that are just
    // taken back or make long stairs. A ramp that is passed in one row, or in a
    // few of a slow controller, has wide ones.
    double rounding(const std::vector<double> &values)
    {
      constexpr double largest_share = 0.1; // of the largest value
      constexpr double small_share   = 0.01;
      // Digits of another unit have been rounded once more.
      constexpr double      unlike      = 0.35;
      constexpr std::size_t many_stairs = 20;

      const std::size_t least_number = 4 + values.size() / 50;
      const Steps       steps(values);
      const std::size_t n = steps.sizes.size();
      if (steps.alone.size() < least_number || 2 * steps.alone.size() < n)
        return 0.;
      const double size       = median(steps.alone);
      const auto   is_regular = [&](const double step) {
        const double ratio = std::abs(step) / size;
        return std::abs(ratio - std::max(1., std::round(ratio))) <= unlike;
      };
      const std::size_t n_regular = count_if(steps.sizes, is_regular);
      const bool        has_digits =
        10 * n_regular >= 9 * n &&
        (2 * steps.n_back >= least_number ||
         longest_stairs(steps, size, unlike) >= many_stairs);
      return size <= small_share * steps.largest ||
                 (has_digits && size <= largest_share * steps.largest) ?
               size :
               0.;
    }



    // A sensor that is dead has no noise.
    std::vector<double> without_dead_rows(std::vector<double> values,
                                          const MeasuredTest &test)
    {
      const auto found = repeated_value(under_load(values, test));
      if (found.has_value() && found->n_in_a_row > 0)
        values.erase(values.begin() + found->first,
                     values.begin() + found->first + found->n_in_a_row);
      return values;
    }
  } // namespace



  std::vector<double> bends_of(const std::vector<double> &values)
  {
    std::vector<double> bends;
    for (std::size_t i = 1; i + 1 < values.size(); ++i)
      bends.push_back(values[i - 1] - 2. * values[i] + values[i + 1]);
    return bends;
  }



  double noise_level(const std::vector<double> &values)
  {
    // Second differences leave what a signal bends within three rows, fourth
    // ones hardly any of it: where they say far less, it is signal.
    constexpr double far_less = 0.5;

    std::vector<double> bends = bends_of(values), fourth = bends_of(bends);
    for (std::vector<double> *const differences : {&bends, &fourth})
      for (double &difference : *differences)
        difference = std::abs(difference);

    // For normal deviates the median of the absolute value is 0.6745 sigma; the
    // second difference has the variance 6 sigma^2, the fourth 70 sigma^2.
    const double from_bends = median(std::move(bends)) / 0.6745 / std::sqrt(6.);
    const double from_fourth =
      median(std::move(fourth)) / 0.6745 / std::sqrt(70.);
    // Rounded to steps, values are uniformly distributed within one.
    return from_bends > 0. ?
             (from_fourth < far_less * from_bends ? from_fourth : from_bends) :
             rounding(values) / std::sqrt(12.);
  }



  namespace
  {
    // The values that a series takes, and whether it stays at each of them or
    // turns back there instead of only passing by.
    std::map<double, bool> levels_of(const std::vector<double> &values)
    {
      std::vector<std::size_t> order(values.size());
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(),
                order.end(),
                [&](const std::size_t a, const std::size_t b) {
                  return values[a] < values[b];
                });
      const double size      = values.empty() ?
                                 0. :
                                 std::max(std::abs(values[order.front()]),
                                     std::abs(values[order.back()]));
      const auto   are_equal = [&](const double a, const double b) {
        return std::abs(b - a) <= 1e-9 * size;
      };
      std::map<double, bool> result;
      for (const std::size_t i : order)
        {
          if (result.empty() || !are_equal(result.rbegin()->first, values[i]))
            result[values[i]] = false;
          if (i > 0 && i + 1 < values.size() &&
              (are_equal(values[i], values[i - 1]) ||
               (values[i] - values[i - 1]) * (values[i + 1] - values[i]) < 0.))
            result.rbegin()->second = true;
        }
      return result;
    }
  } // namespace



  double coarse_step(const std::vector<double> &values)
  {
    constexpr double      digits = 0.01, least_repeats = 3.;
    constexpr std::size_t least_levels = 4;

    const std::map<double, bool> levels = levels_of(values);
    if (levels.size() < least_levels ||
        least_repeats * levels.size() > values.size())
      return 0.;
    double step = std::numeric_limits<double>::infinity();
    for (auto i = levels.begin(), next = std::next(i); next != levels.end();
         i = next++)
      step = std::min(step, next->first - i->first);
    // Scatter visits neighbouring steps and stays there; a few constants are no
    // scatter, nor are the rows of a ramp between them.
    std::size_t n_next = 0, n_visited = 0;
    for (auto i = levels.begin(), next = std::next(i); next != levels.end();
         i = next++)
      {
        const double n_steps = (next->first - i->first) / step;
        if (std::abs(n_steps - std::round(n_steps)) > digits * n_steps)
          return 0.;
        n_next += n_steps < 1.5;
        n_visited += n_steps < 1.5 && i->second && next->second;
      }
    return 2 * n_next >= levels.size() - 1 && n_visited > 0 ? step : 0.;
  }



  std::vector<double> sizes_of_friction(const MeasuredTest &test)
  {
    std::vector<double> sizes;
    for (std::size_t i = 0; i < test.friction.size(); ++i)
      sizes.push_back(
        std::hypot(test.friction[i],
                   test.friction_y.empty() ? 0. : test.friction_y[i]));
    return sizes;
  }



  double Rounding::deviation() const
  {
    return kept * step / std::sqrt(12.);
  }



  Rounding rounding_to(const double step, const std::vector<double> &values)
  {
    constexpr double farthest = 4., least = 0.01;

    // Of what scatters by s, rounding makes s^2 + step^2 / 12.
    double squares = 0., n = 0.;
    for (const double bend : bends_of(values))
      {
        if (std::abs(bend) > farthest * step)
          continue;
        squares += bend * bend / 6.;
        n += 1.;
      }
    const double variance =
      std::max(0., squares / std::max(n, 1.) - step * step / 12.);
    const double kept = std::exp(-2. * std::pow(dealii::numbers::PI, 2) *
                                 variance / (step * step));
    return kept > least ? Rounding{step, kept} : Rounding{};
  }



  double noise_of_friction(const std::vector<double> &friction,
                           const MeasuredTest        &test)
  {
    return std::max(noise_level(without_dead_rows(friction, test)),
                    coarse_step(friction) / std::sqrt(12.));
  }



  double noise_of_friction(const MeasuredTest &test)
  {
    const double along_x = noise_of_friction(test.friction, test);
    return test.friction_y.empty() ?
             along_x :
             std::max(along_x, noise_of_friction(test.friction_y, test));
  }



  double jitter_of(const MeasuredTest &test)
  {
    return 0.005 *
           std::max(range_of(test.displacement), range_of(test.displacement_y));
  }



  double path_of(const MeasuredTest &test)
  {
    const std::vector<double> &x = test.displacement, &y = test.displacement_y;
    const double               band = jitter_of(test);
    std::set<std::size_t>      fixed;
    for (const auto *displacement : {&x, &y})
      for (const std::size_t row : turning_rows(*displacement, band))
        fixed.insert(row);
    fixed.insert(x.size() - 1);

    double      path = 0.;
    std::size_t last = 0;
    for (std::size_t i = 1; i < x.size(); ++i)
      {
        const double distance = distance_between(test, last, i);
        if (distance <= 2. * band && fixed.count(i) == 0)
          continue;
        path += distance;
        last = i;
      }
    return path;
  }
} // namespace SlipStep
