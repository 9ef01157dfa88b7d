// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/candidate_scores.h>
#include <slipstep/diagnosis/score_test.h>
#include <slipstep/diagnosis/track_waves.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

using namespace SlipStep;

namespace
{
  constexpr unsigned int n_rows = 240;

  // One of several slides at constant speed, with friction 0.1.
  CampaignTest slide(const std::string &name, const std::string &condition)
  {
    MeasuredTest test;
    test.name      = name;
    test.condition = condition;
    for (unsigned int i = 0; i < n_rows; ++i)
      {
        test.time.push_back(0.1 * i);
        test.displacement.push_back(0.01 * i);
        test.pressure.push_back(5.);
        test.friction.push_back(0.1);
      }
    return {test, {{1., 0., 0.001}}, true, Replay(test)};
  }

  // Rows of two replicates and of a test without.
  Comparison two_and_one()
  {
    Comparison comparison(
      {slide("a", "twice"), slide("b", "twice"), slide("c", "once")});
    Noise noise;
    noise.drift  = 0.003;
    noise.gain   = 0.005;
    noise.offset = 0.003;
    noise.slope  = 0.002;
    comparison.set_noise(noise, comparison.measured);
    return comparison;
  }

  NoiseEstimate known(const Comparison &comparison)
  {
    NoiseEstimate estimate;
    estimate.noise      = comparison.noise();
    estimate.covariance = 1e-6 * estimate.covariance.Identity();
    return estimate;
  }

  // The residual of one draw of noise, with a pattern on some of the tests.
  Eigen::VectorXd residual(const Comparison       &comparison,
                           const std::uint64_t     seed,
                           const double            strength,
                           const std::vector<bool> has_pattern)
  {
    RowMatrix pattern = RowMatrix::Zero(comparison.n_rows(), 1);
    for (std::size_t t = 0; t < comparison.tests.size(); ++t)
      for (Eigen::Index i = 0; has_pattern[t] && i < comparison.tests[t].size;
           ++i)
        // Of four rows to a wave: no slow basis knows it.
        pattern(comparison.tests[t].begin + i, 0) =
          strength * std::sin(1.57 * i);
    comparison.whiten(pattern);
    return pattern.col(0) +
           draw_null(comparison, known(comparison), 1, seed).col(0);
  }
} // namespace



TEST(ChanceOfAgreement, NoiseHasItsChance)
{
  const Comparison comparison = two_and_one();
  const RowMatrix  null     = draw_null(comparison, known(comparison), 199, 1);
  unsigned int     n_alarms = 0;
  for (unsigned int seed = 10; seed < 110; ++seed)
    n_alarms +=
      chance_of_agreement(comparison,
                          residual(comparison, seed, 0., {true, true, true}),
                          null) <= 0.1;
  // Ten of a hundred; four standard deviations.
  EXPECT_LE(n_alarms, 22u);
  EXPECT_GE(n_alarms, 1u);
}



TEST(ChanceOfAgreement, WhatReplicatesShareIsSeenWhateverItsShape)
{
  const Comparison comparison = two_and_one();
  const RowMatrix  null   = draw_null(comparison, known(comparison), 199, 1);
  const auto       chance = [&](const std::vector<bool> &has_pattern) {
    return chance_of_agreement(comparison,
                               residual(comparison, 7, 8e-4, has_pattern),
                               null);
  };
  EXPECT_LE(chance({true, true, false}), 0.01);
  // One of two is noise of that test, and the third has no replicate.
  EXPECT_GT(chance({true, false, false}), 0.01);
  EXPECT_GT(chance({false, false, true}), 0.01);
}



TEST(ChanceOfAgreement, WithoutReplicatesThereIsNone)
{
  Comparison comparison({slide("a", "one"), slide("b", "other")});
  comparison.set_noise(Noise(), comparison.measured);
  EXPECT_EQ(
    chance_of_agreement(comparison,
                        Eigen::VectorXd::Ones(comparison.n_rows()),
                        draw_null(comparison, known(comparison), 99, 1)),
    1.);
}



namespace
{
  // Three tests over the same 2.4 mm, and a model with one parameter that
  // scales friction, which leaves noise and a wave along the track.
  struct Track
  {
    Comparison comparison = two_and_one();
    Covariates covariates;
    RowMatrix  null = draw_null(comparison, known(comparison), 199, 1);

