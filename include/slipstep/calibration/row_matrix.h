// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_calibration_row_matrix_h
#define slipstep_calibration_row_matrix_h

#include <Eigen/Core>

namespace SlipStep
{
  /// Rows of numbers, one column per quantity, stored by rows.
  using RowMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
} // namespace SlipStep

#endif
