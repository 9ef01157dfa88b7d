// SPDX-License-Identifier: LGPL-2.1-or-later

// Intervals of fitted parameters end where they say, and hold the truth.

#include <slipstep/calibration/fit.h>
#include <slipstep/calibration/profile_side.h>
#include <slipstep/calibration/uncertainty.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numeric>
#include <random>

#include "planted.h"

using namespace SlipStep;
using namespace SlipStep::Testing;



// Without noise the optimum is the truth.
// Without time for profiles: one start, and the intervals of the curvature,
// which are nearly those of the profiles where the tests tell so much.
TEST_F(Planted, IntervalsAreSymmetricWhereNoTimeIsLeft)
{
  plant(
    folder.path(), calibration_case(paper), {1., 10., 50., 200.}, 300, 5e-4, 1);
  const Calibration whole =
    calibrate(fitting({{"Calibration/Parameters", four}}));
  const Calibration late  = calibrate(fitting(
    {{"Calibration/Parameters", four}, {"Calibration/Most time", "1 us"}}));
  const auto        words = [](const Calibration &found) {
    std::string all;
    for (const std::string &warning : found.warnings)
      all += warning + '\n';
    return all;
  };
  EXPECT_EQ(words(whole).find("Most time"), std::string::npos);
  EXPECT_NE(words(late).find("3 of 4 starts began"), std::string::npos)
    << words(late);
  EXPECT_NE(words(late).find("the intervals of"), std::string::npos);
  for (std::size_t i = 0; i < whole.parameters.size(); ++i)
    {
      const FittedParameter &followed = whole.parameters[i];
      const FittedParameter &guessed  = late.parameters[i];
      const double           width    = followed.upper - followed.lower;
      EXPECT_NEAR(guessed.value, followed.value, 0.02 * width);
      EXPECT_NEAR(guessed.lower, followed.lower, 0.1 * width);
      EXPECT_NEAR(guessed.upper, followed.upper, 0.1 * width);
      EXPECT_NE(words(late).find(guessed.parameter.path), std::string::npos);
    }
}



// The same where gains differ from test to test, which widens both.
TEST_F(Planted, SymmetricIntervalsCountGainsOnce)
{
  const Parameters                 truth = calibration_case(paper);
  std::mt19937                     random(11);
  std::normal_distribution<double> gain(1., 0.005);
  plant_with_gains(folder.path(), truth, 4, gain, random);
  const Settings    four_from_one = {{"Calibration/Parameters", four},
                                     {"Calibration/Starts", "1"}};
  const Calibration whole         = calibrate(fitting(four_from_one));
  Settings          late_settings = four_from_one;
  late_settings.emplace_back("Calibration/Most time", "1 us");
  const Calibration late     = calibrate(fitting(late_settings));
  bool              is_wider = false;
  for (const std::string &warning : whole.warnings)
    is_wider =
      is_wider || warning.find("differ from one another") != std::string::npos;
  EXPECT_TRUE(is_wider);
  for (std::size_t i = 0; i < whole.parameters.size(); ++i)
    {
      const FittedParameter &followed = whole.parameters[i];
      const FittedParameter &guessed  = late.parameters[i];
      EXPECT_NEAR((guessed.upper - guessed.lower) /
                    (followed.upper - followed.lower),
                  1.,
                  0.2)
        << followed.parameter.path;
    }
}



