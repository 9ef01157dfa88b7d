// SPDX-License-Identifier: LGPL-2.1-or-later

// The noise of sensors of position and load, taken off what leads the contact.

#include <slipstep/measured_data/sensor_noise.h>
#include <slipstep/measured_data/test_rows.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/file_text.h"

using namespace SlipStep;

namespace
{
  /// Slides at several speeds, with a rest, a turn and a rest between.
  struct Track
  {
    std::vector<double> time, position;
    std::vector<bool>   rests; ///< from the row before to the next one

    void go(const double speed, const unsigned int n)
    {
      constexpr double distance = 0.01;
      for (unsigned int i = 0; i < n; ++i)
        {
          time.push_back(time.empty() ? 0. : time.back() + distance);
          position.push_back(
            position.empty() ? 0. : position.back() + speed * distance);
          rests.push_back(speed == 0. && i > 0 && i + 1 < n);
        }
    }

    Track()
    {
      go(0., 1);
      go(1., 200);
      go(0., 300);
      go(0.1, 400);
      go(0., 100);
      go(-5., 100);
      go(0., 50);
      go(2., 40);
    }
  };



  std::vector<double> without_noise(const Track        &track,
                                    std::vector<double> values,
                                    const double        deviation)
  {
    take_off_noise(track.time, {&values}, {deviation});
    return values;
  }



  std::vector<double> with_noise(std::vector<double> values,
                                 const double        deviation,
                                 const unsigned int  seed)
  {
    std::mt19937_64            generator(seed);
    std::normal_distribution<> normal(0., deviation);
    for (double &value : values)
      value += normal(generator);
    return values;
  }
} // namespace



TEST(SensorNoise, RestsAreRestsAndSlidesStayWhereTheyAre)
{
  const Track track;
  for (const double deviation : {1e-5, 2e-4, 2e-3})
    for (unsigned int seed = 1; seed <= 10; ++seed)
      {
        SCOPED_TRACE(std::to_string(deviation) + ' ' + std::to_string(seed));
        const std::vector<double> result =
          without_noise(track,
                        with_noise(track.position, deviation, seed),
                        deviation);
        unsigned int n_moving = 0;
        double       square   = 0.;
        for (std::size_t i = 1; i < result.size(); ++i)
          {
            square += std::pow(result[i] - track.position[i], 2);
            n_moving += track.rests[i] && result[i] != result[i - 1];
          }
        // Slow as it is, the noise hides some rows of where a rest ends.
        EXPECT_LE(n_moving, 25u);
        EXPECT_LT(std::sqrt(square / result.size()), 0.6 * deviation);
      }
}



TEST(SensorNoise, WhatIsNoLineStaysAsItIs)
{
  const Track track;
  EXPECT_EQ(without_noise(track, track.position, 0.), track.position);
  const std::size_t   n = track.time.size();
  std::vector<double> wave, stroke, stairs, parabola;
  for (std::size_t i = 0; i < n; ++i)
    {
      wave.push_back(std::sin(20. * track.time[i]));
      stroke.push_back(0.05 * std::sin(2. * track.time[i]));
      stairs.push_back(1e-3 * (i / 100));
      parabola.push_back(1e-7 * i * i);
    }
  for (const auto &clean : {wave, stroke, stairs, parabola})
    for (unsigned int seed = 1; seed <= 10; ++seed)
      {
        const auto noisy  = with_noise(clean, 2e-4, seed);
        const auto result = without_noise(track, noisy, 2e-4);
        double     square = 0.;
        for (std::size_t i = 0; i < n; ++i)
          square += std::pow(result[i] - clean[i], 2) / n;
        EXPECT_LT(std::sqrt(square), 1.1 * 2e-4) << seed;
      }
}



// Digits that are finer than the noise are no matter.
TEST(SensorNoise, OfFewDigitsIsTakenOffAsWell)
{
  const Track track;
  auto        position = with_noise(track.position, 2e-4, 1);
  for (double &value : position)
    value = 1e-4 * std::round(value / 1e-4);
  MeasuredTest test;
  test.time         = track.time;
  test.displacement = position;
  test.pressure.assign(track.time.size(), 5.);
  take_off_noise_of_motion(test, 1e-5);
  EXPECT_EQ(test.displacement[300], test.displacement[400]);

  // Half turns of a disc, counted once a second.
  for (std::size_t i = 0; i < position.size(); ++i)
    position[i] = 88. * std::floor(1.4 * i);
  test.displacement = position;
  take_off_noise_of_motion(test, 1e-5);
  EXPECT_EQ(test.displacement, position);
}



