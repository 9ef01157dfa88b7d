// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/noise.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>

using namespace SlipStep;

namespace
{
  Series series_of(const std::size_t n, const double row_noise)
  {
    Series series;
    for (std::size_t i = 0; i < n; ++i)
      {
        // Closer at the beginning.
        const double share = static_cast<double>(i) / (n - 1);
        series.time.push_back(share * share);
        series.row_noise.push_back(row_noise * (1. + 0.5 * share));
        series.friction.push_back(0.1 + 0.02 * std::exp(-5. * share));
      }
    return series;
  }

  Noise usual_noise()
  {
    return {1.1, 0.006, 0.15, 0.007, 0.003, 0.002};
  }

  // From the definitions, element by element.
  Eigen::MatrixXd covariance(const std::vector<Series> &series,
                             const double               level,
                             const Noise               &noise)
  {
    Eigen::Index n = 0;
    for (const Series &one : series)
      n += one.time.size();
    Eigen::MatrixXd result(n, n);
    Eigen::Index    row = 0;
    for (std::size_t s = 0; s < series.size(); ++s)
      for (std::size_t i = 0; i < series[s].time.size(); ++i, ++row)
        {
          Eigen::Index column = 0;
          for (std::size_t t = 0; t < series.size(); ++t)
            for (std::size_t j = 0; j < series[t].time.size(); ++j, ++column)
              {
                double value = std::pow(noise.gain, 2) * series[s].friction[i] *
                               series[t].friction[j];
                const double own_level =
                  level * std::pow(series[s].noise_share, noise.by_sensor);
                if (s == t)
                  value +=
                    std::pow(own_level * noise.drift, 2) *
                      std::exp(
                        -std::abs(series[s].time[i] - series[t].time[j]) /
                        (noise.drift_time *
                         std::pow(series[s].duration, -noise.by_seconds))) +
                    std::pow(own_level * noise.offset, 2) +
                    std::pow(own_level * noise.slope, 2) *
                      (series[s].time[i] - 0.5) * (series[t].time[j] - 0.5);
                const double rows = std::pow(noise.white, 2) *
                                    series[s].row_noise[i] *
                                    series[t].row_noise[j];
                if (s == t)
                  for (const std::vector<double> &wave : series[s].hum)
                    value += wave[i] * wave[j];
                if (row == column)
                  value += rows * (1. - series[s].row_share);
                if (s == t)
                  value += rows * series[s].row_share *
                           std::pow(series[s].row_decay,
                                    (i > j ? i - j : j - i) / noise.row_memory);
                result(row, column) = value;
              }
        }
    return result;
  }
} // namespace



namespace
{
  // White rows; rows that hang together, in part and wholly; drift that forgets
  // within the same seconds; hum; a sensor quieter than another.
  std::vector<std::pair<Series, Noise>> kinds_of_noise(const std::size_t n)
  {
    std::vector<std::pair<Series, Noise>> result(6,
                                                 {series_of(n, 0.001),
                                                  usual_noise()});
    result[1].first.row_share   = 0.6;
    result[1].first.row_decay   = 0.8;
    result[1].second.row_memory = 1.7;
    result[2].first.row_share   = 1.;
    result[2].first.row_decay   = 0.5;
    result[3].first.row_share   = 0.3;
    result[3].first.row_decay   = 0.9;
    result[3].first.duration    = 3.;
    result[3].second.by_seconds = 0.8;
    result[5].first.noise_share = 0.2;
    result[5].second.by_sensor  = 0.7;
    for (const double phase : {0., 1.5708})
      {
        result[4].first.hum.emplace_back();
        for (const double time : result[4].first.time)
          result[4].first.hum.back().push_back(0.003 *
                                               std::cos(40. * time + phase));
      }
    return result;
  }
} // namespace



// Whitened covariance is the unit matrix, for one axis and for two.
TEST(Whitener, MakesNoiseIndependent)
{
  for (const std::size_t n_axes : {1, 2})
    for (const auto &[one, noise] : kinds_of_noise(40))
      {
        const std::vector<Series> series(n_axes, one);
        const Whitener            whitener(series, 0.11, noise);
        const Eigen::MatrixXd     C        = covariance(series, 0.11, noise);
        const Eigen::MatrixXd     L        = C.llt().matrixL();
        RowMatrix                 whitened = L;
        whitener.apply(whitened);
        const Eigen::MatrixXd unit = whitened * whitened.transpose();
        EXPECT_LT((unit - Eigen::MatrixXd::Identity(unit.rows(), unit.cols()))
                    .cwiseAbs()
                    .maxCoeff(),
                  1e-9);
        EXPECT_NEAR(whitener.log_determinant(),
                    2. * L.diagonal().array().log().sum(),
                    1e-8);
      }
}



TEST(SampleNoise, HasTheCovarianceThatIsWhitened)
{
  for (const auto &[one, noise] : kinds_of_noise(30))
    {
      const std::vector<Series> series(1, one);
      const Whitener            whitener(series, 0.11, noise);
      std::mt19937_64           random(3);
      constexpr unsigned int    n_samples = 4000;
      Eigen::MatrixXd           sum       = Eigen::MatrixXd::Zero(30, 30);
      for (unsigned int i = 0; i < n_samples; ++i)
        {
          RowMatrix sample = sample_noise(series, 0.11, noise, random);
          whitener.apply(sample);
          sum += sample * sample.transpose();
        }
      sum /= n_samples;
      // Standard deviation of an element: 1/sqrt(4000), of a diagonal one
      // sqrt(2) times that; 900 of them.
      EXPECT_LT((sum - Eigen::MatrixXd::Identity(30, 30)).cwiseAbs().maxCoeff(),
                5. * std::sqrt(2. / n_samples));
    }
}



