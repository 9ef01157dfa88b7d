// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/row_noise.h>

#include <slipstep/measured_data/test_rows.h>

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace SlipStep
{
  double RowNoise::variance_of_mean(const double n) const
  {
    const double power = std::pow(decay, n);
    // n + 2 sum_k (n - k) decay^k
    const double together =
      (n * (1. - decay * decay) - 2. * decay * (1. - power)) /
      std::pow(1. - decay, 2);
    return deviation * deviation *
           ((1. - share) / n + share * together / (n * n));
  }



  double RowNoise::covariance_of_means(const double n) const
  {
    return deviation * deviation * share * decay *
           std::pow((1. - std::pow(decay, n)) / (1. - decay) / n, 2);
  }



  std::vector<bool> spikes(const std::vector<double> &values)
  {
    // As many on either side: of up to so many in a row the others tell.
    constexpr std::size_t reach = 3;
    constexpr double      far   = 10.; // standard deviations

    std::vector<bool> result(values.size(), false);
    if (values.size() <= 2 * reach)
      return result;
    std::vector<double> distance(values.size(), 0.);
    for (std::size_t i = reach; i + reach < values.size(); ++i)
      distance[i] =
        std::abs(values[i] - median({values.begin() + i - reach,
                                     values.begin() + i + reach + 1}));
    // Of a step in its digits a record does not scatter.
    const double usual = median(distance) / 0.6745;
    for (std::size_t i = 0; i < values.size(); ++i)
      result[i] = usual > 0. && distance[i] > far * usual;
    return result;
  }



  void bridge(const std::vector<bool> &is_spike, std::vector<double> &values)
  {
    for (std::size_t begin = 0; begin < values.size(); ++begin)
      {
        std::size_t end = begin;
        while (end < values.size() && is_spike[end])
          ++end;
        if (end == begin || begin == 0 || end == values.size())
          continue;
        const double before = values[begin - 1], after = values[end];
        for (std::size_t i = begin; i < end; ++i)
          values[i] =
            before + (after - before) * (i - begin + 1.) / (end - begin + 1.);
      }
  }



  namespace
  {
    constexpr std::size_t longest_scale = 8; // bins

    // Of second differences of means, over 6.
    double expected_scatter(const RowNoise &noise, const double n_rows)
    {
      const double next = noise.covariance_of_means(n_rows);
      return noise.variance_of_mean(n_rows) +
             next * (std::pow(noise.decay, n_rows) - 4.) / 3.;
    }



    // Second differences of means of so many bins.
    std::vector<double> second_differences(const std::vector<double> &values,
                                           const std::size_t          scale)
    {
      std::vector<double> sums = {0.}, result;
      for (const double value : values)
        sums.push_back(sums.back() + value);
      for (std::size_t i = 0; i + 3 * scale < sums.size(); ++i)
        result.push_back((sums[i + 3 * scale] - 3. * sums[i + 2 * scale] +
                          3. * sums[i + scale] - sums[i]) /
                         scale);
      return result;
    }



    // Of those of a drift of variance 1, over 6: the median over the record,
    // whose times may be uneven.
    double scatter_of_drift(const std::vector<double> &time,
                            const std::size_t          scale,
                            const double               drift_time)
    {
      constexpr std::size_t n_places = 15;

      const std::size_t   width  = 3 * scale;
      const std::size_t   room   = time.size() - width;
      const std::size_t   stride = 1 + room / n_places;
      std::vector<double> variances;
      const auto          weight = [&](const std::size_t i) {
        return (i / scale == 1 ? -2. : 1.) / scale;
      };
      for (std::size_t begin = 0; begin <= room; begin += stride)
        {
          double sum = 0.;
          for (std::size_t i = 0; i < width; ++i)
            for (std::size_t j = 0; j < width; ++j)
              sum += weight(i) * weight(j) *
                     std::exp(-std::abs(time[begin + i] - time[begin + j]) /
                              drift_time);
          variances.push_back(sum / 6.);
        }
      return median(std::move(variances));
    }
  } // namespace



  RowNoiseFit::RowNoiseFit(const double drift, const double drift_time)
    : believed_drift(drift)
    , drift_times{0.5 * drift_time, drift_time, 2. * drift_time}
  {}



  void RowNoiseFit::add(const std::vector<double> &recorded,
                        const std::vector<double> &time,
                        const double               rows_per_bin,
                        const double               row_deviation,
                        const double               level)
  {
    // A median tells as much as 0.37 times as many squares, and a second
    // difference shares most of what its neighbours see.
    constexpr double      per_row = 0.37 / 1.5;
    constexpr std::size_t least   = 12; // means

    std::vector<double> values = recorded;
    bridge(spikes(values), values);
    Record record;
    record.level = level;
    if (rows_per_bin > 1.)
      record.scatter.push_back({1.,
                                row_deviation * row_deviation,
                                per_row * rows_per_bin * values.size(),
                                {0., 0., 0.}});
    for (std::size_t scale = 1;
         scale <= longest_scale && values.size() >= least * scale;
         scale *= 2)
      {
        std::vector<double> sizes = second_differences(values, scale);
        for (double &size : sizes)
          size = std::abs(size);
        ScaleScatter scatter;
        scatter.n_rows   = scale * rows_per_bin;
        scatter.variance = std::pow(median(std::move(sizes)) / 0.6745, 2) / 6.;
        scatter.freedom  = per_row * values.size() / scale;
        for (const double drift_time : drift_times)
          scatter.drift.push_back(scatter_of_drift(time, scale, drift_time));
        // Less is no noise that could be seen.
        scatter.variance =
          std::max(scatter.variance, 1e-4 * row_deviation * row_deviation);
        record.scatter.push_back(scatter);
      }
    records.push_back(record);
  }



  double RowNoiseFit::misfit(const Record &record,
                             const Shape  &shape,
                             double       *deviation) const
  {
    if (record.scatter.empty() || !(record.scatter[0].variance > 0.))
      return 0.;
    std::vector<double> units, drifts;
    for (const ScaleScatter &one : record.scatter)
      {
        units.push_back(
          expected_scatter({1., shape.share, shape.decay}, one.n_rows));
        drifts.push_back(std::pow(shape.drift * record.level, 2) *
                         one.drift[shape.drift_time]);
      }
    // The logarithm of a mean of n squares has the variance 2 / n.
    const auto at = [&](const double log_deviation) {
      const double variance = std::exp(2. * log_deviation);
      double       sum      = 0.;
      for (std::size_t i = 0; i < units.size(); ++i)
        sum += record.scatter[i].freedom / 2. *
               std::pow(std::log((variance * units[i] + drifts[i]) /
                                 record.scatter[i].variance),
                        2);
      return sum;
    };
    const double middle = std::log(record.scatter[0].variance / units[0]) / 2.;
    const auto   best =
      boost::math::tools::brent_find_minima(at, middle - 3., middle + 3., 12);
    if (deviation != nullptr)
      *deviation = std::exp(best.first);
    return best.second;
  }



  double RowNoiseFit::misfit(const Shape &shape) const
  {
    constexpr double believed = 0.6; // of the logarithm of the drift

    double sum = std::pow(std::log(shape.drift / believed_drift) / believed, 2);
    for (const Record &record : records)
      sum += misfit(record, shape);
    return sum;
  }



  namespace
  {
    // Those that hang together.
    std::vector<std::pair<double, double>> shares_and_decays()
    {
      std::vector<std::pair<double, double>> result;
      for (const double share : {0.25, 0.5, 0.75, 1.})
        for (const double decay : {0.3, 0.5, 0.65, 0.8, 0.9, 0.95})
          result.emplace_back(share, decay);
      return result;
    }
  } // namespace



  RowNoiseFit::Result RowNoiseFit::solve() const
  {
    // Three standard deviations and more, for two numbers.
    constexpr double clearly = 12.;

    const auto best_of =
      [&](const std::vector<std::pair<double, double>> &shapes) {
        std::pair<double, Shape> best{std::numeric_limits<double>::infinity(),
                                      Shape()};
        for (const auto &[share, decay] : shapes)
          for (const double factor : {0.25, 0.5, 1., 2., 4.})
            for (std::size_t t = 0; t < drift_times.size(); ++t)
              {
                const Shape  shape{share, decay, factor * believed_drift, t};
                const double value = misfit(shape);
                if (value < best.first)
                  best = {value, shape};
              }
        return best;
      };
    const auto  white    = best_of({{0., 0.}});
    const auto  together = best_of(shares_and_decays());
    const bool  is_clear = together.first < white.first - clearly;
    const Shape common   = is_clear ? together.second : white.second;
    Result      result;
    result.is_correlated = is_clear;
    for (const Record &record : records)
      {
        Shape  own   = common;
        double least = misfit(record, common) - clearly;
        for (const auto &[share, decay] : shares_and_decays())
          {
            Shape other        = common;
            other.share        = share;
            other.decay        = decay;
            const double value = misfit(record, other);
            if (value < least)
              {
                least = value;
                own   = other;
              }
          }
        RowNoise noise{0., own.share, own.decay};
        misfit(record, own, &noise.deviation);
        result.is_correlated = result.is_correlated || own.share > 0.;
        result.records.push_back(noise);
        if (!record.scatter.empty())
          result.freedom += record.scatter.back().freedom;
      }
    return result;
  }
} // namespace SlipStep