// Of few and noisy rows the fits of a profile fall from one optimum of the
// other parameters to another one: that is no end of an interval.
TEST_F(Planted, IntervalsDoNotEndAtAJump)
{
  const Settings law = {{"Friction/Static coefficient", "0.3"},
                        {"Friction/softening/Kinetic coefficient", "0.22"},
                        {"Friction/softening/Rate", "0.5"},
                        {"Friction/overstress/Viscosity", "500"},
                        {"Friction/overstress/Exponent", "12"},
                        {"Friction/subloading/Rate", "50"},
                        {"Friction/Tangential stiffness", "500"},
                        {"Calibration/Tests", folder.path().string()},
                        {"Calibration/Starts", "1"},
                        {"Calibration/Parameters",
                         "Friction/Static coefficient from 0.02 to 3; "
                         "Friction/softening/Rate from 0.005 to 50; "
                         "Friction/overstress/Viscosity from 1 to 1e6; "
                         "Friction/subloading/Rate from 1 to 1e4"}};
  for (unsigned int seed = 1; seed <= 3; ++seed)
    {
      plant(folder.path(),
            calibration_case(law),
            {0.6, 6., 60.},
            5,
            4e-3,
            seed,
            2.);
      const Calibration found = calibrate(calibration_case(law));
      for (const FittedParameter &fitted : found.parameters)
        for (std::size_t i = 1; i < fitted.profile.size(); ++i)
          {
            const auto [x0, rise0] = fitted.profile[i - 1];
            const auto [x1, rise1] = fitted.profile[i];
            const bool is_open =
              rise0 < 1. ? fitted.is_upper_open : fitted.is_lower_open;
            const bool is_end = (rise0 < 1.) != (rise1 < 1.) && !is_open;
            EXPECT_FALSE(is_end && std::abs(x1 / x0 - 1.) < 1e-3 &&
                         std::abs(rise1 - rise0) > 0.3)
              << fitted.parameter.path << ", seed " << seed << ": " << x0 << " "
              << rise0 << ", " << x1 << " " << rise1;
          }
    }
}



// 100 repetitions with other noise, white and such that 0.8 of a row is what
// the row before it had.
class IntervalsCover : public Planted
{};

TEST_F(IntervalsCover, TheTruthAsOftenAsTheySay)
{
  const Parameters truth = calibration_case(paper);
  const auto       fitted =
    fitting({{"Calibration/Parameters", four}, {"Calibration/Starts", "1"}});
  for (const double kept : {0., 0.8})
    {
      std::vector<unsigned> n_covered(4, 0);
      for (unsigned int repetition = 0; repetition < 100; ++repetition)
        {
          plant(folder.path(),
                truth,
                {1., 20., 200.},
                120,
                1e-3,
                1 + repetition,
                100.,
                1.,
                kept);
          const Calibration found = calibrate(fitted);
          for (std::size_t i = 0; i < 4; ++i)
            {
              const FittedParameter &parameter = found.parameters[i];
              const double           value = truth_of(parameter.parameter.path);
              n_covered[i] +=
                parameter.lower <= value && value <= parameter.upper;
            }
        }
      for (std::size_t i = 0; i < 4; ++i)
        {
          EXPECT_GE(n_covered[i], kept == 0. ? 93u : 92u) << i << ", " << kept;
          RecordProperty("covered_" + std::to_string(i), n_covered[i]);
          std::cout << "covered " << n_covered[i] << " of 100\n";
        }
    }
}



// Load cells and specimens differ from test to test by more than rows scatter.
TEST_F(IntervalsCover, TheTruthWhereGainsDiffer)
{
  const Parameters truth = calibration_case(paper);
  const auto       fitted =
    fitting({{"Calibration/Parameters", four}, {"Calibration/Starts", "1"}});
  for (const unsigned int n_replicates : {1u, 2u})
    {
      constexpr unsigned int           n_repetitions = 20;
      unsigned int                     n_covered = 0, n_warned = 0;
      std::mt19937                     random(11);
      std::normal_distribution<double> gain(1., 0.005);
      for (unsigned int repetition = 0; repetition < n_repetitions;
           ++repetition)
        {
          plant_with_gains(folder.path(), truth, n_replicates, gain, random);
          const Calibration found = calibrate(fitted);
          for (const FittedParameter &parameter : found.parameters)
            {
              const double value = truth_of(parameter.parameter.path);
              n_covered += parameter.lower <= value && value <= parameter.upper;
            }
          for (const std::string &warning : found.warnings)
            n_warned +=
              warning.find("differ from one another") != std::string::npos;
        }
      RecordProperty("covered_" + std::to_string(n_replicates), n_covered);
      std::cout << "covered " << n_covered << " of " << 4 * n_repetitions
                << ", warned " << n_warned << " of " << n_repetitions << "\n";
      // A third of them by the rows alone. Replicates tell gains apart.
      EXPECT_GE(n_covered, n_replicates == 1 ? 62u : 73u) << n_replicates;
      EXPECT_GE(n_warned, 18u) << n_replicates;
    }
}



