// SPDX-License-Identifier: LGPL-2.1-or-later

#include <slipstep/report/gallery.h>
#include <slipstep/utilities/text.h>

namespace SlipStep
{
  namespace
  {
    // On a telephone a picture is as wide as this, with letters as large as
    // those of the text.
    constexpr unsigned int small_width = 430, small_height = 290;

    void widen(Range &range)
    {
      if (!std::isfinite(range.width()))
        range = {0., 1.};
      if (!(range.width() > 0.))
        {
          const double margin = std::max(0.05 * std::abs(range.upper), 1e-6);
          range               = {range.lower - margin, range.upper + margin};
        }
    }

    std::string range_text(const Range &range)
    {
      return "[" + exact_text(range.lower) + ":" + exact_text(range.upper) +
             "]\n";
    }
    std::string legend_html(const std::vector<LegendLine> &legend)
    {
      std::string html = "<p class='legend'>";
      for (const LegendLine &line : legend)
        {
          const std::string kind = line.kind == LegendLine::area   ? "area" :
                                   line.kind == LegendLine::points ? "dot" :
                                   line.kind == LegendLine::dashed ? "dashed" :
                                                                     "line";
          html += "<span><i class='" + kind + "' style='color:" + line.colour +
                  "'></i>" + html_text(line.text) + "</span> ";
        }
      return html + "</p>\n";
    }
  } // namespace



  namespace Colour
  {
    const char *const measured = "#555555";
    const char *const before   = "#D55E00";
    const char *const after    = "#0072B2";
    const char *const band     = "#cde3f2";
  } // namespace Colour



  SmallPicture::SmallPicture(Page              &page,
                             const std::string &name,
                             const std::string &title)
    : Figure(page.pictures, name, title, small_width, small_height)
    , page(page)
  {
    script() << axes_style
             << "unset key\nset lmargin at screen 0.19\nset rmargin at "
                "screen 0.97\nset tmargin at screen 0.96\nset bmargin "
                "at screen 0.19\n";
  }



  void SmallPicture::axes(const std::string &x_label,
                          Range              x,
                          const std::string &y_label,
                          Range              y,
                          const bool         is_x_logarithmic)
  {
    widen(x);
    if (x.lower > 0. && x.lower < 0.05 * x.upper && !is_x_logarithmic)
      x.lower = 0.;
    widen(y);
    const double margin = 0.05 * y.width();
    // Whatever begins at zero shall stand on the axis.
    if (y.lower != 0.)
      y.lower -= margin;
    y.upper += margin;
    script() << "set xlabel " << gnuplot_text(cut_text(x_label, 46))
             << " offset 0,0.6\nset ylabel " << gnuplot_text(y_label)
             << " offset 0.4\nset xrange " << range_text(x) << "set yrange "
             << range_text(y) << (is_x_logarithmic ? "set logscale x\n" : "")
             << few_tics('x', x.lower, x.upper, is_x_logarithmic)
             << "set ytics " << round_up(y.width() / 8.) << '\n';
  }



  void SmallPicture::finish(Gallery &gallery)
  {
    const std::string warning = write();
    const std::string svg     = inline_svg();
    if (!svg.empty())
      gallery.pictures += "<figure><figcaption>" + html_text(title) +
                          "</figcaption>\n" + svg + "</figure>\n";
    if (!warning.empty() && !gallery.has_warned)
      page.warnings.push_back(warning);
    gallery.has_warned = gallery.has_warned || !warning.empty();
  }



  std::string figures_html(const Gallery &gallery)
  {
    return legend_html(gallery.legend) + "<div class='gallery'>\n" +
           gallery.pictures + "</div>\n";
  }



  std::string gallery_section(const Gallery &gallery)
  {
    if (gallery.pictures.empty())
      return "";
    return heading(gallery.title) + figures_html(gallery) +
           note(gallery.caption);
  }
} // namespace SlipStep
