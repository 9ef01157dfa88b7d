// SPDX-License-Identifier: LGPL-2.1-or-later

// The noise has the statistics that it states, within five standard errors.

#include <slipstep/synthetic_tests/hidden_effects.h>
#include <slipstep/synthetic_tests/record_noise.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

using namespace SlipStep::Planting;

namespace
{
  double mean_of_squares(const std::vector<double> &values)
  {
    return std::inner_product(values.begin(),
                              values.end(),
                              values.begin(),
                              0.) /
           values.size();
  }
} // namespace



TEST(RecordNoise, White)
{
  Random            random(1);
  const std::size_t n = 200000;
  EXPECT_NEAR(mean_of_squares(row_noise(n, NoiseKind::normal, random)),
              1.,
              5. * std::sqrt(2. / n));
  // The fourth moment of Student's t is infinite: compare a quantile. The
  // chance of more than 3 standard deviations is 0.0138, normally 0.0027.
  unsigned int beyond = 0;
  for (const double value : row_noise(n, NoiseKind::heavy_tails, random))
    beyond += std::abs(value) > 3.;
  EXPECT_NEAR(beyond / static_cast<double>(n),
              0.0138,
              5. * std::sqrt(0.0138 / n));
}



// Lags of 1, 2 and 5 rows.
TEST(RecordNoise, CorrelatedRows)
{
  Random            random(7);
  const std::size_t n      = 200000;
  const auto        values = row_noise(n, NoiseKind::correlated_rows, random);
  EXPECT_NEAR(mean_of_squares(values), 1., 5. * std::sqrt(2. * 4.6 / n));
  for (const std::size_t lag : {1, 2, 5})
    EXPECT_NEAR(std::inner_product(
                  values.begin() + lag, values.end(), values.begin(), 0.) /
                  n,
                std::pow(0.8, lag),
                5. * std::sqrt(9. / n));
}



// Two records of 20 s and 2000 s, of drift only.
TEST(RecordNoise, DriftInSeconds)
{
  Random      random(8);
  NoiseLevels levels = draw_levels(NoiseKind::drift_in_seconds, 1., random);
  levels.white       = 0.;
  for (const double duration : {20., 2000.})
    {
      const std::vector<double> times = {0., 5., duration};
      const std::size_t         n     = 20000;
      double                    sum   = 0.;
      for (std::size_t i = 0; i < n; ++i)
        {
          const auto record =
            noisy_record(times, {0., 0., 0.}, 1., 0., 0., levels, random);
          sum += record[0] * record[1] / std::pow(levels.drift, 2);
        }
      EXPECT_NEAR(sum / n, std::exp(-0.5), 5. * std::sqrt(1.4 / n));
    }
}



TEST(RecordNoise, RoundedMotion)
{
  std::vector<double> values = {0., 0.0149, 0.0151, -3.337};
  round_motion(values, 0.01);
  EXPECT_DOUBLE_EQ(values[1], 0.01);
  EXPECT_DOUBLE_EQ(values[2], 0.02);
  EXPECT_DOUBLE_EQ(values[3], -3.34);
}



TEST(RecordNoise, Drift)
{
  Random              random(2);
  std::vector<double> start, end;
  const std::size_t   n = 20000;
  for (std::size_t i = 0; i < n; ++i)
    {
      // Uneven times.
      const auto drift = drift_noise({0., 0.3, 0.5, 2.}, 2., random);
      start.push_back(drift.front());
      end.push_back(drift.back());
    }
  EXPECT_NEAR(mean_of_squares(start), 1., 5. * std::sqrt(2. / n));
  EXPECT_NEAR(mean_of_squares(end), 1., 5. * std::sqrt(2. / n));
  EXPECT_NEAR(std::inner_product(start.begin(), start.end(), end.begin(), 0.) /
                n,
              std::exp(-1.),
              5. * std::sqrt(1.2 / n));
}



TEST(RecordNoise, GainOffsetAndCorrelationTimes)
{
  Random              random(3);
  std::vector<double> gains, offsets;
  const NoiseLevels   levels = draw_levels(NoiseKind::normal, 1., random);
  const std::size_t   n      = 20000;
  for (std::size_t i = 0; i < n; ++i)
    {
      const RecordNoise noise = draw_record_noise(levels, 0.13, random);
      gains.push_back(noise.gain / 0.006);
      offsets.push_back(noise.offset_x / (0.002 * 0.13));
    }
  EXPECT_NEAR(mean_of_squares(gains), 1., 5. * std::sqrt(2. / n));
  EXPECT_NEAR(mean_of_squares(offsets), 1., 5. * std::sqrt(2. / n));
  for (int i = 0; i < 100; ++i)
    {
      const auto one = draw_levels(NoiseKind::normal, 1., random);
      ASSERT_EQ(one.correlation_times.size(), 1u);
      EXPECT_GE(one.correlation_times[0], 0.05);
      EXPECT_LE(one.correlation_times[0], 0.3);
    }
  EXPECT_EQ(
    draw_levels(NoiseKind::two_drifts, 1., random).correlation_times.size(),
    2u);
}



TEST(RecordNoise, TheParts)
{
  Random      random(4);
  NoiseLevels levels = draw_levels(NoiseKind::two_drifts, 0., random);
  const std::vector<double> times = {0., 1., 2.}, friction = {0., 0.1, 0.12};
  const auto                record =
    noisy_record(times, friction, 0.1, 0.02, 0.003, levels, random);
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_DOUBLE_EQ(record[i], 1.02 * friction[i] + 0.003);
}
