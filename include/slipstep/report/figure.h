// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_figure_h
#define slipstep_report_figure_h

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace SlipStep
{
  /// A block of data of a picture: lines of numbers.
  using Rows = std::vector<std::vector<double>>;

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

    /// Of a column of points.
    void add(const Rows &points, const std::size_t column)
    {
      for (const auto &point : points)
        add(point[column]);
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

  /// A picture made by gnuplot: writes `<name>.dat`, `<name>.gp`, which a user
  /// can change and draw again, and `<name>.svg`.
  class Figure
  {
  public:
    /// @param folder where the files go; has to exist
    /// @param name of the files, without blanks
    /// @param title what the picture shows, for screen readers
    /// @param width,height in pixels of the SVG
    Figure(const std::filesystem::path &folder,
           const std::string           &name,
           const std::string           &title,
           const unsigned int           width,
           const unsigned int           height);

    /// Append a block of data.
    /// @param columns their names with units, for the reader of the file
    /// @param rows one vector of as many numbers as there are columns each
    /// @return what to plot: "'<name>.dat' index N"
    std::string add_data(const std::string              &title,
                         const std::vector<std::string> &columns,
                         const Rows                     &rows);

    /// In the plot at the end of the script: data, "0.1 with lines ..."
    void plot(const std::string &plotted)
    {
      plots += (plots.empty() ? "plot " : ", \\\n  ") + plotted;
    }

    /// Commands of the gnuplot script, after the terminal has been set.
    std::ostream &script()
    {
      return commands;
    }

    /// Write data and script and draw.
    /// @return "" or, when gnuplot is missing, fails or hangs, a warning for the user
    /// @throws RunError if the files cannot be written
    std::string write();

    /// The picture for an HTML page: its ids made unique by the name, with a
    /// label for screen readers and the place of its axes for the page's
    /// script; "" if it was not drawn.
    std::string inline_svg() const;

    std::filesystem::path svg_file() const
    {
      return folder / (name + ".svg");
    }

  protected:
    const std::string title;

  private:
    std::string draw() const;

    const std::filesystem::path folder;
    const std::string           name;
    const unsigned int          width;
    const unsigned int          height;

    std::string        axes; ///< pixels and values of its frame, as text
    unsigned int       n_blocks = 0;
    std::ostringstream data;
    std::ostringstream commands;
    std::string        plots;
  };

  /// As gnuplot has it: "[0:1]"
  inline std::ostream &operator<<(std::ostream &out, const Range &range)
  {
    return out << '[' << range.lower << ':' << range.upper << ']';
  }

  /// Whether nothing but round-off differs.
  bool is_constant(const Range &range);

  /// Wide enough that a change by no more than round-off is none.
  Range without_round_off(const Range &range);

  /// The range with so much of it on either side.
  Range with_margin(const Range &range,
                    const double share,
                    const bool   is_logarithmic = false);

  /// Width of the pictures [pixel].
  constexpr unsigned int picture_width = 860;

  /// Axes, ticks and grid of all pictures with curves, as gnuplot commands.
  constexpr const char *axes_style =
    "set border 3 lw 1 lc rgb '#444444'\n"
    "set tics nomirror out scale 0.6 textcolor rgb '#222222'\n"
    "set grid lc rgb '#dddddd' lw 0.7 dt solid\n"
    "set key outside right top Left reverse samplen 2.5 spacing 1.25\n";

  /// The next of 1, 2, 5, 10, ...
  double round_up(const double value);

  /// Red, green and blue, 0 to 255.
  using Colour3 = std::array<double, 3>;

  /// The colour at a share of the way through others, evenly spaced.
  Colour3 mixed_colour(const std::vector<Colour3> &stops, const double share);

  /// The same as the style of an element with this background, and text that
  /// can be read on it.
  std::string background(const std::vector<Colour3> &stops, const double share);

  /// A gnuplot command with some four round numbers on the axis, so that their
  /// texts keep apart: powers of ten and their 2 and 5 on a logarithmic one.
  std::string few_tics(const char   axis,
                       const double lower,
                       const double upper,
                       const bool   is_logarithmic);

  /// Whether a point is in the same column of pixels as the first one of it.
  using InColumn = std::function<bool(const std::vector<double> &first,
                                      const std::vector<double> &point)>;

  /// First, last, lowest and highest of the points that follow one another in
  /// a column of pixels: of noise its band, of events their height.
  Rows extremes_of_columns(const Rows &points, const InColumn &is_in_column);

  /// Points of a curve that a picture can show one by one.
  constexpr std::size_t most_points = 5000;

  /// Drop points that a reader could not tell from the one before and, of more
  /// than most_points, those that a line through the others hides.
  Rows thinned(const Rows &points);

  /// Text as gnuplot string in double quotes.
  std::string gnuplot_text(std::string text);

  /// Text as HTML has it.
  std::string html_text(std::string text);
} // namespace SlipStep

#endif
