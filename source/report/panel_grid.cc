// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/panel_grid.h>

#include <slipstep/report/drawing.h>
#include <slipstep/report/text_table.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace SlipStep
{
  namespace
  {
    // In pixels.
    constexpr double legend_height = 34., title_height = 30.,
                     label_height = 62., label_width = 84., right_margin = 14.;
  } // namespace



  const char *const PanelGrid::after_first =
    "unset label\nunset arrow\nunset object\n";



  PanelGrid::PanelGrid(const std::size_t  n_panels,
                       const std::size_t  most_columns,
                       const unsigned int row_height)
    : n_columns(std::clamp<std::size_t>(n_panels, 1, most_columns))
    , n_rows((n_panels + n_columns - 1) / n_columns)
    , row_height(row_height)
  {}



  unsigned int PanelGrid::height() const
  {
    return static_cast<unsigned int>(legend_height) + n_rows * row_height;
  }



  void PanelGrid::begin(std::ostream                   &script,
                        const std::vector<LegendEntry> &legend) const
  {
    const double width = picture_width, total = height();
    script
      << axes_style
      << "unset key\nset title offset 0,-0.6\nset xlabel offset 0,0.3\nset multiplot layout "
      << n_rows << ',' << n_columns << " margins " << label_width / width << ','
      << 1. - right_margin / width << ',' << label_height / total << ','
      << 1. - (legend_height + title_height) / total << " spacing "
      << (label_width + right_margin) / width << ','
      << (label_height + title_height) / total << '\n';

    double       x = label_width;
    const double y = 1. - 0.5 * legend_height / total;
    for (const LegendEntry &entry : legend)
      {
        const auto from_to = [&](const double half_height) {
          std::ostringstream text;
          text << " from screen " << x / width << ',' << y - half_height / total
               << " to screen " << (x + 30.) / width << ','
               << y + half_height / total << ' ';
          return text.str();
        };
        if (entry.is_area)
          script << "set object rectangle" << from_to(6.) << "fillstyle solid "
                 << "noborder fillcolor " << entry.style << '\n';
        else
          script << "set arrow nohead" << from_to(0.) << entry.style << '\n';
        script << "set label " << gnuplot_text(entry.text) << " at screen "
               << (x + 38.) / width << ',' << y << " left\n";
        // Entries without text are further shades of the next.
        x += entry.text.empty() ? 36. : 66. + 8. * text_width(entry.text);
      }
  }



  std::string few_tics(const char   axis,
                       const double lower,
                       const double upper,
                       const bool   is_logarithmic)
  {
    std::ostringstream text;
    text << "set " << axis << "tics ";
    if (!is_logarithmic)
      {
        text << round_up((upper - lower) / 4.) << '\n';
        return text.str();
      }
    const double n_decades = std::log10(upper / lower);
    const int    stride    = std::max(1, static_cast<int>(n_decades / 4.));
    const char  *separator = "(";
    for (int e = std::floor(std::log10(lower)); e <= std::log10(upper);
         e += stride)
      for (const double factor : {1., 2., 5.})
        {
          const double tic = factor * std::pow(10., e);
          if (tic < lower || tic > upper || (factor > 1. && n_decades > 1.7))
            continue;
          // The text as well: gnuplot would write 0.000010.
          text << separator << '"' << tic << "\" " << tic;
          separator = ", ";
        }
    text << (*separator == '(' ? "autofreq\n" : ")\n");
    return text.str();
  }
} // namespace SlipStep
