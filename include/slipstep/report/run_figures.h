// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_run_figures_h
#define slipstep_report_run_figures_h

#include <slipstep/report/run_results.h>

namespace SlipStep
{
  /// A picture of the report.
  struct Picture
  {
    std::string title;
    std::string caption;
    std::string svg; ///< "" if gnuplot did not draw it
    /// Maps of cells are drawn without smoothing, else seams show.
    bool is_map = false;
    /// Repeats for another run what has been shown.
    bool is_secondary = false;
  };

  /// Draw the pictures of the report into @p folder, each with its data and
  /// script: those that the case asks for, friction over displacement, its
  /// beginning enlarged, r over speed, and the state of the contact face.
  std::vector<Picture> draw_pictures(const std::filesystem::path   &folder,
                                     const Parameters              &parameters,
                                     const std::vector<RunResults> &runs,
                                     const Reference               &reference,
                                     std::vector<std::string>      &warnings);
} // namespace SlipStep

#endif
