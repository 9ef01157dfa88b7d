// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_page_h
#define slipstep_report_page_h

#include <slipstep/report/figure.h>
#include <slipstep/report/text_table.h>
#include <slipstep/utilities/parameters.h>

namespace SlipStep
{
  /// report.html in the making, and a folder `report` beside it with the data
  /// and scripts of its pictures.
  struct Page
  {
    /// Creates the folders.
    explicit Page(const std::filesystem::path &folder);

    /// Draw a picture: its SVG, or "" and a warning.
    std::string svg_of(Figure &figure);

    /// html_page() into the file.
    /// @throws RunError if the disk refuses
    void write(const std::string &title,
               const std::string &headline,
               const std::string &content) const;

    const std::filesystem::path file;
    const std::filesystem::path pictures; ///< the folder
    std::vector<std::string>    warnings; ///< for the user
  };

  /// A page complete in itself: style, heading, content, and the program's
  /// version at its end.
  /// @param title,headline plain text
  /// @param content HTML
  std::string html_page(const std::string &title,
                        const std::string &headline,
                        const std::string &content);

  /// What "Report/Title" says, or else the name of the case.
  /// @param name of the case if not that of its file
  std::string title_of(const Parameters  &parameters,
                       const std::string &name = "");

  std::string heading(const std::string &text);

  /// @param kind its style
  std::string paragraph(const std::string &text, const std::string &kind = "");

  /// Small grey text; of none nothing.
  std::string note(const std::string &text);

  /// How the user calls the program with a case: "slipstep point case.prm", or
  /// by the script that was used, or under mpirun.
  std::string program_call(const std::string &command,
                           const std::string &file,
                           const unsigned int n_ranks = 1);

  /// The call of a case with the options --set and --sweep that the user gave,
  /// as HTML.
  std::string case_call(const std::string &command,
                        const Parameters  &parameters,
                        const unsigned int n_ranks = 1);

  /// What the reader has to know first, each in a box.
  std::string problem_boxes(const std::vector<std::string> &texts);

  /// A table, the first line being its head.
  /// @param kind style: "numbers", with "unbroken" also of long cells, or "values"
  std::string html_table(const TableLines  &lines,
                         const std::string &kind = "numbers");

  /// A table with its heading and what it means; nothing if it has a head only.
  std::string table_section(const std::string &title,
                            const TableLines  &lines,
                            const std::string &meaning = "",
                            const std::string &kind    = "numbers");

  /// A picture with heading and caption; nothing if it was not drawn.
  /// @param is_map of cells: drawn without smoothing, else seams show
  /// @param legend see legend_line()
  std::string figure_element(const std::string &title,
                             const std::string &svg,
                             const std::string &caption,
                             const bool         is_map = false,
                             const std::string &legend = "");

  /// What a line of a picture means.
  struct LegendLine
  {
    std::string text;
    std::string colour;        ///< "#0072B2"
    std::string kind = "line"; ///< as style: or "dashed", "dot", "area"

    /// As gnuplot has it, for `plot ... with lines`.
    std::string style(const double width = 2.) const
    {
      return "lc rgb '" + colour + "' lw " + exact_text(width) +
             (kind == "dashed" ? " dt (6,3)" : "");
    }
  };

  /// Small pictures under one heading, which stand side by side where there is
  /// room, and the legend that they share.
  struct Gallery
  {
    std::string             title;
    std::string             caption;
    std::vector<LegendLine> legend;
    std::string             pictures   = {}; ///< those that were drawn, as HTML
    bool                    has_warned = false; ///< of one that was not
  };

  /// A small picture: its frame is the same in all galleries.
  class SmallPicture : public Figure
  {
  public:
    /// @param name of its files
    SmallPicture(Page &page, const std::string &name, const std::string &title);

    /// Axes; a range of no width is widened.
    void axes(const std::string &x_label,
              Range              x,
              const std::string &y_label,
              Range              y,
              const bool         is_x_logarithmic = false);

    /// A line all across the picture at this height.
    void plot_level(const double level, const std::string &style)
    {
      plot(exact_text(level) + " with lines " + style);
    }

    /// Draw; nothing is added to the gallery if gnuplot is missing, of which
    /// there is one warning per gallery.
    void finish(Gallery &gallery);

  private:
    Page &page;
  };

  /// "speed  [mm/s]", "r  [–]"
  inline std::string axis_label(const std::string &name,
                                const std::string &unit)
  {
    return name + "  [" + (unit.empty() ? "–" : unit) + "]";
  }

  /// Colours that colour-blind readers tell apart, the same in all pictures.
  namespace Colour
  {
    constexpr const char *measured = "#555555", *before = "#D55E00",
                         *after = "#0072B2", *band = "#cde3f2";
  } // namespace Colour

  /// Pictures with legend, heading and caption, as HTML; of no pictures
  /// nothing.
  std::string gallery_section(const Gallery &gallery);

  /// Names of lines, as HTML.
  std::string legend_line(const std::vector<LegendLine> &lines);
} // namespace SlipStep

#endif
