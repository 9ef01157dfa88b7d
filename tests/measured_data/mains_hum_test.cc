// SPDX-License-Identifier: LGPL-2.1-or-later

// The hum of the mains in what a model leaves of records, which it must not be
// found in without it: neither by chance, nor in waves of the track.

#include <slipstep/measured_data/mains_hum.h>

#include <boost/math/constants/constants.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

using namespace SlipStep;

namespace
{
  using Random = std::mt19937_64;

  constexpr double two_pi = boost::math::constants::two_pi<double>();

  double uniform(Random &random, const double lower, const double upper)
  {
    return std::uniform_real_distribution<double>(lower, upper)(random);
  }

  // Replicates of some conditions, which last from 10 s to an hour: white noise
  // of 1 and a drift of 0.5, and a smooth remainder of an effect that is
  // missing in the model.
  std::vector<HumSeries>
  records(Random &random, const std::size_t n, const double remainder)
  {
    std::normal_distribution<double> normal;
    std::vector<HumSeries>           result;
    double                           duration = 10.;
    std::size_t                      n_rows   = 200;
    for (std::size_t r = 0; r < n; ++r)
      {
        if (r % 2 == 0)
          {
            duration =
              std::exp(uniform(random, std::log(10.), std::log(3600.)));
            n_rows = static_cast<std::size_t>(uniform(random, 140., 400.));
          }
        HumSeries    one;
        double       drift = normal(random);
        const double kept  = std::exp(-1. / (0.1 * n_rows));
        for (std::size_t i = 0; i < n_rows; ++i)
          {
            const double share = static_cast<double>(i) / (n_rows - 1);
            drift = kept * drift + std::sqrt(1. - kept * kept) * normal(random);
            one.time.push_back(share * duration);
            one.left.push_back(normal(random) + 0.5 * drift +
                               remainder * std::exp(-share / 0.1) +
                               remainder * (share > 0.6));
          }
        one.speed = 10. / duration;
        result.push_back(one);
      }
    return result;
  }

  // Strokes forth and back, which a model misses by a share.
  std::vector<HumSeries> strokes(Random      &random,
                                 const double frequency,
                                 const double rate,
                                 const double duration,
                                 const double share)
  {
    std::normal_distribution<double> normal;
    HumSeries                        one;
    one.speed       = frequency;
    const auto rows = static_cast<std::size_t>(duration * rate);
    for (std::size_t i = 0; i < rows; ++i)
      {
        const double time = i / rate;
        one.time.push_back(time);
        one.friction.push_back(std::sin(two_pi * frequency * time) > 0. ? 20. :
                                                                          -20.);
        one.left.push_back(normal(random) + share * one.friction.back());
      }
    return {one};
  }

  // Frequency of what is at one speed alone.
  double at_one_speed = 0.;

  std::vector<HumSeries> differences_of(const std::vector<HumSeries> &series)
  {
    std::vector<HumSeries> differences;
    for (std::size_t r = 0; r < series.size(); r += 2)
      {
        differences.push_back(series[r]);
        for (std::size_t i = 0; i < series[r].left.size(); ++i)
          differences.back().left[i] -= series[r + 1].left[i];
      }
    return differences;
  }

  // Of the strokes of one speed the waves are the same.
  void add_track_waves(Random                 &random,
                       std::vector<HumSeries> &series,
                       const double            amplitude)
  {
    const double n_waves = uniform(random, 4., 30.);
    for (HumSeries &one : series)
      for (std::size_t i = 0; i < one.time.size(); ++i)
        one.left[i] += amplitude * std::sin(two_pi * n_waves * one.time[i] /
                                            one.time.back());
  }

  void add_hum(Random                 &random,
               std::vector<HumSeries> &series,
               const double            frequency,
               const double            amplitude)
  {
    for (HumSeries &one : series)
      {
        const double phase = uniform(random, 0., two_pi);
        for (std::size_t i = 0; i < one.time.size(); ++i)
          one.left[i] +=
            amplitude * std::cos(two_pi * frequency * one.time[i] + phase);
      }
  }
} // namespace



// Of every wave most is taken off, whose amplitude scatters by a tenth in such
// noise; where it is as slow as the remainder it need not be told.
TEST(MainsHum, IsFoundByItsFrequency)
{
  Random random(1);
  for (const double frequency : {50., 60., 49.9998})
    for (const double remainder : {0., 5.})
      {
        std::vector<HumSeries>       with    = records(random, 20, remainder);
        const std::vector<HumSeries> without = with;
        add_hum(random, with, frequency, 1.);
        const std::vector<Hum> found = find_mains_hum(with);
        ASSERT_EQ(found.size(), with.size());
        std::size_t n_told = 0, n_near = 0;
        double      left = 0.;
        for (std::size_t r = 0; r < with.size(); ++r)
          {
            if (!found[r].is_told)
              continue;
            ++n_told;
            n_near += std::abs(found[r].frequency - frequency) <
                      0.3 / with[r].time.back();
            for (std::size_t i = 0; i < with[r].time.size(); ++i)
              left += std::pow(with[r].left[i] - without[r].left[i] -
                                 found[r].at(with[r].time[i]),
                               2) /
                      with[r].time.size();
          }
        EXPECT_GE(n_told, 15U) << frequency << ' ' << remainder;
        EXPECT_GE(n_near + 1, n_told);
        EXPECT_LT(left / n_told, 0.2 * 0.5);
      }
}



TEST(MainsHum, IsNotFoundWithoutIt)
{
  Random      random(2);
  std::size_t n_found = 0;
  for (unsigned int campaign = 0; campaign < 600; ++campaign)
    {
      std::vector<HumSeries> series =
        records(random, 1 + campaign % 20, campaign % 3 == 0 ? 5. : 0.);
      if (campaign % 3 == 1)
        add_track_waves(random, series, uniform(random, 0.2, 3.));
      n_found += !find_mains_hum(series).empty();
    }
  EXPECT_LE(n_found, 1U);
}



