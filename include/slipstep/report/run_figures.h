// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_run_figures_h
#define slipstep_report_run_figures_h

#include <slipstep/report/page.h>
#include <slipstep/report/run_results.h>

namespace SlipStep
{
  /// Finished runs, and the pictures of them that have been drawn so far.
  struct RunFigures
  {
    Page             &page;
    const Parameters &parameters;
    const Runs       &runs;
    const Reference  &reference;
    /// As HTML; folded away is what repeats for another run what is shown.
    std::string shown = {}, folded = {};

    /// The parameters that a run had.
    Parameters parameters_of(const RunResults &run) const;

    /// An empty one of the usual width.
    Figure figure(const std::string &name,
                  const std::string &title,
                  const unsigned int height) const;

    /// Draw one more to be shown, see figure_element().
    void add(Figure            &figure,
             const std::string &title,
             const std::string &caption,
             const bool         is_map = false);
  };

  /// What legends call a run.
  std::string legend(const RunResults &run);

  /// Where the names of all runs stand in a picture.
  struct LegendPlace
  {
    bool         is_beside = true;
    std::string  commands;        ///< of gnuplot
    unsigned int more_height = 0; ///< that the picture needs below [pixel]
  };

  /// Beside the curves, in the same place in all pictures, or below them where
  /// there are many names or long ones.
  /// @param others names that are no runs
  /// @param height of the picture [pixel]
  LegendPlace place_legend(const Runs                     &runs,
                           const std::vector<std::string> &others,
                           const unsigned int              height);

  /// The names as a line of the page, for pictures that have no room for them.
  std::string run_legend(const Runs &runs);

  /// Colour of Okabe and Ito (without yellow, which is lost on white) and dash
  /// of a run as gnuplot has it: apart for the colour-blind and in print.
  std::string run_style(const std::size_t i);

  /// Plot a curve of the i-th run in its colour and dash.
  void plot_run(Figure                         &figure,
                const RunResults               &run,
                const std::size_t               i,
                const std::vector<std::string> &columns,
                const Rows                     &points,
                const double                    line_width = 2.,
                const bool                      is_named   = true);

  /// Draw all pictures of the report, first those that the case asks for.
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

  /// Draw measured friction beside the runs: tests that "Report/Measured" names
  /// and those that programmes follow, with what they differ by.
  void add_measured_pictures(RunFigures &figures);

  /// Draw pressure and slip on the contact face at the end of a run, which has
  /// one, as HTML: maps, or lines in two dimensions.
  std::string draw_face(const RunFigures &figures, const std::size_t run);

  /// The law at work, as HTML: friction, the variables of the law and what its
  /// effects remember over the path of the drive, or in words what is constant.
  std::string law_at_work(const RunFigures &figures);

  /// The active effects of all runs with formulas, and their parameters with
  /// symbols, the values of all variants in base units, and units.
  TableLines effect_table(const RunFigures &figures);

  /// The block at moments of a run, from the surface files of BlockOutput:
  /// deformed and coloured, to be turned by hand; without scripts and on paper
  /// a drawing of the last moment. As HTML; "" if no file is there.
  /// @param warnings told of files that cannot be read
  std::string block_picture(const RunResults         &run,
                            std::vector<std::string> &warnings);

  /// The meshes of runs at their end side by side, as HTML; "" if none is
  /// there. Those too fine to be seen are named only.
  std::string mesh_gallery(const std::vector<ReportedRun> &runs,
                           std::vector<std::string>       &warnings);
} // namespace SlipStep

#endif
