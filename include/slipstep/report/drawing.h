// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_drawing_h
#define slipstep_report_drawing_h

#include <slipstep/report/run_figures.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace SlipStep
{
  /// Interval that grows over what it is shown.
  struct Range
  {
    double lower = std::numeric_limits<double>::infinity();
    double upper = -std::numeric_limits<double>::infinity();

    void add(const double value)
    {
      if (std::isfinite(value))
        {
          lower = std::min(lower, value);
          upper = std::max(upper, value);
        }
    }

    double width() const
    {
      return upper - lower;
    }

    double middle() const
    {
      return 0.5 * (lower + upper);
    }
  };

  /// Width of the pictures [pixel].
  constexpr unsigned int picture_width = 860;

  /// Axes, ticks and grid of all pictures with curves, as gnuplot commands.
  extern const char *const axes_style;

  /// The next of 1, 2, 5, 10, ...
  double round_up(const double value);

  /// Red, green and blue, 0 to 255.
  using Colour3 = std::array<double, 3>;

  /// The colour at a share of the way through others, evenly spaced.
  Colour3 mixed_colour(const std::vector<Colour3> &stops, const double share);

  /// The same as the style of an element with this background.
  std::string background(const std::vector<Colour3> &stops, const double share);

  /// A gnuplot command with some four round numbers on the axis, so that their
  /// texts keep apart: powers of ten and their 2 and 5 on a logarithmic one.
  std::string few_tics(const char   axis,
                       const double lower,
                       const double upper,
                       const bool   is_logarithmic);

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
  LegendPlace place_legend(const std::vector<RunResults>  &runs,
                           const std::vector<std::string> &others,
                           const unsigned int              height);

  /// Colour and dash of a run as gnuplot has it: colours of Okabe and Ito,
  /// distinct for colour-blind readers; dashes keep the curves apart in print.
  /// (Their yellow is lost on white.)
  std::string run_style(const std::size_t i);

  std::string without_dash(const std::string &style);

  /// Drop points that a reader could not tell from the one before.
  Rows thinned(const Rows &points);

  /// Plot a curve of the i-th run in its colour and dash.
  void plot_run(Figure                         &figure,
                const RunResults               &run,
                const std::size_t               i,
                const std::vector<std::string> &columns,
                const Rows                     &points,
                const double                    line_width = 2.,
                const bool                      is_named   = true);

  /// Draw; a picture that could not be drawn has no SVG and gives a warning.
  Picture finish(Figure                   &figure,
                 const std::string        &title,
                 const std::string        &caption,
                 std::vector<std::string> &warnings);
} // namespace SlipStep

#endif
