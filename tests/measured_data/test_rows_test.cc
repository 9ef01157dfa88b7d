// SPDX-License-Identifier: LGPL-2.1-or-later

// What is done to the rows of a test as recorded, and what is refused.

#include <slipstep/measured_data/measured_test.h>
#include <slipstep/measured_data/odd_rows.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/measured_data/tidy_rows.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "tests/file_text.h"
#include "tests/message_of.h"
#include "tests/rows_header.h"
#include "tests/temporary_folder.h"

using namespace SlipStep;

namespace
{
  MeasuredTest read(const std::string &rows)
  {
    const auto file = test_folder() / "rows.csv";
    std::ofstream(file, std::ios::binary) << header << rows;
    return read_measured_test(file);
  }

  std::string message_about_rows(const std::string &rows)
  {
    const std::string text = message_of([&] { read(rows); });
    return text.empty() ? "" : text.substr(text.find("rows.csv") + 8);
  }

  void expect_warning(const MeasuredTest &test, const std::string &words)
  {
    ASSERT_EQ(test.warnings.size(), 1u);
    EXPECT_TRUE(contains(test.warnings[0], words));
  }
} // namespace



TEST(TestRows, RowsWithGapsAreLeftOutAndCounted)
{
  const MeasuredTest test =
    read("0,0,1,0\n1,1,,0.1\n2,2,1,NaN\n3,n/a,1,0.1\n4,4,1,0.1\n");
  EXPECT_EQ(test.time, std::vector<double>({0., 4.}));
  expect_warning(test, "without a value, left out: 3 (first: line 3)");
}



TEST(TestRows, NewestFirstIsTurnedRound)
{
  const MeasuredTest test = read("3,3,1,0.3\n2,2,1,0.2\n0,0,1,0\n");
  EXPECT_EQ(test.time, std::vector<double>({0., 2., 3.}));
  EXPECT_EQ(test.friction, std::vector<double>({0., 0.2, 0.3}));
  expect_warning(test, "newest first");
}



TEST(TestRows, AFewRowsOutOfOrderAreSorted)
{
  const MeasuredTest test =
    read("0,0,1,0\n1,1,1,0.1\n1.05,3,1,0.3\n1.02,2,1,0.2\n10,4,1,0.4\n");
  EXPECT_EQ(test.friction, std::vector<double>({0., 0.1, 0.2, 0.3, 0.4}));
  expect_warning(test, "order of time, sorted: 1 (first: line 5)");
}



TEST(TestRows, RepeatedTimesAreAveraged)
{
  const MeasuredTest test =
    read("0,0,1,0\n1,1,1,0.1\n1,3,1,0.3\n2,4,1,0.4\n2,4,1,0.4\n2,4,1,0.4\n");
  EXPECT_EQ(test.time, std::vector<double>({0., 1., 2.}));
  EXPECT_EQ(test.displacement, std::vector<double>({0., 2., 4.}));
  expect_warning(test,
                 "averaged: 3; their friction differs by up to 0.2 "
                 "(first: line 4)");
}



TEST(TestRows, TimeThatGoesBackIsRefused)
{
  const std::string text =
    message_about_rows("0,0,1,0\n1,1,1,0.1\n2,1,1,0.1\n0,2,1,0.1\n1,3,1,0.1\n");
  EXPECT_EQ(text.substr(0, 6), ":5:1: ") << text;
  EXPECT_TRUE(contains(text, "0 s follows 2 s"));
}



TEST(TestRows, PressureIsPositiveWhereThereIsFriction)
{
  EXPECT_EQ(message_about_rows("0,0,0,0\n1,0,1,0\n2,1,1,0.1\n"), "");
  EXPECT_EQ(message_about_rows("0,0,0,0\n1,1,0,0.1\n2,1,1,0.1\n").substr(0, 6),
            ":3:5: ");
  EXPECT_EQ(message_about_rows("0,0,1,0\n1,1,-2,0.1\n").substr(0, 6), ":3:5: ");
  EXPECT_TRUE(
    contains(message_about_rows("0,0,0,0\n1,1,0,0\n"), "zero throughout"));
}



