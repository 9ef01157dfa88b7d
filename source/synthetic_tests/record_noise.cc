// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/synthetic_tests/hidden_effects.h>
#include <slipstep/synthetic_tests/record_noise.h>

#include <boost/math/constants/constants.hpp>

#include <cmath>

namespace SlipStep
{
  namespace Planting
  {
    namespace
    {
      // In the order of NoiseKind.
      const std::vector<std::string> kind_names = {"normal",
                                                   "heavy_tails",
                                                   "two_drifts",
                                                   "correlated_rows",
                                                   "drift_in_seconds",
                                                   "rounded_motion",
                                                   "noisy_sensors",
                                                   "hum"};
    } // namespace



    std::string to_string(const NoiseKind kind)
    {
      return kind_names[static_cast<std::size_t>(kind)];
    }



    NoiseKind noise_kind(const std::string &wanted)
    {
      return static_cast<NoiseKind>(place_among(kind_names, "noise", wanted));
    }



    NoiseLevels
    draw_levels(const NoiseKind kind, const double factor, Random &random)
    {
      NoiseLevels levels;
      levels.kind = kind;
      if (kind == NoiseKind::noisy_sensors)
        {
          levels.position = 0.0005;
          levels.pressure = 0.003;
        }
      for (double *level : {&levels.white,
                            &levels.drift,
                            &levels.gain,
                            &levels.offset,
                            &levels.position,
                            &levels.pressure})
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



    std::vector<double> row_noise(const std::vector<double> &times,
                                  const NoiseKind            kind,
                                  Random                    &random)
    {
      constexpr double kept      = 0.8;
      constexpr double frequency = 50.; // [Hz]
      constexpr double pi        = boost::math::constants::pi<double>();

      std::normal_distribution<double>    normal;
      std::student_t_distribution<double> student(3.);
      std::vector<double>                 values(times.size());
      // Student's t has the variance 3.
      for (double &value : values)
        value = kind == NoiseKind::heavy_tails ?
                  student(random) / std::sqrt(3.) :
                  normal(random);
      if (kind == NoiseKind::correlated_rows)
        for (std::size_t i = 1; i < values.size(); ++i)
          values[i] =
            kept * values[i - 1] + std::sqrt(1. - kept * kept) * values[i];
      if (kind == NoiseKind::hum)
        {
          const double phase = uniform(random, 0., 2. * pi);
          for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = std::sqrt(0.5) * values[i] +
                        std::sin(2. * pi * frequency * times[i] + phase);
        }
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
      const double duration      = levels.kind == NoiseKind::drift_in_seconds ?
                                     1. :
                                     times.back() - times.front();
      std::vector<double> record = row_noise(times, levels.kind, random);
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



    void record_loading(const NoiseLevels &levels,
                        Random            &random,
                        MeasuredTest      &test)
    {
      constexpr double step = 0.01; // [mm]

      std::normal_distribution<double> normal;
      for (auto *positions : {&test.displacement, &test.displacement_y})
        for (double &value : *positions)
          if (levels.kind == NoiseKind::rounded_motion)
            value = step * std::round(value / step);
          else if (levels.position > 0.)
            value += levels.position * normal(random);
      if (levels.pressure > 0.)
        for (double &value : test.pressure)
          value *= 1. + levels.pressure * normal(random);
    }
  } // namespace Planting
} // namespace SlipStep
