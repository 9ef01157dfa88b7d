// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_resample_h
#define slipstep_measured_data_resample_h

#include <slipstep/measured_data/measured_test.h>

#include <cstddef>
#include <limits>
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

  struct ResampleOptions
  {
    /// A tolerance is this many standard deviations of the channel's noise, see
    /// noise_level() ...
    double noise_multiple = 4.;

    /// ... but not less than this share of the channel's range (of the largest
    /// value for the pressure).
    double least_share = 0.001;

    /// Positions are known to half of this step [mm]: when a rest begins and
    /// ends is not known to the row then.
    double motion_step = 0.;

    /// The tolerances grow until no more rows are left; rows that are kept in
    /// any case may be more.
    std::size_t most_rows = std::numeric_limits<std::size_t>::max();
  };



  /// Fewer rows of a test that tell the same.
  struct ResampledTest
  {
    MeasuredTest test;

    /// The rows kept, in order, as numbers in the full test. Their values are
    /// untouched.
    std::vector<std::size_t> rows;

    /// @name Largest distance of any row from the straight line between the
    /// rows kept before and after it.
    ///@{
    double displacement_tolerance = 0.; ///< [mm]
    double pressure_tolerance     = 0.; ///< [MPa]
    double friction_tolerance     = 0.;
    ///@}
  };

  /// Leave out rows that lie on a straight line in time between others, within
  /// a tolerance of displacement, pressure and friction (also of the second
  /// axis and the temperature, if there are any), by the algorithm of Ramer,
  /// Douglas and Peucker with the distance taken at equal times. Of positions
  /// along both axes the tolerance is far smaller, since friction follows their
  /// direction.
  ///
  /// These rows are kept in any case: first and last, the extremes of friction,
  /// the reversals of the displacement, the extremes of friction in every
  /// stroke, and the ends of rests, along either axis. Peaks are therefore
  /// exact to the last bit, and the frictional work between any two rows kept
  /// differs by less than tolerance times path, work on the average of noise by
  /// much less.
  ResampledTest resample(const MeasuredTest    &test,
                         const ResampleOptions &options = {});

  /// Frictional work per area, the integral of friction times pressure over the
  /// displacement by the trapezoidal rule [N/mm].
  double frictional_work(const MeasuredTest &test);
} // namespace SlipStep

#endif