TEST(TestRows, AWrongSignIsAskedNotGuessed)
{
  std::string                      back_and_forth, wrong;
  std::mt19937                     random(1);
  std::normal_distribution<double> noise;
  for (int i = 0; i < 2000; ++i)
    {
      const double phase = 0.01 * i;
      // The position trembles more between two rows than it moves.
      const std::string row =
        std::to_string(i) + ',' +
        std::to_string(std::sin(phase) + 0.02 * noise(random)) + ",1,";
      const double friction = 0.3 * std::tanh(5. * std::cos(phase));
      back_and_forth += row + std::to_string(friction) + '\n';
      wrong += row + std::to_string(-friction) + '\n';
    }
  EXPECT_EQ(message_about_rows(back_and_forth), "");
  const std::string text = message_about_rows(wrong);
  EXPECT_EQ(text.substr(0, 3), ":2:") << text;
  EXPECT_TRUE(contains(text, "slipstep import"));
}



// Of two sensors one may be wired the other way round.
TEST(TestRows, FrictionThatDrivesAlongOneAxisIsTold)
{
  const auto warnings = [](const double sign_x, const double sign_y) {
    const auto file = test_folder() / "two_axes.csv";
    {
      std::ofstream out(file);
      out << "time_s,displacement_mm,displacement_y_mm,pressure_MPa,friction,"
             "friction_y\n";
      for (int i = 0; i < 100; ++i)
        {
          const double way = i < 50 ? i : 100 - i, f = i < 50 ? 0.2 : -0.2;
          out << i << ',' << 0.08 * way << ',' << 0.04 * way << ",5,"
              << sign_x * 0.89 * f << ',' << sign_y * 0.45 * f << '\n';
        }
    }
    std::string all;
    for (const std::string &warning : read_measured_test(file).warnings)
      all += warning;
    return all;
  };
  EXPECT_EQ(warnings(1., 1.), "");
  EXPECT_TRUE(contains(warnings(1., -1.),
                       "friction along y drives the motion instead of"));
  EXPECT_TRUE(contains(warnings(-0.2, 1.),
                       "friction along x drives the motion instead of"));
}



// Friction forth and back over a way that only grows.
TEST(TestRows, FrictionThatDrivesHalfTheTimeIsTold)
{
  std::string rows;
  for (int i = 0; i < 200; ++i)
    rows += std::to_string(i) + ',' + std::to_string(0.1 * i) + ",5," +
            (i / 50 % 2 == 0 ? "0.1" : "-0.1") + '\n';
  expect_warning(read(rows), "drives the motion in 50 %");

  // A spring gives its work back.
  rows = "";
  for (int i = 0; i < 200; ++i)
    {
      const double place = 1e-3 * std::sin(0.1 * i);
      rows += std::to_string(i) + ',' + std::to_string(place) + ",5," +
              std::to_string(100. * place + 1e-4 * std::cos(0.1 * i)) + '\n';
    }
  EXPECT_TRUE(read(rows).warnings.empty());
}



// The rows of an elastic ramp are whole steps apart, too.
TEST(TestRows, AStepIsThatOfRoundingAndNotOfARamp)
{
  std::vector<double> cycles, stairs;
  double              friction = 0., motion = 0.25;
  for (int row = 0; row < 80; ++row)
    {
      cycles.push_back(friction);
      if (row % 20 == 19)
        motion = -motion;
      friction = std::clamp(friction + motion, -1., 1.);
      stairs.push_back(0.1 * std::round(0.02 * row / 0.1));
    }
  EXPECT_EQ(coarse_step(cycles), 0.);
  EXPECT_NEAR(coarse_step(stairs), 0.1, 1e-12);

  std::mt19937                     random(4);
  std::normal_distribution<double> noise(0., 0.04);
  for (double &value : cycles)
    value = 0.1 * std::round((value + noise(random)) / 0.1);
  EXPECT_NEAR(coarse_step(cycles), 0.1, 1e-12);
  for (double &value : cycles)
    value += noise(random);
  EXPECT_EQ(coarse_step(cycles), 0.);
}



