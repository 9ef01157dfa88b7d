// SPDX-License-Identifier: LGPL-2.1-or-later

// Ways between the rows of circles, ellipses and straight lines.

#include <slipstep/measured_data/arc.h>
#include <slipstep/measured_data/test_rows.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace SlipStep;

namespace
{
  constexpr double full_turn = 6.283185307179586;

  /// One turn of an ellipse of half axes 2 mm and 2 * flatness mm, in rows that
  /// are not quite even in time.
  MeasuredTest ellipse(const unsigned int n, const double flatness)
  {
    MeasuredTest test;
    for (unsigned int i = 0; i <= n; ++i)
      {
        const double time = (i + 0.2 * std::sin(1.7 * i)) / n;
        test.time.push_back(time);
        test.displacement.push_back(2. * std::cos(full_turn * time));
        test.displacement_y.push_back(2. * flatness *
                                      std::sin(full_turn * time));
      }
    return test;
  }

  double length_of(const MeasuredTest &test)
  {
    double length = 0.;
    for (std::size_t row = 1; row < test.time.size(); ++row)
      {
        auto before = position(test, row - 1);
        for (const PartOfWay &part : way_to(test, row))
          {
            length += (part.to - before).norm();
            before = part.to;
          }
      }
    return length;
  }
} // namespace



TEST(Arc, LastPartsHaveTheDirectionAtTheRow)
{
  for (const double flatness : {1., 0.7, 0.4})
    for (const unsigned int n : {60, 150, 400})
      {
        const MeasuredTest test = ellipse(n, flatness);
        for (std::size_t row = 2; row + 1 < test.time.size(); ++row)
          {
            const auto           parts = way_to(test, row);
            const double         phase = full_turn * test.time[row];
            dealii::Tensor<1, 2> tangent;
            tangent[0] = -std::sin(phase);
            tangent[1] = flatness * std::cos(phase);
            EXPECT_EQ(parts.back().end, 1.);
            EXPECT_EQ(parts.back().to, position(test, row));
            const auto   last  = parts.back().to - (parts.size() == 1 ?
                                                      position(test, row - 1) :
                                                      parts[parts.size() - 2].to);
            const double angle = std::acos(
              std::min(1., last * tangent / (last.norm() * tangent.norm())));
            // The chord is off by half of its turn, up to 0.13.
            EXPECT_LT(angle, 0.008) << n << ' ' << flatness << ' ' << row;
          }
      }
  const MeasuredTest circle = ellipse(60, 1.);
  EXPECT_NEAR(length_of(circle),
              2. * full_turn * (circle.time.back() - circle.time.front()),
              2e-3);
}



TEST(Arc, LinesCornersAndTrembleStayStraight)
{
  MeasuredTest line = ellipse(60, 1.), one_axis = line, square;
  line.displacement_y = line.displacement;
  one_axis.displacement_y.clear();
  for (unsigned int i = 0; i <= 40; ++i)
    {
      square.time.push_back(i);
      square.displacement.push_back(i < 10 ? i :
                                    i < 20 ? 10. :
                                    i < 30 ? 30. - i :
                                             0.);
      square.displacement_y.push_back(i < 10 ? 0. :
                                      i < 20 ? i - 10. :
                                      i < 30 ? 10. :
                                               40. - i);
    }
  for (const MeasuredTest &test : {line, one_axis, square})
    for (std::size_t row = 1; row < test.time.size(); ++row)
      EXPECT_EQ(way_to(test, row).size(), 1u) << row;

  // Noise turns one way three times in a row only by chance.
  std::mt19937               random(3);
  std::normal_distribution<> noise(0., 0.01);
  for (unsigned int i = 0; i < line.time.size(); ++i)
    line.displacement_y[i] = 0.5 * i, line.displacement[i] = noise(random) + i;
  std::size_t n_curved = 0;
  for (std::size_t row = 1; row < line.time.size(); ++row)
    n_curved += way_to(line, row).size() > 1;
  EXPECT_LT(n_curved, line.time.size() / 5);
}
