// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_figure_h
#define slipstep_report_figure_h

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace SlipStep
{
  /// A block of data of a picture: lines of numbers.
  using Rows = std::vector<std::vector<double>>;

  /// A picture made by gnuplot: collects data and commands, then writes
  /// `<name>.dat`, `<name>.gp` and `<name>.svg`, so that a user can change the
  /// script and draw again with `gnuplot <name>.gp`.
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

    /// A block of data in the plot at the end of the script.
    /// @param style what follows the data, "with lines ..."
    void plot(const std::string              &title,
              const std::vector<std::string> &columns,
              const Rows                     &rows,
              const std::string              &style);

    /// The same of what is no data: "0.1 with lines ...".
    void plot(const std::string &plotted);

    /// Commands of the gnuplot script, after the terminal has been set.
    std::ostream &script();

    /// Write data and script and draw.
    /// @return "" or, when gnuplot is missing, fails or hangs, a warning for the user
    /// @throws RunError if the files cannot be written
    std::string write();

    /// The picture for inclusion in an HTML page: without XML prologue, its
    /// ids made unique by the name, with a label for screen readers and the
    /// place of its axes for the page's script; "" if it was not drawn.
    std::string inline_svg() const;

    std::filesystem::path svg_file() const;

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

  /// Text as gnuplot string in double quotes, with the characters escaped that
  /// would change the font or end the string.
  std::string gnuplot_text(const std::string &text);

  /// Text with the characters escaped that mean something in HTML.
  std::string html_text(const std::string &text);
} // namespace SlipStep

#endif