TEST(TestRows, NoiseIsMeasuredUnderASignal)
{
  std::mt19937                     random(2);
  std::normal_distribution<double> noise(0., 0.003);
  std::vector<double>              values, rounded, rising;
  const auto                       round = [](const double value) {
    return 0.01 * std::round(value / 0.01);
  };
  for (int i = 0; i < 5000; ++i)
    {
      const double signal = 0.1 + 0.05 * std::exp(-i / 800.);
      values.push_back(signal + noise(random));
      rounded.push_back(round(values.back()));
      rising.push_back(round(0.1 + 1e-5 * i + noise(random)));
    }
  EXPECT_NEAR(noise_level(values), 0.003, 0.0002);
  EXPECT_NEAR(noise_level(rounded), 0.01 / std::sqrt(12.), 1e-6);
  EXPECT_EQ(noise_level({1., 1., 1.}), 0.);
  EXPECT_NEAR(coarse_step(rounded), 0.01, 1e-12);
  EXPECT_EQ(coarse_step(values), 0.);
  // By 0.3 steps they scatter too little for means to be right: 17 % of what
  // rounding does to them by itself is left, all of it without any scatter.
  const Rounding rounding = rounding_to(0.01, rising);
  EXPECT_EQ(rounding.step, 0.01);
  EXPECT_NEAR(rounding.kept, std::exp(-2. * std::pow(M_PI * 0.3, 2)), 0.05);
  EXPECT_EQ(rounding_to(0.01, std::vector<double>(100, 0.13)).kept, 1.);
  EXPECT_EQ(rounding_to(0.002, values).step, 0.);
  // Ramps and jumps between constants are no noise.
  std::vector<double> clean(1000, 5.);
  for (unsigned int i = 100; i < 1000; ++i)
    clean[i] = i < 120 ? 5. + 0.1 * (i - 100) :
               i < 500 ? 7. :
               i < 800 ? 6.5 :
                         7.;
  EXPECT_EQ(noise_level(clean), 0.);
}



namespace
{
  // Constant but for ramps, each passed in some rows with rests between.
  std::vector<double> ladder(const std::vector<double> &levels,
                             const unsigned int         n_rows,
                             const unsigned int         n_steps,
                             const unsigned int         n_rest)
  {
    std::vector<double> values(n_rows, levels.front());
    for (std::size_t l = 1; l < levels.size(); ++l)
      {
        for (unsigned int s = 1; s <= n_steps; ++s)
          values.insert(values.end(),
                        s < n_steps ? n_rest : n_rows,
                        levels[l - 1] +
                          (levels[l] - levels[l - 1]) * s / n_steps);
      }
    return values;
  }
} // namespace



// A pressure that a controller leads in few steps is no rounded one.
TEST(TestRows, CleanRampsAreNoRounding)
{
  const std::vector<double> levels = {
    4., 7.1, 10.2, 13.3, 10.2, 7.1, 4., 7.1, 10.2};
  for (const unsigned int n_steps : {1, 2, 5, 12})
    for (const unsigned int n_rest : {2, 3})
      EXPECT_EQ(noise_level(ladder(levels, 40, n_steps, n_rest)), 0.)
        << n_steps << ", " << n_rest;
  // One step as wide as another, up and down, for long.
  EXPECT_EQ(noise_level(
              ladder({5., 5.4, 5., 5.4, 5., 5.4, 5., 5.4, 5.4, 5.}, 15, 1, 1)),
            0.);
}



