// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/gap.h>
#include <slipstep/diagnosis/outlying_rows.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  std::vector<Eigen::Index> outlying_rows(const Workspace &workspace,
                                          const Model     &model)
  {
    constexpr double chance = 0.01, largest_share = 0.02;

    std::vector<double> largest;
    for (Eigen::Index draw = 0; draw < workspace.null_draws.cols(); ++draw)
      largest.push_back(workspace.null_draws.col(draw).cwiseAbs().maxCoeff());
    std::sort(largest.begin(), largest.end());
    const double threshold =
      largest[static_cast<std::size_t>((1. - chance) * (largest.size() - 1))];
    const Eigen::Index        n = workspace.comparison.n_rows();
    std::vector<Eigen::Index> result;
    for (Eigen::Index row = 0; row < n; ++row)
      if (std::abs(model.residual(row)) > threshold)
        result.push_back(row);
    return result.size() <= largest_share * n ? result :
                                                std::vector<Eigen::Index>();
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
