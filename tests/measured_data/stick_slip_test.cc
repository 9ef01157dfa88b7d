// SPDX-License-Identifier: LGPL-2.1-or-later

// Sawteeth of friction, and what only looks like them.

#include <slipstep/measured_data/stick_slip.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace SlipStep;

namespace
{
  // 20 mm at 1 mm/s, friction of the way, with noise.
  MeasuredTest slide(const std::function<double(double)> &friction,
                     const unsigned int                   seed,
                     const double                         turn   = 1e30,
                     const unsigned int                   n_rows = 1001)
  {
    std::mt19937_64            random(seed);
    std::normal_distribution<> noise(0., 0.002);
    MeasuredTest               test;
    for (unsigned int i = 0; i < n_rows; ++i)
      {
        const double way  = 20. * i / (n_rows - 1);
        const bool   back = std::fmod(way, 2. * turn) > turn;
        test.time.push_back(way);
        test.displacement.push_back(back ?
                                      2. * turn - std::fmod(way, 2. * turn) :
                                      std::fmod(way, 2. * turn));
        test.pressure.push_back(5.);
        test.friction.push_back((back ? -1. : 1.) * friction(way) +
                                noise(random));
      }
    return test;
  }

  double sawtooth(const double way)
  {
    return way < 1. ? 0.2 * way : 0.1 + 0.2 * std::fmod(way, 0.5);
  }
} // namespace



// Of a spring of 0.2 per mm under 5 MPa.
TEST(StickSlip, IsFoundByItsSpring)
{
  for (unsigned int seed = 1; seed <= 20; ++seed)
    {
      const auto found = find_stick_slip(slide(sawtooth, seed), 0.002);
      ASSERT_TRUE(found.has_value()) << seed;
      EXPECT_NEAR(found->stiffness, 1., 0.1);
      EXPECT_NEAR(found->n_falls, 38., 3.);
      // Both ways, if each has a few.
      const auto both = find_stick_slip(slide(sawtooth, seed, 5.), 0.002);
      ASSERT_TRUE(both.has_value()) << seed;
      EXPECT_NEAR(both->stiffness, 1., 0.1);
      // Three rows or so of each tooth.
      const auto coarse =
        find_stick_slip(slide(sawtooth, seed, 1e30, 137), 0.002);
      ASSERT_TRUE(coarse.has_value()) << seed;
      EXPECT_NEAR(coarse->stiffness, 1., 0.1);
    }
}



TEST(StickSlip, IsNoWaveNoFallAndNoNoise)
{
  const auto wave = [](const double way) {
    return 0.2 + 0.03 * std::sin(8. * way);
  };
  const auto fall = [](const double way) {
    return std::min(way, 0.2 + 0.1 * std::exp(-way));
  };
  const auto even = [](const double) { return 0.2; };
  for (unsigned int seed = 1; seed <= 20; ++seed)
    for (const auto &friction : {std::function<double(double)>(wave),
                                 std::function<double(double)>(fall),
                                 std::function<double(double)>(even)})
      for (const double turn : {1e30, 2.})
        EXPECT_FALSE(find_stick_slip(slide(friction, seed, turn), 0.002))
          << seed;
}
