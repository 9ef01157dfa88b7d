// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/synthetic_tests/hidden_effects.h>
#include <slipstep/synthetic_tests/record_noise.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/nearest_name.h>

#include <boost/algorithm/string/join.hpp>

#include <cmath>
#include <utility>

namespace SlipStep
{
  namespace Planting
  {
    namespace
    {
      const std::vector<std::pair<NoiseKind, std::string>> kind_names = {
        {NoiseKind::normal, "normal"},
        {NoiseKind::heavy_tails, "heavy_tails"},
        {NoiseKind::two_drifts, "two_drifts"},
        {NoiseKind::correlated_rows, "correlated_rows"},
        {NoiseKind::drift_in_seconds, "drift_in_seconds"},
        {NoiseKind::rounded_motion, "rounded_motion"}};
    } // namespace



    std::string to_string(const NoiseKind kind)
    {
      for (const auto &[one, name] : kind_names)
        if (one == kind)
          return name;
      return "";
    }



    std::vector<std::string> noise_names()
    {
      std::vector<std::string> names;
      for (const auto &one : kind_names)
        names.push_back(one.second);
      return names;
    }



    NoiseKind noise_kind(const std::string &wanted)
    {
      for (const auto &[kind, name] : kind_names)
        if (name == wanted)
          return kind;
      const std::vector<std::string> names = noise_names();
      throw InputError("noise \"" + wanted + "\": allowed is one of: " +
                       boost::algorithm::join(names, ", ") +
                       did_you_mean(wanted, names));
    }



    NoiseLevels
    draw_levels(const NoiseKind kind, const double factor, Random &random)
    {
      NoiseLevels levels;
      levels.kind = kind;
      for (double *level :
           {&levels.white, &levels.drift, &levels.gain, &levels.offset})
        *level *= factor;
      if (kind == NoiseKind::two_drifts)
        levels.correlation_times = {uniform(random, 0.02, 0.06),
                                    uniform(random, 0.2, 0.5)};
      else if (kind == NoiseKind::drift_in_seconds)
        levels.correlation_times = {10.};
      else
        levels.correlation_times = {uniform(random, 0.05, 0.3)};
      return levels;
    }



    RecordNoise draw_record_noise(const NoiseLevels &levels,
                                  const double       static_coefficient,
                                  Random            &random)
    {
      std::normal_distribution<double> normal;
      RecordNoise                      noise;
      noise.gain     = levels.gain * normal(random);
      noise.offset_x = levels.offset * static_coefficient * normal(random);
      noise.offset_y = levels.offset * static_coefficient * normal(random);
      return noise;
    }



    std::vector<double>
    row_noise(const std::size_t n, const NoiseKind kind, Random &random)
    {
      constexpr double kept = 0.8;

      std::normal_distribution<double>    normal;
      std::student_t_distribution<double> student(3.);
      std::vector<double>                 values(n);
      // Student's t has the variance 3.
      for (double &value : values)
        value = kind == NoiseKind::heavy_tails ?
                  student(random) / std::sqrt(3.) :
                  normal(random);
      if (kind == NoiseKind::correlated_rows)
        for (std::size_t i = 1; i < n; ++i)
          values[i] =
            kept * values[i - 1] + std::sqrt(1. - kept * kept) * values[i];
      return values;
    }



    std::vector<double> drift_noise(const std::vector<double> &times,
                                    const double               correlation_time,
                                    Random                    &random)
    {
      std::normal_distribution<double> normal;
      std::vector<double>              values(times.size());
      for (std::size_t i = 0; i < times.size(); ++i)
        {
          const double kept =
            i == 0 ? 0. :
                     std::exp(-(times[i] - times[i - 1]) / correlation_time);
          values[i] = (i == 0 ? 0. : kept * values[i - 1]) +
                      std::sqrt(1. - kept * kept) * normal(random);
        }
      return values;
    }



    std::vector<double> noisy_record(const std::vector<double> &times,
                                     const std::vector<double> &friction,
                                     const double               mean,
                                     const double               gain,
                                     const double               offset,
                                     const NoiseLevels         &levels,
                                     Random                    &random)
    {
      const double duration = levels.kind == NoiseKind::drift_in_seconds ?
                                1. :
                                times.back() - times.front();
      std::vector<double> record =
        row_noise(friction.size(), levels.kind, random);
      for (std::size_t i = 0; i < record.size(); ++i)
        record[i] =
          (1. + gain) * friction[i] + offset + levels.white * mean * record[i];
      const double share =
        levels.drift * mean /
        std::sqrt(static_cast<double>(levels.correlation_times.size()));
      for (const double correlation_time : levels.correlation_times)
        {
          const std::vector<double> drift =
            drift_noise(times, correlation_time * duration, random);
          for (std::size_t i = 0; i < record.size(); ++i)
            record[i] += share * drift[i];
        }
      return record;
    }



    void round_motion(std::vector<double> &displacement, const double step)
    {
      for (double &value : displacement)
        value = step * std::round(value / step);
    }
  } // namespace Planting
} // namespace SlipStep
