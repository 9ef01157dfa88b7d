// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_calibration_figures_h
#define slipstep_report_calibration_figures_h

#include <slipstep/calibration/calibration.h>
#include <slipstep/report/gallery.h>

#include <filesystem>
#include <string>
#include <vector>

namespace SlipStep
{
  /// Measured and fitted curves, a picture per condition; the beginning of
  /// those that have an early peak; and what is left over against the noise.
  std::vector<Gallery> draw_curves(const std::filesystem::path &folder,
                                   const Calibration           &calibration,
                                   std::vector<std::string>    &warnings);

  /// How the misfit grows when one parameter is held at other values and the
  /// others are fitted again.
  Gallery draw_fitted_profiles(const std::filesystem::path &folder,
                               const Calibration           &calibration,
                               std::vector<std::string>    &warnings);
} // namespace SlipStep

#endif
