// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/basis.h>
#include <slipstep/diagnosis/gap.h>
#include <slipstep/diagnosis/track_waves.h>

#include <algorithm>
#include <array>

namespace SlipStep
{
  namespace
  {
    // Rows that are added up before replicates are multiplied: sharp patterns
    // are seen with few, weak slow ones with many.
    constexpr std::array<std::size_t, 4> stretches = {1, 4, 16, 64};

    // Sums over the stretches of the products of two replicates, added to one
    // row of the result per length of a stretch.
    void add_products(const ComparedTest &first,
                      const ComparedTest &second,
                      const RowMatrix    &columns,
                      RowMatrix          &result)
    {
      const std::vector<std::size_t> rows =
        partners(first.series[0].time, second.series[0].time);
      const std::size_t n_series =
        std::min(first.series.size(), second.series.size());
      for (std::size_t l = 0; l < stretches.size(); ++l)
        for (std::size_t s = 0; s < n_series; ++s)
          for (std::size_t i = 0; i < rows.size(); i += stretches[l])
            {
              Eigen::RowVectorXd a = Eigen::RowVectorXd::Zero(columns.cols());
              Eigen::RowVectorXd b = a;
              for (std::size_t j = i;
                   j < std::min(i + stretches[l], rows.size());
                   ++j)
                {
                  a += columns.row(first.begin + s * first.n_bins() + j);
                  b +=
                    columns.row(second.begin + s * second.n_bins() + rows[j]);
                }
              result.row(l) += a.cwiseProduct(b);
            }
    }



    RowMatrix agreement(const Comparison &comparison, const RowMatrix &columns)
    {
      RowMatrix result = RowMatrix::Zero(stretches.size(), columns.cols());
      const std::vector<ComparedTest> &tests = comparison.tests;
      for (std::size_t i = 0; i < tests.size(); ++i)
        for (std::size_t j = i + 1; j < tests.size(); ++j)
          if (tests[i].condition == tests[j].condition)
            add_products(tests[i], tests[j], columns, result);
      return result;
    }
  } // namespace



  double chance_of_agreement(const Comparison      &comparison,
                             const Eigen::VectorXd &residual,
                             const RowMatrix       &null_draws)
  {
    const RowMatrix observed =
      agreement(comparison, residual.head(comparison.n_rows()));
    const RowMatrix       null = agreement(comparison, null_draws);
    const Eigen::VectorXd deviations =
      (null.rowwise().squaredNorm() / null.cols()).cwiseSqrt();
    if (!(deviations.minCoeff() > 0.))
      return 1.;
    std::vector<double> largest;
    for (Eigen::Index draw = 0; draw < null.cols(); ++draw)
      largest.push_back(null.col(draw).cwiseQuotient(deviations).maxCoeff());
    std::sort(largest.begin(), largest.end());
    return share_above(largest,
                       observed.col(0).cwiseQuotient(deviations).maxCoeff());
  }



  void prepare_gap_test(Workspace &workspace)
  {
    const Comparison &comparison = workspace.comparison;
    const Covariates &covariates = workspace.covariates;
    const auto        set = [&](const std::vector<Direction> &directions) {
      return DirectionSet(comparison, workspace.null_draws, directions);
    };
    workspace.smooth      = set(smooth_basis(comparison, covariates));
    workspace.waves       = set(condition_basis(comparison, covariates, 6));
    workspace.wavelengths = track_wavelengths(comparison, covariates);
    workspace.along_track =
      set(track_waves(comparison, covariates, workspace.wavelengths));
  }



  namespace
  {
    // Bonferroni, with most of the chance given to what has a name.
    constexpr double share_of_smooth = 2. / 3.;
    constexpr double share_of_others = (1. - share_of_smooth) / 3.;
  } // namespace



  TrackWave clear_track_wave(const Workspace &workspace, const Model &model)
  {
    TrackWave wave = find_track_wave(workspace.along_track,
                                     workspace.wavelengths,
                                     model,
                                     workspace.null_draws);
    if (wave.p > share_of_others * workspace.level)
      return {};
    wave.wavelength = refined_wavelength(workspace.comparison,
                                         workspace.covariates,
                                         model,
                                         wave.wavelength);
    return wave;
  }



  GapTest
  test_gap(const Workspace &workspace, const Model &model, const View &view)
  {
    const RowMatrix   &null_draws = workspace.null_draws;
    const DirectionSet smooth     = view.set.with(workspace.smooth);
    GapTest            result;
    const ScoreTest    scores(model, null_draws, smooth);
    double             largest = 0.;
    for (const Score &score : scores.scores)
      largest = std::max(largest, score.value);
    result.p_smooth = scores.family_p(largest);

    const ScoreTest::Together saturated =
      ScoreTest(model, null_draws, workspace.waves.with(smooth)).together();
    result.excess     = saturated.excess;
    result.scatter    = saturated.scatter;
    result.explained  = saturated.explained;
    result.p_together = saturated.p;
    result.p_replicates =
      chance_of_agreement(workspace.comparison, model.residual, null_draws);
    result.p_track = find_track_wave(workspace.along_track,
                                     workspace.wavelengths,
                                     model,
                                     null_draws)
                       .p;
    result.p = std::min({1.,
                         result.p_smooth / share_of_smooth,
                         result.p_together / share_of_others,
                         result.p_replicates / share_of_others,
                         result.p_track / share_of_others});
    return result;
  }
} // namespace SlipStep
