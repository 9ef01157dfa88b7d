// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_point_lines_h
#define slipstep_solid_point_lines_h

#include <slipstep/solid/block.h>

#include <filesystem>
#include <string>
#include <vector>

namespace SlipStep
{
  /// Points from one to another, equally spaced, both included.
  struct PointLine
  {
    std::string          name;       ///< as written
    dealii::Tensor<1, 3> begin, end; ///< [mm]
    unsigned int         n_points = 101;
  };

  /// Declares "Output/Lines".
  void declare_lines(Parameters &parameters);

  /// @throws InputError if a line is not understood or leaves the block
  std::vector<PointLine> parse_lines(const Parameters      &parameters,
                                     const BlockParameters &block);

  /// Write lines.csv, a row per point: the number of its line, the distance
  /// from where it begins, its place, and its displacement in space. All ranks
  /// take part. Nothing is written if there are no lines.
  /// @throws RunError if the disk refuses
  template <int dim>
  void write_lines(const std::filesystem::path  &folder,
                   const std::vector<PointLine> &lines,
                   const Block<dim>             &block,
                   const MPI_Comm               &communicator);
} // namespace SlipStep

#endif