TEST(EstimateNoise, FindsWhatReplicatesDifferBy)
{
  const Noise           truth = usual_noise();
  const Noise           prior{1., 0.003, 0.1, 0.004, 0.003, 0.002};
  std::mt19937_64       random(5);
  std::vector<Contrast> contrasts;
  for (unsigned int i = 0; i < 30; ++i)
    {
      Contrast contrast;
      contrast.series = {series_of(120, 0.001)};
      contrast.level  = 0.11;
      contrast.values =
        sample_noise(contrast.series, contrast.level, truth, random);
      contrasts.push_back(contrast);
    }
  const NoiseEstimate     found = estimate_noise(contrasts, prior);
  const Noise::Logarithms error = found.noise.logarithms() - truth.logarithms();
  EXPECT_EQ(found.n_contrasts, 30u);
  EXPECT_LT(std::abs(error(0)), 0.05);
  EXPECT_LT(std::abs(error(1)), 0.3);
  EXPECT_LT(std::abs(error(2)), 3.5 * std::sqrt(found.covariance(2, 2)));
  // Friction of 0.1 to 0.12 does not tell a gain from an offset: together.
  const auto together = [](const Noise &noise) {
    return std::hypot(noise.gain, noise.offset);
  };
  EXPECT_LT(std::abs(std::log(together(found.noise) / together(truth))), 0.4);
  // Thirty contrasts tell more than the prior.
  EXPECT_LT(found.covariance(1, 1), 0.3 * std::pow(prior_deviations()(1), 2));
}



TEST(EstimateNoise, IsThePriorWithoutReplicates)
{
  const Noise         prior = usual_noise();
  const NoiseEstimate found = estimate_noise({}, prior);
  EXPECT_EQ(found.n_contrasts, 0u);
  EXPECT_EQ((found.noise.logarithms() - prior.logarithms()).norm(), 0.);
  // Of how sensors differ nothing is felt.
  for (Eigen::Index i = 0; i < found.covariance.rows(); ++i)
    EXPECT_DOUBLE_EQ(found.covariance(i, i),
                     i + 1 < found.covariance.rows() ?
                       std::pow(prior_deviations()(i), 2) :
                       0.);
}



// The drift of a sensor whose rows scatter less than those of the other one.
TEST(EstimateNoise, TellsAQuietSensorFromQuietRows)
{
  for (const double by_sensor : {0., 1.})
    {
      Noise truth     = usual_noise();
      truth.by_sensor = by_sensor;
      std::mt19937_64       random(9);
      std::vector<Contrast> contrasts;
      for (unsigned int i = 0; i < 8; ++i)
        {
          Contrast contrast;
          contrast.series = {series_of(200, 5e-4), series_of(200, 1e-4)};
          contrast.series[1].noise_share = 0.2;
          contrast.level                 = 0.11;
          contrast.values =
            sample_noise(contrast.series, contrast.level, truth, random);
          contrasts.push_back(contrast);
        }
      const NoiseEstimate found = estimate_noise(contrasts, usual_noise());
      EXPECT_LT(std::abs(found.noise.by_sensor - by_sensor),
                3. * std::sqrt(found.covariance(8, 8)));
      EXPECT_LT(std::sqrt(found.covariance(8, 8)), 0.2);
    }
}



// Replicates of 10 s and of 1000 s tell whether drift forgets within seconds.
TEST(EstimateNoise, TellsSecondsFromShares)
{
  for (const double by_seconds : {0., 1.})
    {
      Noise truth      = usual_noise();
      truth.by_seconds = by_seconds;
      std::mt19937_64       random(8);
      std::vector<Contrast> contrasts;
      for (unsigned int i = 0; i < 12; ++i)
        {
          Contrast contrast;
          contrast.series             = {series_of(200, 3e-4)};
          contrast.series[0].duration = i % 2 == 0 ? 0.2 : 5.;
          contrast.level              = 0.11;
          contrast.values =
            sample_noise(contrast.series, contrast.level, truth, random);
          contrasts.push_back(contrast);
        }
      const NoiseEstimate found = estimate_noise(contrasts, usual_noise());
      EXPECT_LT(std::abs(found.noise.by_seconds - by_seconds),
                3. * std::sqrt(found.covariance(7, 7)));
      EXPECT_LT(std::sqrt(found.covariance(7, 7)), 0.25);
    }
}



// Rows of correlation 0.8 that were taken for ones of 0.65.
TEST(EstimateNoise, TellsHowLongRowsRemember)
{
  const Noise           truth = usual_noise();
  std::mt19937_64       random(3);
  std::vector<Contrast> contrasts;
  for (unsigned int i = 0; i < 10; ++i)
    {
      Contrast contrast;
      contrast.series              = {series_of(200, 0.001)};
      contrast.series[0].row_share = 1.;
      contrast.series[0].row_decay = 0.8;
      contrast.level               = 0.11;
      contrast.values =
        sample_noise(contrast.series, contrast.level, truth, random);
      contrast.series[0].row_decay = 0.65;
      contrasts.push_back(contrast);
    }
  const NoiseEstimate found = estimate_noise(contrasts, usual_noise());
  EXPECT_NEAR(contrasts[0].series[0].row_kept(found.noise), 0.8, 0.05);
  EXPECT_NEAR(found.noise.row_memory,
              std::log(0.65) / std::log(0.8),
              3. * found.noise.row_memory * std::sqrt(found.covariance(6, 6)));
}
