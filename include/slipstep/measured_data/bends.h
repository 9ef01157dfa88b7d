// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_bends_h
#define slipstep_measured_data_bends_h

#include <cstddef>
#include <vector>

namespace SlipStep
{
  /// A channel, and how far its rows may be from straight lines.
  struct BendingChannel
  {
    const std::vector<double> *values;
    double                     tolerance; ///< 0: it is not looked at
  };

  /// The rows at which a record bends: no row of any series is farther than its
  /// tolerance, times @p factor, from the straight lines in time between them.
  /// By the algorithm of Ramer, Douglas and Peucker with the distance taken at
  /// equal times.
  /// @param rows to begin with, in order, the first and the last one of all
  ///   among them
  std::vector<std::size_t>
  rows_of_bends(const std::vector<double>         &time,
                const std::vector<BendingChannel> &series,
                std::vector<std::size_t>           rows,
                const double                       factor = 1.);
} // namespace SlipStep

#endif
