// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_friction_axes_h
#define slipstep_measured_data_friction_axes_h

#include <slipstep/measured_data/measured_test.h>

#include <vector>

namespace SlipStep
{
  /// A direction along which friction was measured, with noise of its own.
  struct FrictionAxis
  {
    /// @name Of the angle to x.
    ///@{
    double cosine = 1., sine = 0.;
    ///@}
    double noise = 0.; ///< standard deviation of a row

    /// The component along the axis.
    double of(const double x, const double y) const
    {
      return cosine * x + sine * y;
    }

    /// The same of every row; @p y may be empty.
    std::vector<double> of(const std::vector<double> &x,
                           const std::vector<double> &y) const;
  };

  /// The independent measurements of friction in a test: along x alone, along x
  /// and y, or along what else their noise tells. The readings of one sensor
  /// that were resolved along x and y are one measurement, along the direction
  /// of the friction; two sensors at an angle to x and y are told by the
  /// correlation of the noise along these.
  std::vector<FrictionAxis> friction_axes(const MeasuredTest &test);

  /// A test with friction and displacement along an axis for those along x.
  MeasuredTest along(const FrictionAxis &axis, const MeasuredTest &test);

  /// Root mean square of the friction of a test, of both axes.
  double typical_friction(const MeasuredTest &rows);

  /// Root of the mean square of the noise along the axes.
  double mean_noise(const std::vector<FrictionAxis> &axes);
} // namespace SlipStep

#endif
