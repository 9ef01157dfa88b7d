// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/bends.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace SlipStep
{
  namespace
  {
    // The row between two others that is farthest from the line between them,
    // and how many tolerances that is.
    std::pair<std::size_t, double>
    farthest_row(const std::vector<double>         &time,
                 const std::vector<BendingChannel> &series,
                 const std::size_t                  begin,
                 const std::size_t                  end)
    {
      std::pair<std::size_t, double> result{begin, 0.};
      for (const BendingChannel &one : series)
        {
          const std::vector<double> &values = *one.values;
          if (one.tolerance == 0.)
            continue;
          const double slope =
            (values[end] - values[begin]) / (time[end] - time[begin]);
          for (std::size_t i = begin + 1; i < end; ++i)
            {
              const double distance =
                std::abs(values[i] - values[begin] -
                         slope * (time[i] - time[begin])) /
                one.tolerance;
              if (distance > result.second)
                result = {i, distance};
            }
        }
      return result;
    }
  } // namespace



  std::vector<std::size_t>
  rows_of_bends(const std::vector<double>         &time,
                const std::vector<BendingChannel> &series,
                std::vector<std::size_t>           rows,
                const double                       factor)
  {
    std::vector<std::pair<std::size_t, std::size_t>> open;
    for (std::size_t i = 1; i < rows.size(); ++i)
      open.emplace_back(rows[i - 1], rows[i]);
    while (!open.empty())
      {
        const auto [begin, end] = open.back();
        open.pop_back();
        const auto [row, distance] = farthest_row(time, series, begin, end);
        if (distance <= factor)
          continue;
        rows.push_back(row);
        open.emplace_back(begin, row);
        open.emplace_back(row, end);
      }
    std::sort(rows.begin(), rows.end());
    return rows;
  }
} // namespace SlipStep
