// SPDX-License-Identifier: LGPL-2.1-or-later

// Signs of friction that a record does not have, and zeros of its sensor.

#include <slipstep/measured_data/sensor_zero.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "imported.h"

using namespace SlipStep;
using namespace Testing;



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



// A force of 0.5 N is 0.05 of a coefficient at 10 N, and 0.025 at 20 N.
TEST(SensorZero, OfACoefficientUnderAVaryingLoadIsDoubtful)
{
  const auto strokes_at = [](const std::string &name, const double later) {
    std::string text = "t,s,N,mu\n";
    for (int i = 0; i <= 200; ++i)
      {
        const double s = i <= 100 ? 0.1 * i : 0.1 * (200 - i);
        const double N = i <= 100 ? 10. : later;
        text += std::to_string(0.1 * i) + ',' + std::to_string(s) + ',' +
                std::to_string(N) + ',' +
                std::to_string((i <= 100 ? 0.2 : -0.2) + 0.5 / N) + '\n';
      }
    return write(name, text);
  };
  const auto warnings_of = [&](const std::string &name, const double later) {
    return import_test(map_of({{"Columns/Time", "t in s"},
                               {"Columns/Displacement", "s in mm"},
                               {"Columns/Normal load", "N in N"},
                               {"Columns/Friction", "mu"},
                               {"Constants/Area", "100 mm^2"},
                               {"Correction/Zero", "mean of strokes"}}),
                       strokes_at(name, later))
      .warnings;
  };
  const auto is_told = [](const std::vector<std::string> &warnings) {
    return std::any_of(warnings.begin(),
                       warnings.end(),
                       [](const std::string &text) {
                         return text.find("Correction/Zero of a coefficient") !=
                                std::string::npos;
                       });
  };
  EXPECT_TRUE(is_told(warnings_of("varies.csv", 20.)));
  EXPECT_FALSE(is_told(warnings_of("steady.csv", 10.)));
}