    Track()
    {
      covariates.track.resize(comparison.n_rows());
      covariates.speed = Eigen::VectorXd::Ones(comparison.n_rows());
      for (const ComparedTest &test : comparison.tests)
        for (Eigen::Index i = 0; i < test.size; ++i)
          covariates.track(test.begin + i) = 0.01 * i;
      covariates.friction = comparison.measured;
    }

    TrackWave find(const std::uint64_t seed,
                   const double        strength,
                   const double        wavelength,
                   const double        phase = 0.) const
    {
      RowMatrix wave(comparison.n_rows(), 2);
      for (Eigen::Index i = 0; i < wave.rows(); ++i)
        wave.row(i) << strength * 0.1 *
                         std::sin(phase +
                                  2. * M_PI * covariates.track(i) / wavelength),
          0.1;
      comparison.whiten(wave);
      Model model;
      model.residual =
        wave.col(0) + draw_null(comparison, known(comparison), 1, seed).col(0);
      model.derivatives = wave.col(1);
      const std::vector<double> wavelengths =
        track_wavelengths(comparison, covariates);
      return find_track_wave(
        DirectionSet(comparison,
                     null,
                     track_waves(comparison, covariates, wavelengths)),
        wavelengths,
        model,
        null);
    }
  };
} // namespace



TEST(TrackWaves, NoiseHasItsChance)
{
  const Track  track;
  unsigned int n_alarms = 0;
  for (unsigned int seed = 10; seed < 110; ++seed)
    n_alarms += track.find(seed, 0., 1.).p <= 0.1;
  EXPECT_LE(n_alarms, 22u);
  EXPECT_GE(n_alarms, 1u);
}



TEST(TrackWaves, AreSeenWithTheirLengthWhereverTheyBegin)
{
  const Track track;
  for (const double wavelength : {0.1, 0.3, 0.6})
    for (const double phase : {0., 0.8, 1.6})
      {
        const TrackWave found = track.find(3, 0.01, wavelength, phase);
        EXPECT_LE(found.p, 0.01) << wavelength << ' ' << phase;
        // Those that are tried are half a wave apart over 2.4 mm.
        EXPECT_NEAR(2.4 / found.wavelength, 2.4 / wavelength, 0.3);
      }
}



// Rows 0.01 mm apart, of which four make a wave.
TEST(TrackWaves, AreOnlyWhereRowsTellThem)
{
  Track               track;
  const ComparedTest &far = track.comparison.tests[2];
  track.covariates.track.segment(far.begin, far.size) *= 10.;
  for (const Direction &wave :
       track_waves(track.comparison, track.covariates, {0.039}))
    EXPECT_EQ(wave.friction.norm(), 0.);
  for (const Direction &wave :
       track_waves(track.comparison, track.covariates, {0.1}))
    {
      EXPECT_GT(wave.friction.head(far.begin).norm(), 0.1);
      EXPECT_EQ(wave.friction.segment(far.begin, far.size).norm(), 0.);
    }
}



// A rest is no place, and a test that trembles on the spot has no track.
TEST(TrackWaves, AreNotAtRest)
{
  Track               track;
  const ComparedTest &held = track.comparison.tests[1];
  for (const unsigned int t : {1, 2})
    {
      const ComparedTest &test = track.comparison.tests[t];
      for (Eigen::Index i = 0; i < test.size; ++i)
        track.covariates.track(test.begin + i) = 1e-6 * (i % 2);
    }
  track.covariates.speed.head(100).setZero();
  const std::vector<double> wavelengths =
    track_wavelengths(track.comparison, track.covariates);
  EXPECT_NEAR(wavelengths.front(), 0.5 * 2.39, 1e-12);
  for (const Direction &wave :
       track_waves(track.comparison, track.covariates, wavelengths))
    {
      EXPECT_EQ(wave.friction.head(100).norm(), 0.);
      EXPECT_GT(wave.friction.head(held.begin).norm(), 0.1);
      EXPECT_EQ(wave.friction.tail(n_rows * 2).norm(), 0.);
    }
}



TEST(TrackWaves, WithoutMotionThereAreNone)
{
  Track track;
  track.covariates.track.setConstant(1.);
  EXPECT_TRUE(track_wavelengths(track.comparison, track.covariates).empty());
  EXPECT_EQ(track.find(3, 0.01, 0.3).p, 1.);
}



namespace
{
  // Two effects that act at once, of which the second one takes away nearly all
  // that the first one adds; the model knows neither.
  struct Opposites
  {
    Comparison comparison = two_and_one();
    RowMatrix  null       = draw_null(comparison, known(comparison), 499, 1);
    std::vector<Direction> directions{2};

