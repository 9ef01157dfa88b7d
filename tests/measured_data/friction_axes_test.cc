// SPDX-License-Identifier: LGPL-2.1-or-later

// The independent measurements of friction in a test, by its noise.

#include <slipstep/measured_data/friction_axes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace SlipStep;

namespace
{
  constexpr double pi = 3.14159265358979;

  double rounded(const double value, const double step)
  {
    return step > 0. ? step * std::round(value / step) : value;
  }

  // A slide along a line at an angle to x: friction there and across it as two
  // sensors give them, which stand at an angle to x themselves.
  MeasuredTest slide(const double   of_motion,
                     const double   of_sensors,
                     const double   noise,
                     const double   noise_across,
                     const double   step,
                     const unsigned seed)
  {
    std::mt19937_64            random(seed);
    std::normal_distribution<> normal;
    MeasuredTest               test;
    const double c = std::cos(of_sensors), s = std::sin(of_sensors);
    for (unsigned int i = 0; i < 1000; ++i)
      {
        const double way      = 0.004 * i;
        const double friction = 0.2 * (1. - std::exp(-way / 0.1));
        const double along =
          friction * std::cos(of_motion - of_sensors) + noise * normal(random);
        const double across = friction * std::sin(of_motion - of_sensors) +
                              noise_across * normal(random);
        test.time.push_back(0.1 * i);
        test.displacement.push_back(way * std::cos(of_motion));
        test.displacement_y.push_back(way * std::sin(of_motion));
        test.pressure.push_back(5.);
        test.friction.push_back(rounded(c * along - s * across, step));
        test.friction_y.push_back(rounded(s * along + c * across, step));
      }
    return test;
  }

  // Whatever end of the axis counts.
  double angle_between(const FrictionAxis &axis, const double angle)
  {
    return std::asin(
      std::abs(axis.cosine * std::sin(angle) - axis.sine * std::cos(angle)));
  }
} // namespace



TEST(FrictionAxes, AreXAloneWithoutASecondColumn)
{
  MeasuredTest test = slide(0., 0., 1e-3, 0., 0., 1);
  test.friction_y.clear();
  const std::vector<FrictionAxis> axes = friction_axes(test);
  ASSERT_EQ(axes.size(), 1u);
  EXPECT_EQ(axes[0].cosine, 1.);
  EXPECT_EQ(axes[0].sine, 0.);
  EXPECT_NEAR(axes[0].noise, 1e-3, 1.5e-4);
}



TEST(FrictionAxes, OfASensorWithNothingAcrossAreItsDirection)
{
  for (const double degrees : {0., 30., 45., 90., -60., 150.})
    for (unsigned int seed = 1; seed < 6; ++seed)
      {
        const double       angle = degrees * pi / 180.;
        const MeasuredTest test  = slide(angle, angle, 1e-3, 0., 1e-7, seed);
        const std::vector<FrictionAxis> axes = friction_axes(test);
        ASSERT_EQ(axes.size(), 1u) << degrees;
        EXPECT_LT(angle_between(axes[0], angle), 1e-4);
        EXPECT_NEAR(axes[0].noise, 1e-3, 2e-4);
      }
}



// What is left across it is rounding, even where digits are as coarse as noise.
TEST(FrictionAxes, OfFewDigitsAreThatOfTheSensorAndAcross)
{
  for (const double noise : {1e-3, 2e-3})
    for (unsigned int seed = 1; seed < 9; ++seed)
      {
        const double       angle = pi / 6.;
        const MeasuredTest test  = slide(angle, angle, noise, 0., 1e-3, seed);
        const std::vector<FrictionAxis> axes = friction_axes(test);
        ASSERT_EQ(axes.size(), 2u);
        EXPECT_LT(angle_between(axes[0], angle), 1e-3);
        EXPECT_NEAR(axes[0].noise, noise, 0.3 * noise);
        EXPECT_NEAR(axes[1].noise, 1e-3 / std::sqrt(12.), 0.6e-4);
      }
}



TEST(FrictionAxes, OfTwoSensorsHaveNoiseOfTheirOwn)
{
  for (const double of_motion : {0., 40.})
    for (unsigned int seed = 1; seed < 9; ++seed)
      {
        const MeasuredTest test =
          slide(of_motion * pi / 180., 0., 1e-3, 2e-4, 0., seed);
        const std::vector<FrictionAxis> axes = friction_axes(test);
        ASSERT_EQ(axes.size(), 2u);
        EXPECT_EQ(axes[0].cosine, 1.);
        EXPECT_NEAR(axes[0].noise, 1e-3, 2e-4);
        EXPECT_NEAR(axes[1].noise, 2e-4, 4e-5);
      }
}



// Whichever of them is the quieter one.
TEST(FrictionAxes, OfTwoSensorsAtAnAngleAreTheirs)
{
  for (const auto &[along, across] :
       {std::make_pair(1e-3, 2e-4), std::make_pair(2e-4, 1e-3)})
    for (unsigned int seed = 1; seed < 9; ++seed)
      {
        const MeasuredTest test = slide(0.3, pi / 4., along, across, 0., seed);
        const std::vector<FrictionAxis> axes = friction_axes(test);
        ASSERT_EQ(axes.size(), 2u);
        const bool is_first = along > across;
        EXPECT_LT(angle_between(axes[0], is_first ? pi / 4. : -pi / 4.), 0.06);
        EXPECT_NEAR(axes[0].noise, 1e-3, 2e-4);
        EXPECT_NEAR(axes[1].noise, 2e-4, 5e-5);
      }
}
