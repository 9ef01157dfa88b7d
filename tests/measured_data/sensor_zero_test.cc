// SPDX-License-Identifier: LGPL-2.1-or-later

// Signs of friction that a record does not have.

#include <slipstep/measured_data/sensor_zero.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace SlipStep;



// Forth, a rest, back; the first rows rest, too.
TEST(SensorZero, MagnitudesGetTheSignOfTheLastMotion)
{
  std::vector<double> time, place, magnitude, expected;
  for (int i = 0; i <= 300; ++i)
    {
      time.push_back(i);
      place.push_back(i < 10  ? 0. :
                      i < 100 ? i - 10. :
                      i < 150 ? 89. :
                                std::max(89. - (i - 149), 0.));
      magnitude.push_back(0.1 + 1e-4 * i);
      expected.push_back(i < 150 ? magnitude.back() : -magnitude.back());
    }
  std::vector<double> friction = magnitude;
  give_sign_of_motion(time, place, friction);
  EXPECT_EQ(friction, expected);

  // The newest row first.
  for (auto *values : {&time, &place, &magnitude, &expected})
    std::reverse(values->begin(), values->end());
  give_sign_of_motion(time, place, magnitude);
  EXPECT_EQ(magnitude, expected);
}



TEST(SensorZero, OneSignIsToldFromElasticity)
{
  std::vector<double> time, place, sliding, elastic;
  for (int i = 0; i <= 400; ++i)
    {
      const int phase = i % 200;
      time.push_back(i);
      place.push_back(phase < 100 ? phase : 200 - phase);
      sliding.push_back(0.12 + 0.001 * (i % 3));
      elastic.push_back(0.2 + 1e-3 * place.back());
    }
  const auto means = friction_of_one_sign(time, place, sliding);
  ASSERT_TRUE(means.has_value());
  EXPECT_NEAR(means->forth, 0.121, 1e-4);
  EXPECT_NEAR(means->back, 0.121, 1e-4);
  EXPECT_NEAR(means->scatter, 0.0007, 3e-4);
  EXPECT_FALSE(friction_of_one_sign(time, place, elastic).has_value());
}



// A position that trembles in a rest goes no strokes.
TEST(SensorZero, ARestHasNoSign)
{
  std::mt19937_64            generator(1);
  std::normal_distribution<> normal;
  std::vector<double>        time, place, friction;
  for (int i = 0; i < 500; ++i)
    {
      time.push_back(i);
      place.push_back(1. + 2e-4 * normal(generator));
      friction.push_back(0.1 + 0.002 * normal(generator));
    }
  EXPECT_FALSE(friction_of_one_sign(time, place, friction).has_value());
}



TEST(SensorZero, MotionInItsTimeIsSeen)
{
  std::vector<double> time, place;
  for (int i = 0; i <= 100; ++i)
    {
      time.push_back(0.1 * i);
      place.push_back(std::max(0., i - 30.) + 1e-4 * (i % 2));
    }
  EXPECT_FALSE(moves_in_first("mean of the first 2 s", time, place));
  EXPECT_TRUE(moves_in_first("mean of the first 5 s", time, place));
}
