// SPDX-License-Identifier: LGPL-2.1-or-later

// What is kept when a test is resampled: peaks to the last bit, everything else
// within the tolerances it states.

#include <slipstep/measured_data/resample.h>
#include <slipstep/measured_data/test_rows.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

using namespace SlipStep;

namespace
{
  // A static peak, the fall to the kinetic level and two reversals, 1 kHz, with
  // noise.
  MeasuredTest loop(const double noise_of_friction)
  {
    std::mt19937                     random(3);
    std::normal_distribution<double> noise;
    MeasuredTest                     test;
    double                           position = 0., slip = 0., friction = 0.;
    for (int i = 0; i < 30000; ++i)
      {
        const double time  = 1e-3 * i;
        const double speed = time < 2.  ? 0. :
                             time < 12. ? 1. :
                             time < 22. ? -1. :
                                          1.;
        position += 1e-3 * speed;
        slip += 1e-3 * std::abs(speed);
        const double limit = 0.098 + 0.017 * std::exp(-slip / 3.);
        friction           = std::clamp(friction + 0.01 * speed, -limit, limit);
        test.time.push_back(time);
        test.displacement.push_back(position + 1e-4 * noise(random));
        test.pressure.push_back(5.8 + 0.01 * noise(random));
        test.friction.push_back(friction + noise_of_friction * noise(random));
      }
    return test;
  }

  double largest_distance(const MeasuredTest  &test,
                          const ResampledTest &resampled,
                          std::vector<double> MeasuredTest::*channel)
  {
    double      largest = 0.;
    std::size_t right   = 1;
    for (std::size_t i = 0; i < test.time.size(); ++i)
      {
        while (resampled.rows[right] < i)
          ++right;
        const std::size_t a = resampled.rows[right - 1];
        const std::size_t b = resampled.rows[right];
        const double      w =
          (test.time[i] - test.time[a]) / (test.time[b] - test.time[a]);
        largest =
          std::max(largest,
                   std::abs((test.*channel)[i] - (1. - w) * (test.*channel)[a] -
                            w * (test.*channel)[b]));
      }
    return largest;
  }
} // namespace



TEST(Resample, EveryRowIsWithinTheStatedTolerances)
{
  const MeasuredTest  test   = loop(3e-4);
  const ResampledTest result = resample(test);
  EXPECT_LT(result.rows.size(), test.time.size() / 20);
  const double rounding = 1e-12;
  EXPECT_LE(largest_distance(test, result, &MeasuredTest::friction),
            result.friction_tolerance + rounding);
  EXPECT_LE(largest_distance(test, result, &MeasuredTest::displacement),
            result.displacement_tolerance + rounding);
  EXPECT_LE(largest_distance(test, result, &MeasuredTest::pressure),
            result.pressure_tolerance + rounding);
  EXPECT_NEAR(result.friction_tolerance, 4. * 3e-4, 1e-4);
  for (std::size_t i = 0; i < result.rows.size(); ++i)
    EXPECT_EQ(result.test.friction[i], test.friction[result.rows[i]]);
}



TEST(Resample, PeaksAreExact)
{
  const MeasuredTest  test   = loop(3e-4);
  const ResampledTest result = resample(test);
  const auto [low, high] =
    std::minmax_element(test.friction.begin(), test.friction.end());
  const auto [kept_low, kept_high] =
    std::minmax_element(result.test.friction.begin(),
                        result.test.friction.end());
  EXPECT_EQ(*low, *kept_low);
  EXPECT_EQ(*high, *kept_high);
  EXPECT_EQ(result.test.time[kept_high - result.test.friction.begin()],
            test.time[high - test.friction.begin()]);

  // In each stroke, too: this one is the second.
  const auto in_stroke = [](const MeasuredTest &any) {
    double least = 1.;
    for (std::size_t i = 0; i < any.time.size(); ++i)
      if (any.time[i] > 12.5 && any.time[i] < 21.5)
        least = std::min(least, any.friction[i]);
    return least;
  };
  EXPECT_EQ(in_stroke(test), in_stroke(result.test));
}



TEST(Resample, OnsetAndReversalsAreKept)
{
  const MeasuredTest  test   = loop(3e-4);
  const ResampledTest result = resample(test);
  // Each within the time in which the displacement passes its tremble.
  const double tremble = 0.06;
  for (const double event : {2., 12., 22.})
    {
      double nearest = 1.;
      for (const double time : result.test.time)
        nearest = std::min(nearest, std::abs(time - event));
      EXPECT_LT(nearest, tremble) << event;
    }
}



TEST(Resample, TheWorkOfFrictionIsKept)
{
  for (const double noise : {0., 3e-4, 3e-3})
    {
      const MeasuredTest  test   = loop(noise);
      const ResampledTest result = resample(test);
      const double        path   = 28.;
      const double        exact  = frictional_work(test);
      const double        bound  = path * (result.friction_tolerance * 5.8 +
                                   0.12 * result.pressure_tolerance) +
                           0.12 * 5.8 * 6. * result.displacement_tolerance;
      EXPECT_LE(std::abs(frictional_work(result.test) - exact), bound);
      EXPECT_NEAR(frictional_work(result.test) / exact, 1., 0.01) << noise;
    }
}



TEST(Resample, WithoutNoiseOnlyTheShapeCounts)
{
  const MeasuredTest  test   = loop(0.);
  const ResampledTest result = resample(test);
  EXPECT_LE(result.friction_tolerance, 0.0011 * range_of(test.friction));
}



