// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/rounded_motion.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/file_text.h"

using namespace SlipStep;

namespace
{
  constexpr double step = 0.01;

  // Rest at 0, slide, rest, slide ten times as fast, and back.
  double place_at(const double t)
  {
    if (t < 5.)
      return 0.;
    if (t < 25.)
      return 0.02 * (t - 5.);
    if (t < 35.)
      return 0.4;
    if (t < 45.)
      return 0.4 + 0.2 * (t - 35.);
    return 2.4 - 0.1 * (t - 45.);
  }

  struct Record
  {
    std::vector<double> time, exact, rounded;

    explicit Record(const double interval)
    {
      for (double t = 0.; t < 60.; t += interval)
        {
          time.push_back(t);
          exact.push_back(place_at(t));
          rounded.push_back(step * std::round(exact.back() / step));
        }
    }
  };

  double largest_difference(const std::vector<double> &a,
                            const std::vector<double> &b)
  {
    double result = 0.;
    for (std::size_t i = 0; i < a.size(); ++i)
      result = std::max(result, std::abs(a[i] - b[i]));
    return result;
  }
} // namespace



// 300 Hz in whole ms: steps of 3, 3 and 4; the clock changes to 700 Hz.
TEST(RoundedMotion, StampsOfAnEvenClockAreMadeEven)
{
  MeasuredTest        test;
  std::vector<double> exact;
  for (unsigned int i = 0; i < 600; ++i)
    {
      exact.push_back(i < 300 ? i / 300. : 1. + (i - 300) / 700.);
      test.time.push_back(1e-3 * std::round(1e3 * exact.back()));
    }
  EXPECT_NEAR(rounding_of_time(test.time), 1e-3, 1e-9);
  EXPECT_EQ(rounding_of_time(exact), 0.);
  undo_rounding_of_time(test);
  EXPECT_LT(largest_difference(test.time, exact), 1.5e-4);
  // But where it changes.
  for (const auto &[begin, end] : {std::pair{1, 295}, std::pair{306, 600}})
    for (int i = begin; i < end; ++i)
      EXPECT_NEAR(test.time[i] - test.time[i - 1],
                  exact[i] - exact[i - 1],
                  1e-5)
        << i;
}



TEST(RoundedMotion, OtherStampsStayAsTheyAre)
{
  std::vector<double> even, rare, trembling, growing, with_gaps;
  for (unsigned int i = 0; i < 200; ++i)
    {
      even.push_back(3e-3 * i);
      rare.push_back(1e-3 * std::round(1e3 * i / 3.)); // 333 and 334 ms
      trembling.push_back(1e-3 * (7. * i + (i * i * 7) % 5));
      growing.push_back(1e-3 * (i + i * i));
      if (i % 7 != 3)
        with_gaps.push_back(i);
    }
  for (const auto &time : {even, rare, trembling, growing, with_gaps})
    EXPECT_EQ(rounding_of_time(time), 0.) << time[1];
}



TEST(RoundedMotion, IsSeenInItsStairs)
{
  for (const double interval : {0.02, 0.1, 0.3})
    {
      const Record record(interval);
      EXPECT_NEAR(rounding_of_motion(record.rounded), step, 1e-9) << interval;
      EXPECT_EQ(rounding_of_motion(record.exact), 0.) << interval;
    }
  // Rows so far apart that it makes no stairs.
  std::vector<double> fast;
  for (unsigned int i = 0; i < 200; ++i)
    fast.push_back(step * std::round(0.0537 * i / step));
  EXPECT_EQ(rounding_of_motion(fast), 0.);
  EXPECT_EQ(rounding_of_motion(std::vector<double>()), 0.);
  EXPECT_EQ(rounding_of_motion(std::vector<double>(3, 1.)), 0.);
}



// Strokes between rests, each passed within a row.
TEST(RoundedMotion, IsNotSeenInStrokes)
{
  std::vector<double> strokes;
  for (unsigned int i = 0; i < 15; ++i)
    strokes.insert(strokes.end(), 10, 0.5 * i);
  EXPECT_EQ(rounding_of_motion(strokes), 0.);
  for (double &value : strokes)
    value *= value;
  EXPECT_EQ(rounding_of_motion(strokes), 0.);
}



// Ten times nearer to the motion than the record is where stairs have ten rows;
// rests stay rests, and a turn stays within half a step.
TEST(RoundedMotion, IsEvenBetweenStairs)
{
  const Record              record(0.05);
  const std::vector<double> even =
    without_stairs(record.time, record.rounded, step);
  EXPECT_LE(largest_difference(even, record.rounded), 0.5 * step + 1e-12);
  for (std::size_t i = 0; record.time[i] < 35.; ++i)
    {
      const double t = record.time[i];
      const bool   is_corner =
        std::min(std::abs(t - 5.), std::abs(t - 25.)) < 0.6;
      EXPECT_NEAR(even[i], record.exact[i], (is_corner ? 0.25 : 0.12) * step)
        << t;
    }
  for (const double t : {1., 4., 30.})
    EXPECT_NEAR(even[static_cast<std::size_t>(t / 0.05)], place_at(t), 1e-12);
}



TEST(RoundedMotion, IsTold)
{
  const Record record(0.05);
  MeasuredTest test;
  test.file         = "coarse.csv";
  test.time         = record.time;
  test.displacement = record.rounded;
  EXPECT_NEAR(rounding_of_motion(test), step, 1e-9);
  undo_rounding_of_motion(test);
  ASSERT_EQ(test.warnings.size(), 1u);
  EXPECT_TRUE(contains(test.warnings[0], "rounded to 0.01 mm"));

  test.displacement = record.exact;
  test.warnings.clear();
  EXPECT_EQ(rounding_of_motion(test), 0.);
  undo_rounding_of_motion(test);
  EXPECT_EQ(test.displacement, record.exact);
  EXPECT_TRUE(test.warnings.empty());
}



