// SPDX-License-Identifier: LGPL-2.1-or-later

// Where the gap is, in words that hold for all that lies between.

#include <slipstep/diagnosis/localisation.h>

#include <gtest/gtest.h>

using namespace SlipStep;



TEST(Localisation, ARangeHasNoGap)
{
  const std::map<double, double> sizes = {
    {1., 0.2}, {2., 0.6}, {3., 1.}, {4., 0.7}, {5., 0.1}, {6., 0.9}};
  EXPECT_EQ(range_around(sizes, 3.), std::make_pair(2., 4.));
  EXPECT_EQ(range_around(sizes, 6.), std::make_pair(6., 6.));
  EXPECT_EQ(range_around({{7., 0.1}}, 7.), std::make_pair(7., 7.));
  EXPECT_EQ(range_around({{0., 1.}, {1., 0.9}, {2., 0.8}}, 0.),
            std::make_pair(0., 2.));
  // Nowhere larger than elsewhere.
  EXPECT_EQ(range_around({{1., 0.}, {2., 0.}, {3., 0.}}, 2.),
            std::make_pair(1., 3.));
}
