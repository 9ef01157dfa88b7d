// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <slipstep/diagnosis/track_waves.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/utilities/lists.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace SlipStep
{
  using dealii::numbers::PI;

  namespace
  {
    constexpr unsigned int n_shifts = 4;

    // From the row before in the same test, or to the next one [mm]; infinite
    // at rest.
    Eigen::VectorXd distances(const Comparison &comparison,
                              const Covariates &covariates)
    {
      Eigen::VectorXd result = Eigen::VectorXd::Zero(comparison.n_rows());
      for (const ComparedTest &test : comparison.tests)
        for (Eigen::Index i = 1; i < test.size; ++i)
          if (i != Eigen::Index(test.n_bins()))
            {
              const Eigen::Index row = test.begin + i;
              result(row) =
                std::abs(covariates.track(row) - covariates.track(row - 1));
              result(row - 1) = std::max(result(row - 1), result(row));
            }
      return (covariates.speed.array() > 0.)
        .select(result, std::numeric_limits<double>::infinity());
    }



    double track_of(const ComparedTest &test, const Covariates &covariates)
    {
      const auto x = covariates.track.segment(test.begin, test.size);
      return x.maxCoeff() - x.minCoeff();
    }



    // What is less beside the longest track is no motion along it.
    constexpr double least_track_share = 1e-3;



    // Of most tests; few may go much farther [mm].
    double usual_track(const Comparison &comparison,
                       const Covariates &covariates)
    {
      std::vector<double> tracks;
      for (const ComparedTest &test : comparison.tests)
        tracks.push_back(track_of(test, covariates));
      const double longest =
        tracks.empty() ? 0. : *std::max_element(tracks.begin(), tracks.end());
      remove_erase_if(tracks, [&](const double track) {
        return !(track > least_track_share * longest);
      });
      return tracks.empty() ? 0. : median(tracks);
    }
  } // namespace



  std::vector<double> track_wavelengths(const Comparison &comparison,
                                        const Covariates &covariates)
  {
    // More of them would cost more than they find.
    constexpr double most_waves = 32.;

    const double        track = usual_track(comparison, covariates);
    std::vector<double> result;
    if (!(track > 0.))
      return result;
    // A wave between two of these is an eighth out of step at the ends.
    for (double n_waves = 2.; n_waves <= most_waves; n_waves += 0.5)
      result.push_back(track / n_waves);
    return result;
  }



  std::vector<Direction> track_waves(const Comparison          &comparison,
                                     const Covariates          &covariates,
                                     const std::vector<double> &wavelengths)
  {
    // With room for round-off.
    constexpr double most_of_wave = 0.25 * (1. + 1e-6);

    Eigen::VectorXd distance = distances(comparison, covariates);
    const double    least =
      least_track_share * usual_track(comparison, covariates);
    for (const ComparedTest &test : comparison.tests)
      if (!(track_of(test, covariates) > least))
        distance.segment(test.begin, test.size)
          .setConstant(std::numeric_limits<double>::infinity());
    std::vector<Direction> result;
    for (const double wavelength : wavelengths)
      for (unsigned int k = 0; k < n_shifts; ++k)
        {
          Direction direction;
          direction.friction = covariates.friction;
          for (Eigen::Index i = 0; i < direction.friction.size(); ++i)
            direction.friction(i) *=
              distance(i) > most_of_wave * wavelength ?
                0. :
                std::cos(PI * (2. * covariates.track(i) / wavelength -
                               double(k) / n_shifts));
          result.push_back(direction);
        }
    return result;
  }



  TrackWave find_track_wave(const DirectionSet        &waves,
                            const std::vector<double> &wavelengths,
                            const Model               &model,
                            const RowMatrix           &null_draws)
  {
    if (wavelengths.empty())
      return {};
    const ScoreTest test(model, null_draws, waves);
    const auto      clearest = std::max_element(test.scores.begin(),
                                           test.scores.end(),
                                           [](const Score &a, const Score &b) {
                                             return a.value < b.value;
                                           });
    return {test.family_p(clearest->value),
            wavelengths[(clearest - test.scores.begin()) / n_shifts],
            clearest->value};
  }



  double refined_wavelength(const Comparison &comparison,
                            const Covariates &covariates,
                            const Model      &model,
                            const double      wavelength)
  {
    // Of a wave, at the end of the longest track; and how far the next of
    // track_wavelengths() is.
    constexpr double step = 0.125, reach = 0.5;

    double longest = 0.;
    for (const ComparedTest &test : comparison.tests)
      longest = std::max(longest, track_of(test, covariates));
    const double waves = usual_track(comparison, covariates) / wavelength;
    const double steps = std::ceil(reach / waves * longest / wavelength / step);
    const int    n     = static_cast<int>(std::min(steps, 200.));
    // No chances are asked for.
    const RowMatrix no_draws = RowMatrix::Zero(comparison.n_rows(), 2);
    const auto      tried    = [&](const double i) {
      return wavelength * waves / (waves + reach * i / n);
    };
    std::vector<double> gains;
    for (int i = -n; i <= n; ++i)
      gains.push_back(ScoreTest(comparison,
                                model,
                                no_draws,
                                track_waves(comparison, covariates, {tried(i)}))
                        .together()
                        .gain);
    const auto largest = std::max_element(gains.begin(), gains.end());
    if (!(*largest > 0.))
      return wavelength;
    const double best = static_cast<double>(largest - gains.begin()) - n;
    if (std::abs(best) == n)
      return tried(best);
    // The top of the parabola through the largest and those beside it.
    const double below = largest[-1] - *largest, above = largest[1] - *largest;
    return tried(below + above < 0. ?
                   best + (below - above) / (2. * (below + above)) :
                   best);
  }
} // namespace SlipStep
