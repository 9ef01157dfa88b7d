// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_calibration_figures_h
#define slipstep_report_calibration_figures_h

#include <slipstep/calibration/calibration.h>
#include <slipstep/report/run_figures.h>

#include <filesystem>
#include <string>
#include <vector>

namespace SlipStep
{
  /// Measured and fitted curves, one panel per condition, and below them what
  /// is left over against the noise.
  std::vector<Picture> draw_curves(const std::filesystem::path &folder,
                                   const Calibration           &calibration,
                                   std::vector<std::string>    &warnings);

  /// How the misfit grows when one parameter is held at other values and the
  /// others are fitted again; without profiles there is no picture.
  std::vector<Picture> draw_profiles(const std::filesystem::path &folder,
                                     const Calibration           &calibration,
                                     std::vector<std::string>    &warnings);
} // namespace SlipStep

#endif