// Friction recorded far more coarsely than its noise: rows at one
// level err alike, but by how much is known, and intervals end.
TEST_F(IntervalsCover, TheTruthWhereFrictionIsRounded)
{
  constexpr double step  = 0.002;
  const Parameters truth = calibration_case(paper);
  const auto       fitted =
    fitting({{"Calibration/Parameters",
              "Friction/Static coefficient from 0.02 to 0.5; "
              "Friction/softening/Kinetic coefficient from 0.02 to 0.5; "
              "Friction/softening/Rate from 0.01 to 10"},
             {"Calibration/Starts", "1"}});
  unsigned int n_covered = 0, n_open = 0;
  for (unsigned int seed = 1; seed <= 20; ++seed)
    {
      std::mt19937 random(seed);
      MeasuredTest test =
        planted_test(truth, 0.1, 20. + seed, 120, 5e-4, random);
      for (double &friction : test.friction)
        friction = step * std::round(friction / step);
      std::filesystem::create_directories(folder.path());
      write_measured_test(folder.path() / "rounded.csv", test);
      for (const FittedParameter &found : calibrate(fitted).parameters)
        {
          const double value = truth_of(found.parameter.path);
          n_covered += found.lower <= value && value <= found.upper;
          n_open += found.is_lower_open || found.is_upper_open;
        }
    }
  RecordProperty("covered", n_covered);
  EXPECT_GE(n_covered, 55u);
  EXPECT_LE(n_open, 3u);
}



// Of a constant friction the tests are means, which weigh what their rows
// scatter: the interval is about that of Student's t of these, beside a
// stiffness of which no test says anything.
TEST_F(IntervalsCover, WhatTheMeansOfReplicatesDo)
{
  constexpr std::size_t n_tests = 4, n_rows = 200;

  std::mt19937                     random(5);
  std::normal_distribution<double> gain(1., 0.02), noise(0., 0.002);
  std::vector<double>              means;
  for (std::size_t t = 0; t < n_tests; ++t)
    {
      MeasuredTest test;
      test.condition    = "alike";
      test.name         = "test " + std::to_string(t);
      const double mean = 0.2 * gain(random);
      double       sum  = 0.;
      for (std::size_t i = 0; i < n_rows; ++i)
        {
          test.time.push_back(0.1 * i);
          test.displacement.push_back(0.05 * i);
          test.pressure.push_back(1.);
          test.friction.push_back(i == 0 ? 0. : mean + noise(random));
          sum += i == 0 ? 0. : test.friction.back();
        }
      means.push_back(sum / (n_rows - 1));
      write_measured_test(folder.path() / (test.name + ".csv"), test);
    }
  const Calibration found = calibrate(
    fitting({{"Friction/Effects", ""},
             {"Calibration/Parameters",
              "Friction/Static coefficient from 0.05 to 0.6; "
              "Friction/Tangential stiffness from 1 to 1000 start 100"}}));
  const double mean = std::accumulate(means.begin(), means.end(), 0.) / n_tests;
  double       squares = 0.;
  for (const double x : means)
    squares += (x - mean) * (x - mean);
  constexpr double of_three = 3.182; // Student's t, 95 %
  const double half = of_three * std::sqrt(squares / (n_tests * (n_tests - 1)));
  const FittedParameter &coefficient = found.parameters.front();
  EXPECT_NEAR(coefficient.value, mean, 1e-4);
  EXPECT_NEAR(coefficient.lower, mean - half, 0.1 * half);
  EXPECT_NEAR(coefficient.upper, mean + half, 0.1 * half);
}



