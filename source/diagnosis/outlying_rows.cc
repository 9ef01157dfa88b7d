// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/gap.h>
#include <slipstep/diagnosis/outlying_rows.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    // What the largest residual of a row comes to in noise alone, but for a
    // small chance.
    double largest_by_chance(const Workspace &workspace)
    {
      constexpr double chance = 0.01;

      std::vector<double> largest;
      for (Eigen::Index draw = 0; draw < workspace.null_draws.cols(); ++draw)
        largest.push_back(workspace.null_draws.col(draw).cwiseAbs().maxCoeff());
      std::sort(largest.begin(), largest.end());
      return largest[static_cast<std::size_t>((1. - chance) *
                                              (largest.size() - 1))];
    }
  } // namespace



  // The worst of each test at a time: whitening takes those after it for as
  // far off as it was, and without it they are no worse than others.
  std::vector<Eigen::Index> outlying_rows(const Workspace &workspace,
                                          const Model     &model)
  {
    constexpr double largest_share = 0.02;

    Comparison            comparison = workspace.comparison;
    const double          threshold  = largest_by_chance(workspace);
    const double          most       = largest_share * comparison.n_rows();
    const Eigen::VectorXd difference = comparison.difference(model);
    const Eigen::VectorXd friction   = comparison.measured + difference;

    std::vector<Eigen::Index> result;
    for (bool is_any = true; is_any && result.size() <= most;)
      {
        is_any             = false;
        RowMatrix residual = difference;
        comparison.whiten(residual);
        for (const ComparedTest &test : comparison.tests)
          {
            Eigen::Index worst;
            const double size = residual.middleRows(test.begin, test.size)
                                  .cwiseAbs()
                                  .col(0)
                                  .maxCoeff(&worst);
            if (!(size > threshold))
              continue;
            is_any = true;
            result.push_back(test.begin + worst);
            comparison.weaken_row(result.back(), size);
          }
        comparison.set_noise(comparison.noise(), friction);
      }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result.size() <= most ? result : std::vector<Eigen::Index>();
  }



  void weaken_rows(Workspace                       &workspace,
                   const Model                     &model,
                   const std::vector<Eigen::Index> &rows)
  {
    Comparison           &comparison = workspace.comparison;
    const Eigen::VectorXd friction =
      comparison.measured + comparison.difference(model);
    for (const Eigen::Index row : rows)
      comparison.weaken_row(row, std::abs(model.residual(row)));
    comparison.set_noise(comparison.noise(), friction);
    workspace.null_draws = draw_null(comparison,
                                     workspace.noise,
                                     workspace.null_draws.cols(),
                                     workspace.start.integer("Diagnosis/Seed"));
    prepare_gap_test(workspace);
    workspace.last_scored.reset();
    workspace.left_out.clear();
  }



  std::vector<Outlier>
  outlying_rows_words(const Workspace                 &workspace,
                      const std::vector<Eigen::Index> &rows)
  {
    std::vector<Outlier> result;
    for (std::size_t t = 0; t < workspace.tests.size(); ++t)
      {
        const ComparedTest        &test = workspace.comparison.tests[t];
        const std::vector<double> &time = workspace.tests[t].rows.time;
        std::vector<std::string>   times;
        for (const Eigen::Index row : rows)
          if (row >= test.begin && row < test.begin + test.size)
            times.push_back(short_text(
              time[test.borders[(row - test.begin) % test.n_bins()]]));
        if (times.empty())
          continue;
        const std::size_t n = times.size();
        if (n > 5)
          {
            times.resize(4);
            times.push_back(std::to_string(n - 4) + " more");
          }
        result.push_back({workspace.tests[t].rows.name,
                          counted(n, "number") +
                            " of it that nothing explains, at " +
                            list_text(times) +
                            " s, counted for less: see whether the record is "
                            "right there",
                          true});
      }
    return result;
  }
} // namespace SlipStep