// Of the motion only where a contact would feel it, and it is said.
TEST(SensorNoise, IsTakenOffWhereItIsFelt)
{
  const Track  track;
  MeasuredTest test;
  test.file         = "a.csv";
  test.time         = track.time;
  test.displacement = with_noise(track.position, 2e-4, 1);
  test.pressure =
    with_noise(std::vector<double>(track.time.size(), 5.), 0.02, 2);
  MeasuredTest other = test;
  take_off_noise_of_motion(test, 1e-5);
  EXPECT_EQ(range_of(test.pressure), 0.);
  EXPECT_NEAR(test.pressure[0], 5., 0.003);
  EXPECT_EQ(test.displacement[300], test.displacement[400]);
  ASSERT_EQ(test.warnings.size(), 2u);
  EXPECT_TRUE(contains(test.warnings[0], "trembles by 2e-04 mm"));

  const std::vector<double> as_recorded = other.displacement;
  other.pressure.assign(other.time.size(), 5.);
  take_off_noise_of_motion(other, 1e-3);
  EXPECT_EQ(other.displacement, as_recorded);
  EXPECT_TRUE(other.warnings.empty());
}



// Where times are uneven, an even motion only seems to tremble.
TEST(SensorNoise, UnevenTimesAreNone)
{
  std::mt19937_64                  generator(1);
  std::uniform_real_distribution<> uniform(0.5, 1.5);
  MeasuredTest                     test;
  for (unsigned int i = 0; i < 500; ++i)
    {
      test.time.push_back(i == 0 ? 0. : test.time.back() + uniform(generator));
      test.displacement.push_back(350. * test.time.back());
      test.pressure.push_back(5.);
    }
  const std::vector<double> as_recorded = test.displacement;
  take_off_noise_of_motion(test, 1e-5);
  EXPECT_EQ(test.displacement, as_recorded);
  EXPECT_TRUE(test.warnings.empty());
}



// A stroke of a crank in few rows, of which some were left out.
TEST(SensorNoise, AStrokeThatBendsIsNone)
{
  for (unsigned int seed = 1; seed <= 10; ++seed)
    {
      std::mt19937_64                 generator(seed);
      std::uniform_int_distribution<> leap(1, 4);
      MeasuredTest                    test;
      constexpr std::size_t           n = 120;
      for (unsigned int row = 0; test.time.size() < n; row += leap(generator))
        {
          test.time.push_back(0.025 * row);
          test.displacement.push_back(
            1e-5 * std::round(1e5 * std::sin(0.025 * row * 3.14)));
          test.pressure.push_back(5.);
        }
      const std::vector<double> as_recorded = test.displacement;
      take_off_noise_of_motion(test, 1e-5);
      EXPECT_EQ(test.displacement, as_recorded) << seed;
      EXPECT_TRUE(test.warnings.empty()) << seed;
    }
}



// Slides and rests of few rows: what stands still to the last digit does not
// tremble.
TEST(SensorNoise, FewRowsBetweenRestsAreNone)
{
  MeasuredTest test;
  test.time         = {0.,
                       10.,
                       57.,
                       87.,
                       108.,
                       113.,
                       133.,
                       154.,
                       349.,
                       397.,
                       417.,
                       482.,
                       2220.,
                       2933.,
                       2950.};
  test.displacement = {0.,
                       1.4,
                       8.,
                       12.,
                       12.,
                       12.4,
                       15.1,
                       17.,
                       17.,
                       17.1,
                       19.8,
                       22.,
                       22.,
                       22.1,
                       24.6};
  test.pressure.assign(test.time.size(), 6.7);
  const std::vector<double> as_recorded = test.displacement;
  take_off_noise_of_motion(test, 1e-5);
  EXPECT_EQ(test.displacement, as_recorded);
  EXPECT_TRUE(test.warnings.empty());
}