// Six tests of one condition whose gains differ by some per cent: of what gains
// move the interval is that of six fits of one test each, by Student's t, and
// what they do not move, the rate, they do not widen. Friction softens by the
// closed form.
TEST_F(IntervalsCover, WhatFitsOfSingleTestsDo)
{
  constexpr std::size_t n_tests = 6, n_rows = 400;
  constexpr double      start = 0.15, kinetic = 0.1, rate = 2., steepness = 5.;

  const Settings law        = {{"Friction/Effects", "softening"},
                               {"Friction/softening/Steepness", "5"},
                               {"Friction/Tangential stiffness", "10000"},
                               {"Calibration/Starts", "1"},
                               {"Calibration/Parameters",
                                "Friction/Static coefficient from 0.05 to 0.5; "
                                       "Friction/softening/Kinetic coefficient from 0.01 to "
                                       "0.5; Friction/softening/Rate from 0.01 to 100 log"}};
  const auto     calibrated = [&](const std::string &tests) {
    return calibrate(calibration_case(
      law + Settings{{"Calibration/Tests", (folder.path() / tests).string()}}));
  };
  std::mt19937                     random(3);
  std::normal_distribution<double> noise(0., 1e-3);
  std::vector<Calibration>         single;
  for (std::size_t t = 0; t < n_tests; ++t)
    {
      MeasuredTest test;
      test.condition    = "alike";
      test.name         = "test " + std::to_string(t);
      const double gain = 1. + 0.012 * (static_cast<double>(t) - 2.5);
      for (std::size_t i = 0; i < n_rows; ++i)
        {
          const double way   = static_cast<double>(i) / (n_rows - 1);
          const double decay = (1. - std::exp(-steepness * (start - kinetic))) *
                               std::exp(-rate * steepness * way);
          test.time.push_back(way);
          test.displacement.push_back(way);
          test.pressure.push_back(5.);
          test.friction.push_back(
            i == 0 ? 0. :
                     gain * (kinetic - std::log(1. - decay) / steepness) +
                       noise(random));
        }
      write_measured_test(folder.path() / (test.name + ".csv"), test);
      single.push_back(calibrated(test.name + ".csv"));
    }
  const Calibration all     = calibrated("");
  constexpr double  of_five = 2.571; // Student's t, 95 %
  for (std::size_t i = 0; i < 3; ++i)
    {
      double mean = 0., squares = 0.;
      for (const Calibration &one : single)
        mean += one.parameters[i].value / n_tests;
      for (const Calibration &one : single)
        squares += std::pow(one.parameters[i].value - mean, 2);
      const double by_six =
        of_five * std::sqrt(squares / (n_tests * (n_tests - 1.)));
      const FittedParameter &found = all.parameters[i];
      const double           half  = (found.upper - found.lower) / 2.;
      std::cout << found.parameter.path << ": " << half / by_six
                << " times as wide\n";
      EXPECT_NEAR(found.value, mean, by_six) << i;
      EXPECT_GT(half, 0.6 * by_six) << found.parameter.path;
      EXPECT_LT(half, 1.7 * by_six) << found.parameter.path;
    }
  const std::string &warning = all.warnings.front();
  EXPECT_TRUE(contains(warning, "Static coefficient ")) << warning;
  EXPECT_TRUE(contains(warning, "Kinetic coefficient ")) << warning;
  EXPECT_FALSE(contains(warning, "softening/Rate")) << warning;
}



// What the law refuses nothing contradicts: the interval is open there, and one
// parameter alone is no exception.
TEST_F(Planted, AnIntervalIsOpenWhereTheLawRefusesMore)
{
  plant(folder.path(), calibration_case(paper), {1.}, 12, 2e-2, 5, 5.);
  for (const std::string more :
       {"", "; Friction/softening/Rate from 0.04 to 0.05"})
    {
      const Calibration      found   = calibrate(fitting(
        {{"Calibration/Parameters",
                 "Friction/softening/Kinetic coefficient from 0.05 to 0.3" + more}}));
      const FittedParameter &kinetic = found.parameters.front();
      EXPECT_TRUE(kinetic.is_upper_open);
      EXPECT_LE(kinetic.upper, 0.0899 * (1. + 1e-9));
      EXPECT_GE(kinetic.upper, kinetic.value);
    }
}