    Opposites()
    {
      const Eigen::Index n = comparison.n_rows();
      for (std::size_t d = 0; d < 2; ++d)
        {
          directions[d].friction.resize(n);
          directions[d].is_one_sided = true;
          directions[d].candidate    = d;
        }
      for (Eigen::Index i = 0; i < n; ++i)
        {
          const double x            = 0.02 * (i % n_rows);
          directions[0].friction(i) = 0.001 * std::sin(x);
          directions[1].friction(i) = -0.001 * std::sin(x - 0.3);
        }
    }

    // @param strengths of the two in what the model leaves
    ScoreTest test(const std::array<double, 2> &strengths,
                   const std::uint64_t          seed) const
    {
      RowMatrix columns(comparison.n_rows(), 2);
      columns.col(0) = strengths[0] * directions[0].friction +
                       strengths[1] * directions[1].friction;
      columns.col(1).setConstant(0.1);
      comparison.whiten(columns);
      Model model;
      model.residual = columns.col(0) +
                       draw_null(comparison, known(comparison), 1, seed).col(0);
      model.derivatives = columns.col(1);
      return ScoreTest(comparison, model, null, directions);
    }
  };

  Pairing if_opposed(std::size_t, std::size_t)
  {
    return Pairing::if_opposed;
  }
} // namespace



TEST(Pairs, ThatNearlyCancelAreSeenTogether)
{
  const Opposites opposites;
  const ScoreTest test  = opposites.test({12., 12.}, 3);
  const auto      pairs = test.pairs(opposites.directions, if_opposed);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_LE(pairs[0].p, 0.01);
  EXPECT_NEAR(pairs[0].first_strength, 12., 4.);
  EXPECT_NEAR(pairs[0].second_strength, 12., 4.);
  // Each alone promises less than both at once.
  for (const Score &score : test.scores)
    EXPECT_LT(std::pow(score.strength * score.free_length, 2),
              pairs[0].gain - 15.);
}



TEST(Pairs, OfNoiseHaveTheirChance)
{
  const Opposites opposites;
  unsigned int    n_alarms = 0;
  for (unsigned int seed = 10; seed < 110; ++seed)
    for (const ScoreTest::Pair &pair :
         opposites.test({0., 0.}, seed).pairs(opposites.directions, if_opposed))
      n_alarms += pair.p <= 0.1;
  EXPECT_LE(n_alarms, 22u);
  EXPECT_GE(n_alarms, 1u);
}



// The same sign twice is no pair, nor are two shapes of one candidate; those
// that are asked for are.
TEST(Pairs, AreOfDifferentCandidatesThatOppose)
{
  Opposites opposites;
  opposites.directions[1].friction *= -1.;
  const auto n_pairs = [&](const Pairing when) {
    return opposites.test({12., -9.}, 3)
      .pairs(opposites.directions,
             [=](std::size_t, std::size_t) { return when; })
      .size();
  };
  EXPECT_EQ(n_pairs(Pairing::if_opposed), 0u);
  opposites.directions[1].is_one_sided = false;
  EXPECT_EQ(n_pairs(Pairing::if_opposed), 1u);
  EXPECT_EQ(n_pairs(Pairing::always), 1u);
  EXPECT_EQ(n_pairs(Pairing::never), 0u);
  opposites.directions[1].candidate = 0;
  EXPECT_EQ(n_pairs(Pairing::always), 0u);
}



// What is told beside a partner only is never paired with anything else, not
// even with another one of the kind.
TEST(Pairs, OfOneThatIsToldBesideAnotherOnlyAreWithThat)
{
  const Candidate overstress{"overstress", "", {}, ""};
  const Candidate softening{"softening", "", {}, ""};
  Candidate       ageing{"ageing", "", {}, ""};
  Candidate       slip_law{"slip_law", "", {}, ""};
  ageing.only_beside = slip_law.only_beside = "overstress";
  EXPECT_EQ(pairing(overstress, softening), Pairing::if_opposed);
  EXPECT_EQ(pairing(overstress, ageing), Pairing::always);
  EXPECT_EQ(pairing(ageing, overstress), Pairing::always);
  EXPECT_EQ(pairing(softening, ageing), Pairing::never);
  EXPECT_EQ(pairing(slip_law, softening), Pairing::never);
  EXPECT_EQ(pairing(slip_law, ageing), Pairing::never);
}
