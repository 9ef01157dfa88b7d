// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_run_faces_h
#define slipstep_report_run_faces_h

#include <slipstep/report/run_figures.h>

namespace SlipStep
{
  /// Pressure and slip on the contact face at the end of a run, which has
  /// one: maps, or lines in two dimensions.
  /// @param number distinguishes the files of the runs
  Picture face_picture(const std::filesystem::path &folder,
                       const RunResults            &run,
                       const std::size_t            number,
                       std::vector<std::string>    &warnings);
} // namespace SlipStep

#endif