TEST(Resample, TheNumberOfRowsCanBeLimited)
{
  const MeasuredTest test = loop(3e-3);
  ResampleOptions    options;
  options.most_rows          = 60;
  const ResampledTest result = resample(test, options);
  EXPECT_LE(result.rows.size(), 60u);
  EXPECT_EQ(*std::max_element(result.test.friction.begin(),
                              result.test.friction.end()),
            *std::max_element(test.friction.begin(), test.friction.end()));
  EXPECT_LE(largest_distance(test, result, &MeasuredTest::friction),
            result.friction_tolerance + 1e-12);
}



TEST(Resample, AFewRowsStay)
{
  MeasuredTest test;
  test.time         = {0., 1.};
  test.displacement = {0., 1.};
  test.pressure     = {1., 1.};
  test.friction     = {0.1, 0.1};
  EXPECT_EQ(resample(test).rows.size(), 2u);
}



TEST(Resample, PublishedRecordsKeepPeaksAndWork)
{
  for (const std::string name :
       {"sepiolite_velocity_step/measured/velstep3_TR2_exp013_sepiolite.csv",
        "reciprocating_tribometer/measured/test_data_2.csv",
        "pps_ptfe_pin_on_disc/measured/PPS_60N_1.csv",
        "pps_ptfe_pin_on_disc/measured/PPS_45PTFE_60N_2.csv"})
    {
      SCOPED_TRACE(name);
      const MeasuredTest test =
        read_measured_test(std::string(SLIPSTEP_SOURCE_DIR "/prm/") + name);
      const ResampledTest result = resample(test);
      EXPECT_LT(result.rows.size(), test.time.size() / 6);
      EXPECT_EQ(range_of(result.test.friction), range_of(test.friction));
      EXPECT_NEAR(frictional_work(result.test) / frictional_work(test),
                  1.,
                  0.005);
      EXPECT_LE(largest_distance(test, result, &MeasuredTest::friction),
                result.friction_tolerance * (1. + 1e-9));
    }
}



// A pressure that is constant but for ramps, each passed in few rows, is led as
// it was recorded.
TEST(Resample, ACleanPressureIsKept)
{
  MeasuredTest test   = loop(3e-4);
  double       wanted = 6.;
  for (std::size_t i = 0; i < test.time.size(); ++i)
    {
      if (i % 1000 == 0)
        wanted = i % 2000 == 0 ? 6. : 12.;
      // The controller acts every tenth row.
      const double last = i == 0 ? 6. : test.pressure[i - 1];
      test.pressure[i] =
        i % 10 == 0 ? last + std::clamp(wanted - last, -0.6, 0.6) : last;
    }
  const ResampledTest result = resample(test);
  EXPECT_NEAR(result.pressure_tolerance, 0.012, 1e-9);
  EXPECT_LE(largest_distance(test, result, &MeasuredTest::pressure), 0.012);
}



// However long the track is: friction knows of the first micrometres.
TEST(Resample, KeepsTheEndsOfRestsAlongBothAxes)
{
  for (const bool along_y : {false, true})
    for (const double speed : {1e-4, 1., 50.})
      {
        MeasuredTest test;
        double       position = 0.;
        for (int i = 0; i < 600; ++i)
          {
            const bool rests = i <= 3 || (i > 300 && i <= 307);
            position += rests ? 0. : speed * (i < 10 ? 1e-3 : 1.);
            test.time.push_back(i);
            test.displacement.push_back(along_y ? 0. : position);
            test.displacement_y.push_back(along_y ? position : 0.);
            test.pressure.push_back(5.);
            test.friction.push_back(0.1);
            test.friction_y.push_back(0.1);
          }
        const std::vector<std::size_t> rows = resample(test).rows;
        for (const std::size_t row : {0, 3, 300, 307, 599})
          EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), row))
            << row << " at " << speed << (along_y ? " along y" : " along x");
        EXPECT_LT(rows.size(), 20u);
      }
}



// Stairs of a rounded record are no rests, unless one is much longer.
TEST(Resample, TakesNoStairsForRests)
{
  MeasuredTest test;
  for (int i = 0; i < 3000; ++i)
    {
      const double position = 1e-3 * (i < 1000 ? i :
                                      i < 2000 ? 1000 :
                                                 i - 1000);
      test.time.push_back(i);
      test.displacement.push_back(std::round(position / 0.01) * 0.01);
      test.pressure.push_back(5.);
      test.friction.push_back(0.1);
    }
  EXPECT_LT(resample(test).rows.size(), 60u);
}



// Friction goes by the direction of motion, which a coarse polygon has only
// roughly.
TEST(Resample, ACircleKeepsItsDirections)
{
  MeasuredTest circle;
  const int    n = 4000;
  for (int i = 0; i <= n; ++i)
    {
      const double phase = 2. * M_PI * i / n;
      circle.time.push_back(0.01 * i);
      circle.displacement.push_back(0.3 * std::cos(phase));
      circle.displacement_y.push_back(0.3 * std::sin(phase));
      circle.pressure.push_back(5.);
      circle.friction.push_back(-0.2 * std::sin(phase));
      circle.friction_y.push_back(0.2 * std::cos(phase));
    }
  const std::vector<std::size_t> rows    = resample(circle).rows;
  std::size_t                    longest = 0;
  for (std::size_t i = 1; i < rows.size(); ++i)
    longest = std::max(longest, rows[i] - rows[i - 1]);
  EXPECT_LT(360. * longest / n, 1.);
  EXPECT_LT(rows.size(), 1500u);

  // What goes along a line has no directions.
  circle.displacement_y.assign(n + 1, 0.);
  circle.friction_y.assign(n + 1, 0.);
  EXPECT_LT(resample(circle).rows.size(), 150u);
}
