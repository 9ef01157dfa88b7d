// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_gallery_h
#define slipstep_report_gallery_h

#include <slipstep/report/page.h>

#include <string>
#include <vector>

namespace SlipStep
{
  /// What a line of a picture means.
  struct LegendLine
  {
    enum Kind
    {
      line,
      dashed,
      points,
      area
    };

    std::string text;
    std::string colour; ///< "#0072B2"
    Kind        kind = line;

    /// As gnuplot has it, for `plot ... with lines`.
    std::string style(const double width = 2.) const
    {
      return "lc rgb '" + colour + "' lw " + exact_text(width) +
             (kind == dashed ? " dt (6,3)" : "");
    }
  };

  /// Small pictures under one heading, which stand side by side where there is
  /// room, and the legend that they share.
  struct Gallery
  {
    std::string             title;
    std::string             caption;
    std::vector<LegendLine> legend;
    std::string             pictures; ///< those that were drawn, as HTML
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
    extern const char *const measured;
    extern const char *const before;
    extern const char *const after;
    extern const char *const band;
  } // namespace Colour

  /// Pictures under their legend, as HTML.
  std::string figures_html(const Gallery &gallery);

  /// The same with heading and caption; of no pictures nothing.
  std::string gallery_section(const Gallery &gallery);
} // namespace SlipStep

#endif
