// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_block_view_h
#define slipstep_report_block_view_h

#include <slipstep/report/run_figures.h>

namespace SlipStep
{
  /// The block with its mesh at moments of a run, from the surface files of
  /// BlockOutput: deformed, coloured by stress, displacement or what the
  /// contact plane bears, to be turned by hand. Without scripts and on paper a
  /// drawing of the last moment. As HTML; "" if no file is there.
  /// @param warnings told of files that cannot be read
  std::string block_picture(const RunResults         &run,
                            std::vector<std::string> &warnings);

  /// The meshes of runs at their end side by side, as HTML; "" if none is
  /// there. Those too fine to be seen are named only.
  std::string mesh_gallery(const std::vector<ReportedRun> &runs,
                           std::vector<std::string>       &warnings);
} // namespace SlipStep

#endif