// Waves of the track whose frequency is that of the mains by chance.
TEST(MainsHum, IsNoWaveOfTheTrack)
{
  Random                 random(3);
  std::vector<HumSeries> series = records(random, 8, 0.);
  for (std::size_t r = 0; r < series.size(); ++r)
    {
      series[r] = series[r % 2];
      for (double &left : series[r].left)
        left += std::normal_distribution<double>()(random);
    }
  std::vector<HumSeries> hummed = series;
  for (HumSeries &one : series)
    for (std::size_t i = 0; i < one.time.size(); ++i)
      one.left[i] += 2. * std::cos(two_pi * 50. * one.time[i]);
  EXPECT_TRUE(find_mains_hum(series).empty());
  add_hum(random, hummed, 50., 2.);
  EXPECT_FALSE(find_mains_hum(hummed).empty());
}



// Rows in step with the mains see it as a constant, or as one slow wave: it is
// not told from friction there, but as strong as in the others.
TEST(MainsHum, IsGuessedWhereItIsSlow)
{
  Random                 random(4);
  std::vector<HumSeries> series = records(random, 14, 0.);
  for (double &time : series[2].time)
    time *= 0.2 * (series[2].time.size() - 1) / series[2].time.back();
  for (double &time : series[3].time)
    time *= (0.2 * (series[3].time.size() - 1) + 0.02) / series[3].time.back();
  for (HumSeries &one : series)
    one.level = 4.;
  series[2].level = 8.;
  add_hum(random, series, 50., 1.);
  const std::vector<Hum> found = find_mains_hum(series);
  ASSERT_EQ(found.size(), series.size());
  EXPECT_FALSE(found[2].is_told);
  EXPECT_FALSE(found[3].is_told);
  EXPECT_EQ(found[2].frequency, 50.);
  EXPECT_NEAR(found[2].amplitude, 2., 0.3);
  EXPECT_NEAR(found[3].amplitude, 1., 0.15);
}



// Rows in step with the mains but for 0.02 Hz, and the same two times: what is
// a wave of the track is not in the differences.
TEST(MainsHum, IsFoundInDifferencesOfReplicates)
{
  std::normal_distribution<double> normal;
  Random                           random(5);
  unsigned int                     n_found = 0, n_false = 0;
  for (unsigned int campaign = 0; campaign < 200; ++campaign)
    {
      std::vector<HumSeries> series = records(random, 12, 3.);
      const double           waves  = uniform(random, 3., 10.);
      for (std::size_t r = 0; r < series.size(); ++r)
        for (double &time : series[r].time)
          time *= waves / 0.02 / series[r].time.back();
      const bool hums = campaign < 50;
      if (hums)
        add_hum(random, series, 0.02, 1.);
      add_track_waves(random, series, 1.);
      const std::vector<Hum> found =
        find_hum_of_replicates(differences_of(series), series, at_one_speed);
      (hums ? n_found : n_false) += !found.empty();
      if (hums && !found.empty())
        {
          EXPECT_NEAR(found[0].frequency, 0.02, 0.01) << campaign;
        }
    }
  EXPECT_GE(n_found, 25U);
  EXPECT_LE(n_false, 2U);
}



// Strokes have waves of all multiples of their frequency, that of the mains
// among them: an error of the model is no hum.
TEST(MainsHum, IsNoErrorOfStrokes)
{
  Random random(6);
  for (const auto &[frequency, rate, duration] :
       {std::array<double, 3>{{50., 2000., 1.}},
        std::array<double, 3>{{10., 1000., 2.}},
        std::array<double, 3>{{1., 15., 60.}},
        std::array<double, 3>{{0.5, 20., 40.}}})
    {
      std::vector<HumSeries> series;
      for (unsigned int r = 0; r < 6; ++r)
        series.push_back(
          strokes(random, frequency, rate, duration, r % 2 == 0 ? 0.1 : -0.05)
            .front());
      EXPECT_TRUE(find_mains_hum({series.front()}).empty()) << frequency;
      EXPECT_TRUE(find_mains_hum(series).empty()) << frequency;
      for (std::size_t r = 0; r < series.size(); ++r)
        series[r].speed = 1. + r;
      EXPECT_TRUE(
        find_hum_of_replicates(differences_of(series), series, at_one_speed)
          .empty())
        << frequency;
      // But there may be one beside it.
      if (rate < 1000.)
        continue;
      add_hum(random, series, 60., 2.);
      const std::vector<Hum> found = find_mains_hum(series);
      ASSERT_FALSE(found.empty()) << frequency;
      EXPECT_EQ(found[0].mains, 60.);
    }
}



// Of one speed waves in time could be of tracks that begin anywhere.
TEST(MainsHum, IsNotFoundAtOneSpeedAlone)
{
  Random                 random(7);
  std::vector<HumSeries> series = records(random, 20, 0.);
  for (HumSeries &one : series)
    for (double &time : one.time)
      time *= 300. / one.time.back();
  add_hum(random, series, 0.02, 3.);
  for (std::size_t r = 0; r < series.size(); ++r)
    series[r].speed = 1.;
  EXPECT_TRUE(
    find_hum_of_replicates(differences_of(series), series, at_one_speed)
      .empty());
  EXPECT_NEAR(at_one_speed, 0.02, 0.004);
  for (std::size_t r = 0; r < series.size(); ++r)
    series[r].speed = 1. + r / 2;
  EXPECT_FALSE(
    find_hum_of_replicates(differences_of(series), series, at_one_speed)
      .empty());
}
