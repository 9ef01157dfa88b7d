// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/rounding_noise.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    // How far the load point has gone at every number compared.
    std::vector<double> way_of(const ComparedTest &compared,
                               const MeasuredTest &rows)
    {
      std::vector<double> way(rows.time.size(), 0.);
      for (std::size_t i = 1; i < way.size(); ++i)
        way[i] =
          way[i - 1] +
          std::hypot(rows.displacement[i] - rows.displacement[i - 1],
                     rows.displacement_y.empty() ?
                       0. :
                       rows.displacement_y[i] - rows.displacement_y[i - 1]);
      std::vector<double> result;
      for (std::size_t i = 0; i < compared.n_bins(); ++i)
        result.push_back(
          0.5 * (way[compared.borders[i]] + way[compared.borders[i + 1] - 1]));
      return result;
    }



    void add_noise_of(const std::vector<double> &way,
                      const double               step,
                      const double              *friction,
                      double                    *result)
    {
      std::size_t begin = 0, end = 0;
      for (std::size_t i = 0; i < way.size(); ++i)
        {
          while (way[i] - way[begin] > 0.5 * step)
            ++begin;
          while (end < way.size() && way[end] - way[i] <= 0.5 * step)
            ++end;
          if (i > 0 && way[i] == way[i - 1])
            continue; // at rest
          double least = *std::min_element(friction + begin, friction + end);
          double most  = *std::max_element(friction + begin, friction + end);
          // Rows may be farther from each other than a step.
          const auto include = [&](const std::size_t in,
                                   const std::size_t out) {
            const double value =
              friction[in] + (friction[out] - friction[in]) *
                               (0.5 * step - std::abs(way[in] - way[i])) /
                               std::abs(way[out] - way[in]);
            least = std::min(least, value);
            most  = std::max(most, value);
          };
          if (begin > 0)
            include(begin, begin - 1);
          if (end < way.size())
            include(end - 1, end);
          unsigned int n = 1;
          for (std::size_t j = begin + 1; j < end; ++j)
            n += way[j] > way[j - 1];
          result[i] =
            std::hypot(result[i], (most - least) * std::sqrt(n / 12.));
        }
    }
  } // namespace



  Eigen::VectorXd rounding_noise(const Comparison                &comparison,
                                 const std::vector<CampaignTest> &tests,
                                 const Eigen::VectorXd           &friction)
  {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(comparison.n_rows());
    for (std::size_t t = 0; t < tests.size(); ++t)
      {
        const ComparedTest &compared = comparison.tests[t];
        result.segment(compared.begin, compared.size)
          .setConstant(compared.rounding.deviation());
        if (tests[t].motion_step == 0.)
          continue;
        const std::vector<double> way = way_of(compared, tests[t].rows);
        for (std::size_t s = 0; s < compared.series.size(); ++s)
          {
            const Eigen::Index begin = compared.begin + s * compared.n_bins();
            add_noise_of(way,
                         tests[t].motion_step,
                         friction.data() + begin,
                         result.data() + begin);
          }
      }
    return result;
  }
} // namespace SlipStep