// A slide at 30 degrees: the stairs of its axes end at different times, but its
// direction is that of the line. One that turns off is on no line.
TEST(RoundedMotion, KeepsTheDirectionOfALine)
{
  for (const bool turns_off : {false, true})
    {
      const Record record(0.1);
      MeasuredTest test;
      test.time             = record.time;
      std::vector<double> x = record.exact, y(record.exact.size());
      for (std::size_t i = 0; i < x.size(); ++i)
        {
          y[i] = x[i] * std::tan(0.5);
          if (turns_off && test.time[i] > 45.)
            y[i] = 2.4 * std::tan(0.5);
          test.displacement.push_back(step * std::round(x[i] / step));
          test.displacement_y.push_back(step * std::round(y[i] / step));
        }
      undo_rounding_of_motion(test);
      double farthest = 0.;
      for (std::size_t i = 1; i < x.size() && test.time[i] < 45.; ++i)
        {
          const double dx = test.displacement[i] - test.displacement[i - 1];
          const double dy = test.displacement_y[i] - test.displacement_y[i - 1];
          if (std::hypot(dx, dy) > 1e-4)
            farthest = std::max(farthest, std::abs(std::atan2(dy, dx) - 0.5));
        }
      EXPECT_EQ(farthest < 0.02, !turns_off) << farthest;
      EXPECT_LT(largest_difference(test.displacement, x), step);
      EXPECT_LT(largest_difference(test.displacement_y, y), step);
    }
}



// One slide is one, although its rows are a hundred times farther from each
// other in the end than where it begins.
TEST(RoundedMotion, IsOneSlide)
{
  constexpr double    speed = 0.21;
  std::vector<double> time, rounded;
  for (double t = 0.; t < 119.; t += t < 0.3 ? 0.0085 : 0.905)
    {
      time.push_back(t);
      rounded.push_back(step * std::round(speed * t / step));
    }
  const std::vector<double> found = without_stairs(time, rounded, step);
  unsigned int              n_off = 0;
  for (std::size_t i = 1; i < time.size(); ++i)
    n_off += std::abs((found[i] - found[i - 1]) / (time[i] - time[i - 1]) -
                      speed) > 0.05 * speed;
  // Of 167; the slide is put together from a few pieces.
  EXPECT_LE(n_off, 8u);
}



// Where it turns, the motion does not come to rest; and it may begin within a
// stair.
TEST(RoundedMotion, TurnsWithoutRest)
{
  constexpr double speed = 0.02, interval = 0.1;
  for (const double turn : {0.999, 1.001, 1.003, 1.0045})
    {
      std::vector<double> time, exact, rounded;
      for (double t = 0.; t < 2. * turn / speed; t += interval)
        {
          time.push_back(t);
          exact.push_back(turn - std::abs(turn - speed * t));
          rounded.push_back(step * std::round(exact.back() / step));
        }
      const std::vector<double> found = without_stairs(time, rounded, step);
      EXPECT_LT(largest_difference(found, exact), 0.2 * step) << turn;
    }
}



// Of a slide at one speed the speed is the same in all of its rows, which are
// close at its beginning, and a rest is one.
TEST(RoundedMotion, IsAsEvenAsItWas)
{
  const std::vector<std::array<double, 2>> slides = {
    {{0.1, 6.}}, {{0., 20.}}, {{0.1, 5.}}, {{1., 3.}}, {{-0.3, 7.}}};
  std::vector<double> time, exact, rounded;
  double              begin = 0., place = 0.0013;
  for (const auto &[speed, duration] : slides)
    {
      for (unsigned int row = 0; row < 60; ++row)
        {
          const double t = duration * std::pow(row / 60., 2);
          time.push_back(begin + t);
          exact.push_back(place + speed * t);
          rounded.push_back(step * std::round(exact.back() / step));
        }
      begin += duration;
      place += speed * duration;
    }
  const std::vector<double> found = without_stairs(time, rounded, step);
  EXPECT_LT(largest_difference(found, exact), 0.6 * step);
  for (std::size_t s = 0; s < slides.size(); ++s)
    // Where it begins within a stair nobody knows when.
    for (std::size_t i = 60 * s + 15; i < 60 * s + 58; ++i)
      EXPECT_NEAR((found[i + 1] - found[i]) / (time[i + 1] - time[i]),
                  slides[s][0],
                  0.04 * std::abs(slides[s][0]))
        << "row " << i;
}



// Rows farther from each other than the step, but for two of the same value,
// where the contact would stick.
TEST(RoundedMotion, IsThatOfOtherRecords)
{
  MeasuredTest test;
  for (unsigned int i = 0; i < 40; ++i)
    {
      test.time.push_back(0.1 * i);
      test.displacement.push_back(step * std::round(0.0091 * i / step));
    }
  EXPECT_EQ(rounding_of_motion(test), 0.);
  EXPECT_EQ(rounding_of_motion(test, step), step);
  EXPECT_EQ(rounding_of_motion(test, 0.003), 0.);
  undo_rounding_of_motion(test, step);
  EXPECT_EQ(test.warnings.size(), 1);
  for (unsigned int i = 1; i < 39; ++i)
    EXPECT_GT(test.displacement[i] - test.displacement[i - 1], 0.0025) << i;
}
