// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/gap.h>
#include <slipstep/diagnosis/outlying_rows.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <optional>
#include <set>

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



    // Of these rows the farthest of each test that is farther than that.
    std::vector<Eigen::Index> farthest_rows(const Comparison &comparison,
                                            const std::vector<Eigen::Index> &of,
                                            const Eigen::VectorXd &distance,
                                            const double           threshold)
    {
      std::vector<Eigen::Index> result;
      for (const ComparedTest &test : comparison.tests)
        {
          std::optional<Eigen::Index> farthest;
          for (const Eigen::Index row : of)
            if (test.has_row(row) &&
                distance(row) >
                  (farthest.has_value() ? distance(*farthest) : threshold))
              farthest = row;
          if (farthest.has_value())
            result.push_back(*farthest);
        }
      return result;
    }
  } // namespace



  std::vector<Eigen::Index> weaken_outlying_rows(Workspace   &workspace,
                                                 const Model &model)
  {
    constexpr double largest_share = 0.02;

    Comparison            comparison = workspace.comparison;
    const double          most       = largest_share * comparison.n_rows();
    const double          threshold  = largest_by_chance(workspace);
    const Eigen::VectorXd difference = comparison.difference(model);
    const auto            distances  = [&]() {
      RowMatrix whitened = difference;
      comparison.whiten(whitened);
      return Eigen::VectorXd(whitened.cwiseAbs());
    };
    if (difference.size() == 0)
      return {};
    Eigen::VectorXd        distance = distances();
    std::set<Eigen::Index> result;
    const auto             weaken = [&](const std::vector<Eigen::Index> &rows) {
      for (const Eigen::Index row : rows)
        comparison.weaken_row(row, distance(row));
      comparison.set_noise(comparison.noise(),
                           comparison.measured + difference);
      distance = distances();
      result.insert(rows.begin(), rows.end());
    };

    // The farthest spikes first: whitening takes the rows after one for as far
    // off as it is, and without it they are no farther than others.
    std::vector<Eigen::Index> spikes = comparison.spikes_of_records(), rows;
    while (
      result.size() <= most &&
      !(rows = farthest_rows(comparison, spikes, distance, threshold)).empty())
      {
        weaken(rows);
        remove_erase_if(spikes, [&](const Eigen::Index row) {
          return result.count(row) > 0;
        });
      }
    std::vector<Eigen::Index> others;
    for (Eigen::Index row = 0; row < distance.size(); ++row)
      if (distance(row) > threshold)
        others.push_back(row);
    if (result.size() + others.size() <= most)
      weaken(others);
    if (result.empty() || result.size() > most)
      return {};

    workspace.comparison = comparison;
    workspace.null_draws = draw_null(comparison,
                                     workspace.noise,
                                     workspace.null_draws.cols(),
                                     workspace.start.integer("Diagnosis/Seed"));
    prepare_gap_test(workspace);
    workspace.scored.clear();
    workspace.left_out.clear();
    return {result.begin(), result.end()};
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
          if (test.has_row(row))
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
                          counted(n, "number") + " that nothing explains, at " +
                            list_text(times) +
                            " s, had less weight: check whether the record is "
                            "right there",
                          true});
      }
    return result;
  }
} // namespace SlipStep
