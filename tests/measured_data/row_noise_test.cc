// SPDX-License-Identifier: LGPL-2.1-or-later

// The noise of rows, from the scatter of means on several scales.

#include <slipstep/measured_data/row_noise.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace SlipStep;

namespace
{
  std::vector<double>
  rows_of(const RowNoise &noise, const std::size_t n, std::mt19937_64 &random)
  {
    std::normal_distribution<double> normal;
    std::vector<double>              result;
    double                           together = normal(random);
    for (std::size_t i = 0; i < n; ++i)
      {
        result.push_back(noise.deviation *
                         (std::sqrt(noise.share) * together +
                          std::sqrt(1. - noise.share) * normal(random)));
        together = noise.decay * together +
                   std::sqrt(1. - noise.decay * noise.decay) * normal(random);
      }
    return result;
  }

  std::vector<double> even_times(const std::size_t n)
  {
    std::vector<double> result;
    for (std::size_t i = 0; i < n; ++i)
      result.push_back((i + 0.5) / n);
    return result;
  }

  std::vector<double> means(const std::vector<double> &rows,
                            const std::size_t          n)
  {
    std::vector<double> result;
    for (std::size_t i = 0; i + n <= rows.size(); i += n)
      {
        result.push_back(0.);
        for (std::size_t j = i; j < i + n; ++j)
          result.back() += rows[j] / n;
      }
    return result;
  }

  // From neighbouring rows, as a record of white noise would have it.
  double from_neighbours(const std::vector<double> &rows)
  {
    double sum = 0.;
    for (std::size_t i = 1; i + 1 < rows.size(); ++i)
      sum += std::pow(rows[i - 1] - 2. * rows[i] + rows[i + 1], 2);
    return std::sqrt(sum / (rows.size() - 2) / 6.);
  }
} // namespace



// Closed forms against sums over all pairs of rows.
TEST(RowNoise, MeansOfRows)
{
  const RowNoise noise{2., 0.7, 0.6};
  for (const std::size_t n : {1, 2, 7})
    {
      double     variance = 0., covariance = 0.;
      const auto between = [&](const std::size_t i, const std::size_t j) {
        const double distance = i > j ? i - j : j - i;
        return 4. * ((i == j ? 0.3 : 0.) + 0.7 * std::pow(0.6, distance)) /
               (n * n);
      };
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          {
            variance += between(i, j);
            covariance += between(i, n + j);
          }
      EXPECT_NEAR(noise.variance_of_mean(n), variance, 1e-13);
      EXPECT_NEAR(noise.covariance_of_means(n), covariance, 1e-13);
    }
}



TEST(RowNoiseFit, FindsHowRowsHangTogether)
{
  std::mt19937_64 random(4);
  for (const std::size_t n_tests : {1, 20})
    {
      const RowNoise truth{0.001, 1., 0.8};
      RowNoiseFit    fit(0.005, 0.1);
      for (std::size_t t = 0; t < n_tests; ++t)
        {
          const std::vector<double> rows = rows_of(truth, 200, random);
          fit.add(rows, even_times(200), 1., from_neighbours(rows), 0.01);
        }
      const RowNoiseFit::Result found = fit.solve();
      EXPECT_TRUE(found.is_correlated) << n_tests;
      double sum = 0.;
      for (const RowNoise &noise : found.records)
        sum += noise.variance_of_mean(8.) / truth.variance_of_mean(8.);
      EXPECT_GT(sum / n_tests, 0.5) << n_tests;
      EXPECT_LT(sum / n_tests, 1.6) << n_tests;
    }
}