// Of a profile: where it ends the misfit has risen by the threshold, with all
// others fitted again; asserted by an independent search.
TEST_F(Planted, IntervalsEndWhereTheMisfitHasRisen)
{
  plant(folder.path(), calibration_case(paper), {1., 20., 200.}, 200, 1e-3, 7);
  const Campaign  campaign(fitting({{"Calibration/Parameters", four}}));
  Simulator       simulator(campaign);
  const FitResult best =
    fit(simulator, campaign.scaled_start(), all_parameters(campaign));
  simulator.plan(best.scaled);
  std::vector<TestMisfit> tests;
  const Linearisation     optimum = linearise(simulator, best.scaled, tests);
  EXPECT_NEAR(optimum.threshold(0.95, 0) / optimum.inflation, 3.86, 0.02);
  for (unsigned int i = 0; i < 4; ++i)
    {
      const Profile followed = profile(simulator, optimum, i, 0.95);
      for (const double end : {followed.lower, followed.upper})
        {
          std::vector<double> scaled = optimum.scaled;
          scaled[i]                  = end;
          std::vector<unsigned int> others;
          for (unsigned int j = 0; j < 4; ++j)
            if (j != i)
              others.push_back(j);
          const FitResult there = fit(simulator, scaled, others, 0);
          EXPECT_NEAR((there.misfit - optimum.misfit) /
                        optimum.threshold(0.95, i),
                      1.,
                      0.05);
        }
    }
}



// A misfit with many valleys, far lower away from what was taken for the
// optimum: no interval belongs to that, and few fits are enough to see it.
TEST(ProfileSide, EndsWhereTheOptimumWasNone)
{
  unsigned int n_fits = 0;
  const auto   refit  = [&](const std::vector<double> &from) {
    ++n_fits;
    const double moved = from[0] - 0.3;
    return ProfileSide::Fitted{100. + 5. * std::sin(1e3 * moved) - 400. * moved,
                               from};
  };
  ProfileSide side(refit,
                   {100., {0.3, 0.5}},
                   Eigen::VectorXd::Zero(2),
                   0,
                   4.,
                   1,
                   std::chrono::steady_clock::time_point::max());
  side.follow(0.01);
  EXPECT_TRUE(side.is_open);
  EXPECT_FALSE(side.better.empty());
  EXPECT_LT(n_fits, 10u);
}



// The rate of subloading in records without a row in the rise: any that is
// large enough fits as well, and from one value on the misfit rises steeply.
TEST_F(Planted, AnIntervalEndsWhereTheInfluenceBegins)
{
  plant(folder.path(), calibration_case(paper), {1., 20., 200.}, 500, 1e-4, 7);
  const Campaign campaign(
    fitting({{"Calibration/Parameters",
              "Friction/Static coefficient from 0.05 to 0.2; "
              "Friction/subloading/Rate from 1 to 5000 start 200"}}));
  Simulator       simulator(campaign);
  const FitResult best =
    fit(simulator, campaign.scaled_start(), all_parameters(campaign));
  simulator.plan(best.scaled);
  std::vector<TestMisfit> tests;
  const Linearisation     optimum  = linearise(simulator, best.scaled, tests);
  const Profile           followed = profile(simulator, optimum, 1, 0.95);
  EXPECT_TRUE(followed.is_upper_open);
  ASSERT_FALSE(followed.is_lower_open);
  const double threshold = optimum.threshold(0.95, 1);
  const double end =
    fit(simulator, {best.scaled[0], followed.lower}, {0}, 0).misfit;
  EXPECT_NEAR((end - optimum.misfit) / threshold, 1., 0.1);
}



// Of a process of first order with parameter a: (1 + a) / (1 - a).
TEST(CorrelationLength, OfNoiseAndOfAProcessOfFirstOrder)
{
  std::mt19937                     random(1);
  std::normal_distribution<double> normal;
  std::vector<double>              white(20000), red(20000);
  double                           state = 0.;
  for (std::size_t i = 0; i < white.size(); ++i)
    {
      white[i] = normal(random);
      state    = 0.8 * state + normal(random);
      red[i]   = state;
    }
  EXPECT_NEAR(correlation_length(white.data(), white.size()), 1., 0.1);
  EXPECT_NEAR(correlation_length(red.data(), red.size()), 9., 1.);
  // An offset is off together all along.
  const std::vector<double> offset(1000, 0.3);
  EXPECT_GT(correlation_length(offset.data(), offset.size()), 300.);
}