TEST(TestRows, RoundedValuesAreKnownByTheirSteps)
{
  const auto rounded = [](const double size, const auto &value) {
    std::vector<double> values;
    for (int i = 0; i < 2000; ++i)
      values.push_back(size * std::round(value(i) / size));
    return values;
  };
  std::mt19937                     random(5);
  std::normal_distribution<double> noise(0., 0.2);
  // An even motion: stairs.
  EXPECT_NEAR(noise_level(rounded(0.02, [](int i) { return 5e-4 * i; })),
              0.02 / std::sqrt(12.),
              1e-12);
  // A pressure that trembles between digits.
  EXPECT_NEAR(noise_level(
                rounded(0.5, [&](int) { return 5.6 + noise(random) / 2.; })),
              0.5 / std::sqrt(12.),
              1e-12);
  // A slow drift, recorded finely.
  EXPECT_NEAR(noise_level(rounded(
                0.01, [](int i) { return 5. + 0.1 * std::sin(i / 300.); })),
              0.01 / std::sqrt(12.),
              1e-12);
}



// A wave that bends within few rows is signal.
TEST(TestRows, ACleanWaveIsNoNoise)
{
  std::mt19937                     random(6);
  std::normal_distribution<double> noise(0., 0.01);
  std::vector<double>              clean, noisy;
  for (int i = 0; i < 600; ++i)
    {
      clean.push_back(7. + 2. * std::sin(0.2 * i));
      noisy.push_back(clean.back() + noise(random));
    }
  EXPECT_LT(noise_level(clean), 1e-3);
  EXPECT_NEAR(noise_level(noisy), 0.01, 0.002);
}



// A wrong unit is nothing that a program can be sure of.
TEST(TestRows, ScalesOfNoLaboratoryAreWarnedOf)
{
  const auto slide = [](const double mm, const double MPa, const double mu) {
    std::string rows;
    for (int i = 0; i <= 40; ++i)
      rows += std::to_string(i) + "," + std::to_string(mm * i) + "," +
              std::to_string(MPa) + "," + std::to_string(i == 0 ? 0. : mu) +
              "\n";
    return read(rows);
  };
  for (const double mm : {1e-4, 0.1, 1e5})
    for (const double MPa : {1e-3, 5., 2e3})
      for (const double mu : {0.02, 0.3, 1.9})
        EXPECT_TRUE(slide(mm, MPa, mu).warnings.empty()) << mm << " " << MPa;
  expect_warning(slide(0.1, 5., 30.),
                 "friction reaches 30 of the pressure: is it a force");
  // 5 MPa in kPa.
  expect_warning(slide(0.1, 5e3, 0.3), "the pressure is 5000 MPa");
  expect_warning(slide(1e8, 5., 0.3), "it moves at 1e+08 mm/s");
  // 20 degrees Celsius read as Kelvin.
  for (const double temperature : {-253., 20., 293.})
    {
      MeasuredTest test = slide(0.1, 5., 0.3);
      test.temperature.assign(test.time.size(), temperature);
      std::string all;
      warn_of_odd_rows(test, [&](const std::string &text, const std::size_t) {
        all += text;
      });
      EXPECT_EQ(all,
                temperature < 0. ?
                  "the temperature is -253 degC: is its unit right?" :
                  "");
    }
  // At rest nothing is slow, and one open row is no scale.
  EXPECT_TRUE(slide(0., 5., 0.3).warnings.empty());
  std::string rows = "0,0,1e-3,90\n";
  for (int i = 1; i <= 40; ++i)
    rows += std::to_string(i) + "," + std::to_string(i) + ",5,0.2\n";
  const MeasuredTest opens = read(rows);
  ASSERT_EQ(opens.warnings.size(), 1u);
  expect_warning(opens, "noise over noise");
}



