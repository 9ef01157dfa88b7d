// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_arc_h
#define slipstep_measured_data_arc_h

#include <slipstep/measured_data/measured_test.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace SlipStep
{
  /// A part of the way from one row to the next.
  struct PartOfWay
  {
    dealii::Tensor<1, 2> to;         ///< where it ends, as position() [mm]
    double               begin, end; ///< shares of the time, from 0 to 1
  };

  /// The way that ends at a row, from the row before: straight, but where the
  /// rows around it lie on a smooth curve in parts that turn with that.
  /// Friction at a row is against the motion there, not against the chord to
  /// it, which is half a turn behind; so the last part is short.
  ///
  /// The curve is the cubic with the velocities that the parabolas through
  /// three rows have at the middle one.
  std::vector<PartOfWay> way_to(const MeasuredTest &test,
                                const std::size_t   row);
} // namespace SlipStep

#endif