// A record of a laboratory: correlations of 0.72, 0.37, 0.17, many rows per
// mean. Neighbouring rows by themselves tell a fifth of the truth.
TEST(RowNoiseFit, MeansOfManyRows)
{
  std::mt19937_64           random(5);
  const RowNoise            truth{0.004, 1., 0.7};
  const std::vector<double> rows     = rows_of(truth, 15000, random);
  const std::vector<double> bins     = means(rows, 50);
  const double              believed = from_neighbours(rows);
  RowNoiseFit               fit(0.005, 0.1);
  fit.add(bins, even_times(bins.size()), 50., believed, 0.01);
  const RowNoiseFit::Result found = fit.solve();
  ASSERT_TRUE(found.is_correlated);
  const double true_deviation = std::sqrt(truth.variance_of_mean(50.));
  EXPECT_LT(believed / std::sqrt(50.), 0.3 * true_deviation);
  EXPECT_NEAR(std::sqrt(found.records[0].variance_of_mean(50.)) /
                true_deviation,
              1.,
              0.2);
}



// White rows stay white, with heavy tails and beside a drift, too; chance may
// have one of forty.
TEST(RowNoiseFit, LeavesWhiteRows)
{
  std::mt19937_64                     random(6);
  std::student_t_distribution<double> student(3.);
  unsigned int                        n_correlated = 0;
  for (unsigned int campaign = 0; campaign < 20; ++campaign)
    for (const bool has_heavy_tails : {false, true})
      {
        RowNoiseFit fit(0.005, 0.1);
        for (unsigned int t = 0; t < 5; ++t)
          {
            std::vector<double> rows = rows_of({0.001, 0., 0.}, 170, random);
            if (has_heavy_tails)
              for (double &row : rows)
                row = 0.001 / std::sqrt(3.) * student(random);
            const std::vector<double> drift =
              rows_of({0.0005, 1., std::exp(-1. / 25.)}, 170, random);
            const double believed = from_neighbours(rows);
            for (std::size_t i = 0; i < rows.size(); ++i)
              rows[i] += drift[i];
            fit.add(rows, even_times(170), 1., believed, 0.1);
          }
        n_correlated += fit.solve().is_correlated;
      }
  EXPECT_LE(n_correlated, 1u);
}



TEST(Spikes, AreFoundInNoiseOfAnyKind)
{
  std::mt19937_64                            random(7);
  std::uniform_int_distribution<std::size_t> place(10, 189);
  for (const RowNoise &noise :
       {RowNoise{0.001, 0., 0.}, {0.001, 0.8, 0.7}, {0.02, 1., 0.95}})
    for (const double size : {15., 40., 1000.})
      for (unsigned int n = 0; n < 20; ++n)
        {
          const std::vector<double> rows   = rows_of(noise, 200, random);
          std::vector<double>       spiked = rows;
          const std::size_t         row    = place(random);
          spiked[row] += (n % 2 == 0 ? size : -size) * noise.deviation;
          const std::vector<bool> found = spikes(spiked);
          EXPECT_TRUE(found[row]) << size << ' ' << noise.decay;
          EXPECT_LE(std::count(found.begin(), found.end(), true), 2);
          bridge(found, spiked);
          EXPECT_NEAR(spiked[row], rows[row], 6. * noise.deviation);
        }
}



// A flank, a step, a peak of some rows, and digits.
TEST(Spikes, AreNoFlanksStepsOrDigits)
{
  std::mt19937_64           random(8);
  const std::vector<double> noise = rows_of({0.001, 0., 0.}, 200, random);
  std::vector<double>       test(200), coarse(200);
  for (std::size_t i = 0; i < 200; ++i)
    {
      const double rise = std::min(0.02 * i, 0.2 + 0.04 * std::exp(-0.1 * i));
      test[i]           = (i < 100 ? rise : i < 150 ? 0.3 : -0.2) + noise[i];
      coarse[i]         = 0.01 * std::round(100. * (0.2 + noise[i] * 4.));
    }
  for (const std::vector<double> &values : {test, coarse, {0.1, 0.1, 5.}})
    for (const bool is_spike : spikes(values))
      EXPECT_FALSE(is_spike);
}