// A counter of 1.024 mm, read while it moves by 0.01 mm per row; a stroke that
// turns, jitter at rest and a step between two rests are no such thing.
TEST(TestRows, ACounterThatWrapsIsTold)
{
  const auto record = [](const std::function<double(int)> &displacement,
                         const int                         turns = 1000) {
    std::string rows;
    for (int i = 0; i <= 200; ++i)
      rows += std::to_string(0.1 * i) + "," + std::to_string(displacement(i)) +
              (i > turns ? ",5,-0.2\n" : ",5,0.2\n");
    return read(rows);
  };
  expect_warning(record([](const int i) {
                   return 0.01 * i - (i > 102 ? 1.024 : 0.);
                 }),
                 "jumps by -1.01 mm within one row, against the motion");
  // But for the jumps it is driven, which is told, too.
  const MeasuredTest driven =
    record([](const int i) { return -std::fmod(0.01 * i, 0.512) + 0.512; });
  ASSERT_EQ(driven.warnings.size(), 2u);
  EXPECT_TRUE(
    contains(driven.warnings[0] + driven.warnings[1], "Such rows: 3"));
  const auto has_jump = [](const MeasuredTest &test) {
    for (const std::string &warning : test.warnings)
      if (warning.find("jumps") != std::string::npos)
        return true;
    return false;
  };
  EXPECT_FALSE(has_jump(record(
    [](const int i) {
      return 0.01 * std::min(i, 100) - 0.01 * std::max(0, i - 150);
    },
    150)));
  EXPECT_FALSE(has_jump(record([](const int i) { return i > 100 ? 1. : 0.; })));
  std::mt19937 random(1);
  EXPECT_FALSE(has_jump(record([&](const int i) {
    return 0.002 * i + 1e-3 * std::normal_distribution<double>(0., 1.)(random);
  })));
}



namespace
{
  // 250 rows of sliding, some of them changed.
  MeasuredTest slide_with(const std::function<void(int, double (&)[4])> &change)
  {
    std::string rows;
    for (int i = 0; i < 250; ++i)
      {
        double row[4] = {0.1 * i, 0.01 * i, 5., i == 0 ? 0. : 0.15};
        change(i, row);
        for (int k = 0; k < 4; ++k)
          rows += std::to_string(row[k]) + (k < 3 ? "," : "\n");
      }
    return read(rows);
  }
} // namespace



// Strokes forth and back without a sign, or with a zero larger than friction;
// but elastic contacts under a load that pulsates.
TEST(TestRows, FrictionWithoutASignIsRefused)
{
  using Friction    = std::function<double(double, double)>;
  const auto record = [](const Friction &friction, const double track) {
    std::string rows;
    for (int i = 0; i <= 400; ++i)
      {
        const int    phase = i % 200;
        const double place = (phase < 100 ? phase : 200 - phase) / 100.;
        rows += std::to_string(0.1 * i) + "," + std::to_string(track * place) +
                ",5," +
                std::to_string(friction(place, phase < 100 ? 1. : -1.)) + "\n";
      }
    return message_about_rows(rows);
  };
  const auto sliding = [](const double zero, const double size) {
    return [=](const double, const double way) { return zero + size * way; };
  };
  EXPECT_TRUE(
    contains(record(sliding(0.12, 0.), 10.),
             "the same sign forth and back, 0.12 and 0.12 on the average"));
  EXPECT_TRUE(
    contains(record(sliding(0.2, 0.12), 10.), "a zero of the sensor"));
  EXPECT_EQ(record(sliding(0., 0.12), 10.), "");
  EXPECT_EQ(record(sliding(0.1, 0.12), 10.), "");
  EXPECT_EQ(record([](const double place,
                      const double) { return 0.18 + 0.04 * place; },
                   0.01),
            "");
}



// Before the load is on, friction is one noise over another. Adhesion holds
// more of it, too, but smoothly.
TEST(TestRows, RowsWithoutLoadAreTold)
{
  std::mt19937_64            random(3);
  std::normal_distribution<> noise(0., 5e-3);
  for (const int n : {1, 12})
    {
      const MeasuredTest test = slide_with([&](const int i, double(&row)[4]) {
        if (i >= n)
          return;
        const double force = noise(random);
        row[2]             = std::abs(noise(random));
        row[3]             = force / row[2] + (i == 0 ? 9. : 0.);
      });
      EXPECT_EQ(rows_without_load(test).size(), std::size_t(n));
      expect_warning(test, "noise over noise");
      expect_warning(test, "there are " + std::to_string(n));
    }
  const MeasuredTest adhesive = slide_with([](const int i, double(&row)[4]) {
    if (i < 40)
      row[2] *= 0.001 * (1. + i);
    row[3] = 0.15 + 0.02 / row[2];
  });
  EXPECT_TRUE(rows_without_load(adhesive).empty());
}



