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
  Random                    random(1);
  const std::size_t         n = 200000;
  const std::vector<double> times(n);
  EXPECT_NEAR(mean_of_squares(row_noise(times, NoiseKind::normal, random)),
              1.,
              5. * std::sqrt(2. / n));
  // The fourth moment of Student's t is infinite: compare a quantile. The
  // chance of more than 3 standard deviations is 0.0138, normally 0.0027.
  unsigned int beyond = 0;
  for (const double value : row_noise(times, NoiseKind::heavy_tails, random))
    beyond += std::abs(value) > 3.;
  EXPECT_NEAR(beyond / static_cast<double>(n),
              0.0138,
              5. * std::sqrt(0.0138 / n));
}



// Lags of 1, 2 and 5 rows.
TEST(RecordNoise, CorrelatedRows)
{
  Random            random(7);
  const std::size_t n = 200000;
  const auto        values =
    row_noise(std::vector<double>(n), NoiseKind::correlated_rows, random);
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



// Rows a period apart have the same hum, those half a period apart the
// opposite.
TEST(RecordNoise, Hum)
{
  Random       random(9);
  const double n       = 20000;
  double       squares = 0., period = 0., half = 0.;
  for (int i = 0; i < n; ++i)
    {
      const auto values = row_noise({0.3, 0.31, 7.32}, NoiseKind::hum, random);
      squares += mean_of_squares(values) / n;
      half += values[0] * values[1] / n;
      period += values[0] * values[2] / n;
    }
  EXPECT_NEAR(squares, 1., 5. * std::sqrt(2. / (3. * n)));
  EXPECT_NEAR(half, -0.5, 5. / std::sqrt(n));
  EXPECT_NEAR(period, 0.5, 5. / std::sqrt(n));
}



TEST(RecordNoise, RoundedMotion)
{
  Random                 random(1);
  SlipStep::MeasuredTest test;
  test.displacement = {0., 0.0149, 0.0151, -3.337};
  test.pressure     = {1., 1., 1., 1.};
  record_loading(draw_levels(NoiseKind::rounded_motion, 1., random),
                 random,
                 test);
  EXPECT_DOUBLE_EQ(test.displacement[1], 0.01);
  EXPECT_DOUBLE_EQ(test.displacement[2], 0.02);
  EXPECT_DOUBLE_EQ(test.displacement[3], -3.34);
  EXPECT_EQ(test.pressure, std::vector<double>({1., 1., 1., 1.}));
}



TEST(RecordNoise, NoisySensors)
{
  Random                 random(4);
  const std::size_t      n = 20000;
  SlipStep::MeasuredTest test;
  test.displacement.assign(n, 3.);
  test.pressure.assign(n, 5.);
  record_loading(draw_levels(NoiseKind::noisy_sensors, 2., random),
                 random,
                 test);
  for (double &value : test.displacement)
    value = (value - 3.) / 0.001;
  for (double &value : test.pressure)
    value = (value / 5. - 1.) / 0.006;
  EXPECT_NEAR(mean_of_squares(test.displacement), 1., 5. * std::sqrt(2. / n));
  EXPECT_NEAR(mean_of_squares(test.pressure), 1., 5. * std::sqrt(2. / n));
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
