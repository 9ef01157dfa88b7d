// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_run_figures_h
#define slipstep_report_run_figures_h

#include <slipstep/report/figure.h>
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

  /// Finished runs, and the pictures of them that have been drawn so far.
  struct RunFigures
  {
    const std::filesystem::path    folder; ///< of data and scripts
    const Parameters              &parameters;
    const std::vector<RunResults> &runs;
    const Reference               &reference;
    std::vector<std::string>      &warnings;
    std::vector<Picture>           pictures = {};

    /// The parameters that a run had.
    Parameters parameters_of(const RunResults &run) const;

    /// Draw one more; if that fails, it has no SVG and gives a warning.
    Picture &add(Figure            &figure,
                 const std::string &title,
                 const std::string &caption = "");
  };

  /// Draw all pictures of the report, each with its data and script: those that
  /// the case asks for, friction over displacement, its beginning enlarged, r
  /// over speed, and the state of the contact face.
  void draw_pictures(RunFigures &figures);

  /// Draw what "Report/Pictures" names, all runs in one; what the runs have no
  /// values of is left out with a warning.
  void add_requested_pictures(RunFigures &figures);

  /// Names that "Report/Pictures" knows, separated by commas.
  std::string picture_quantity_names();

  /// Check "Report/Pictures".
  /// @throws InputError for what is not "QUANTITY over QUANTITY"
  void check_pictures(const Parameters &parameters);

  /// Draw peak and kinetic friction as heat maps if the runs are all
  /// combinations of the values of two keys.
  void add_grid_pictures(RunFigures &figures);

  /// Draw measured friction beside the runs: tests that their programmes follow
  /// and those that "Report/Measured" names.
  /// What they differ by is told where a programme follows a test.
  void add_measured_pictures(RunFigures &figures);

  /// Draw pressure and slip on the contact face at the end of a run, which has
  /// one: maps, or lines in two dimensions.
  void add_face_picture(RunFigures &figures, const std::size_t run);
} // namespace SlipStep

#endif