// Of 250 rows one holds an error code: no sign is wrong, and no scale.
TEST(TestRows, StrayRowsAreTold)
{
  for (const double code : {-999., 9.99, -9.99})
    {
      const MeasuredTest test = slide_with([&](const int i, double(&row)[4]) {
        if (i == 120)
          row[3] = code;
      });
      ASSERT_EQ(test.warnings.size(), 1U) << code;
      expect_warning(test, "far from the other rows: an error code");
      expect_warning(test, "first: line 122");
    }
  expect_warning(slide_with([](const int i, double(&row)[4]) {
                   if (i == 120)
                     row[2] = 9999.;
                 }),
                 "the pressure goes to 9999 MPa there and back");
}



// A clock that jumps reads as slow sliding; a rest that is recorded does not,
// nor do rows that are missing while it slides on.
TEST(TestRows, PausesWithoutRowsAreTold)
{
  const auto paused = [](const double seconds, const double mm) {
    return slide_with([=](const int i, double(&row)[4]) {
      row[0] += i > 125 ? seconds : 0.;
      row[1] += i > 125 ? mm : 0.;
    });
  };
  expect_warning(paused(1000., 0.), "time goes on by 1000 s within one row");
  expect_warning(paused(10., 0.), "changes by 0.01 mm");
  EXPECT_TRUE(paused(10., 1.).warnings.empty());
  EXPECT_TRUE(paused(1000., -0.01).warnings.empty());
}



// A sensor that ends at 0.155 while friction scatters; what is smooth, or
// recorded in steps, has no limit.
TEST(TestRows, ASensorAtItsLimitIsTold)
{
  std::mt19937                     random(8);
  std::normal_distribution<double> noise(0., 0.005);
  const auto                       clipped = [&](const double limit) {
    return slide_with([&](const int i, double(&row)[4]) {
      if (i > 0)
        row[3] = std::min(limit, 0.15 + noise(random));
    });
  };
  expect_warning(clipped(0.155), "friction is exactly 0.155 in ");
  EXPECT_TRUE(clipped(1.).warnings.empty());
  EXPECT_TRUE(slide_with([&](const int i, double(&row)[4]) {
                row[3] = i < 100 ? 0.0015 * i : 0.15;
              }).warnings.empty());
  EXPECT_TRUE(slide_with([&](const int i, double(&row)[4]) {
                if (i > 0)
                  row[3] = 0.005 * std::round(30. + noise(random) / 0.005);
              }).warnings.empty());
}



// Of a slide across, friction along the first axis is noise about nothing.
TEST(TestRows, NoiseAcrossTheMotionIsNoExcursion)
{
  std::mt19937                     random(3);
  std::normal_distribution<double> noise(0., 1.3e-3);
  for (unsigned int n = 0; n < 20; ++n)
    {
      const auto    file = test_folder() / "across.csv";
      std::ofstream out(file);
      out << "time_s,displacement_mm,pressure_MPa,friction,displacement_y_mm,"
             "friction_y\n";
      for (int i = 0; i < 20; ++i)
        out << i << ",0,5," << noise(random) << ',' << 0.5 * i << ','
            << (i == 0 ? 0. : 0.13) + noise(random) << '\n';
      out.close();
      for (const std::string &warning : read_measured_test(file).warnings)
        EXPECT_FALSE(contains(warning, "there and back")) << warning;
    }
}



// Codes of errors in what leads the contact; where it turns round or goes on at
// another pressure, nothing is odd.
TEST(TestRows, RowsThatComeBackAtOnceAreTold)
{
  std::mt19937                     random(10);
  std::normal_distribution<double> noise(0., 1e-3);
  const auto changed = [&](const int column, const int n, const double value) {
    return slide_with([&](const int i, double(&row)[4]) {
      row[3] += noise(random);
      if (i >= 120 && i < 120 + n)
        row[column] = value;
    });
  };
  expect_warning(changed(1, 1, -9999.), "displacement goes to -9999 mm there");
  expect_warning(changed(1, 4, 0.), "Such rows: 4 (first: line 122)");
  expect_warning(changed(2, 1, 1e-4), "the pressure goes to 1e-04 MPa there");
  expect_warning(changed(2, 2, 327.), "the pressure goes to 327 MPa there");
  expect_warning(changed(3, 3, 0.), "friction goes to 0 there and back");
  EXPECT_TRUE(changed(2, 60, 1.).warnings.empty());
  // Before it is pressed: noise over noise, or nothing, over a load of noise.
  for (const bool is_zero : {false, true})
    {
      const MeasuredTest test = slide_with([&](const int i, double(&row)[4]) {
        row[3] += noise(random);
        if (i >= 40)
          return;
        row[2] = 0.002 + std::abs(noise(random));
        row[3] = is_zero ? 0. : 100. * noise(random);
      });
      EXPECT_EQ(test.warnings.size(), is_zero ? 0u : 1u);
      EXPECT_EQ(rows_without_load(test).size(), is_zero ? 0u : 40u);
    }
  // Of few rows, which move along x half of the time.
  std::string rows;
  for (int i = 0; i < 70; ++i)
    rows += std::to_string(i) + "," +
            (i == 20 ? "-999" : std::to_string(0.05 * std::min(i, 35))) +
            ",5,0.15\n";
  expect_warning(read(rows), "displacement goes to -999 mm there and back");
  // A rest of two rows, after which friction peaks; strokes of few rows.
  EXPECT_TRUE(slide_with([&](const int i, double(&row)[4]) {
                row[3] += noise(random) + (i == 120 ? 0.08 : 0.);
              }).warnings.empty());
  EXPECT_TRUE(slide_with([&](const int i, double(&row)[4]) {
                const bool is_back = i >= 120 && i < 124;
                row[1] = 0.01 * (i < 120 ? i : is_back ? 238 - i : i - 8);
                row[3] = (is_back ? -0.15 : 0.15) + noise(random);
              }).warnings.empty());
  EXPECT_TRUE(slide_with([&](const int i, double(&row)[4]) {
                row[1] = 0.01 * std::abs(i - 125);
                row[3] = (i < 125 ? -0.15 : 0.15) + noise(random);
              }).warnings.empty());
}



TEST(TestRows, OneBadRowDoesNotTurnTheSignOfFriction)
{
  std::vector<double> displacement, friction(100, 0.1);
  for (int i = 0; i < 100; ++i)
    displacement.push_back(0.1 * i);
  EXPECT_DOUBLE_EQ(share_of_resistance(displacement, friction), 1.);
  friction[50] = -9999.;
  EXPECT_GT(share_of_resistance(displacement, friction), 0.9);
}



// A channel that stays on its last value; before it is pressed it may.
TEST(TestRows, ADeadSensorIsTold)
{
  std::mt19937                     random(9);
  std::normal_distribution<double> noise(0., 0.005);
  const auto stuck = [&](const int column, const int begin, const int end) {
    double last = 0.;
    return slide_with([&](const int i, double(&row)[4]) {
      row[3] = 0.15 + noise(random);
      row[2] *= 1. + noise(random);
      if (i < begin || i >= end)
        last = row[column];
      row[column] = i < begin || i >= end ? row[column] : last;
      if (column == 3 && begin == 0 && i < end)
        row[2] = row[3] = 0.;
    });
  };
  expect_warning(stuck(3, 40, 70), "friction is exactly ");
  expect_warning(stuck(2, 60, 200), "pressure is exactly ");
  EXPECT_TRUE(stuck(3, 60, 66).warnings.empty());
  EXPECT_TRUE(stuck(3, 0, 30).warnings.empty());
}
