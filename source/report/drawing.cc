// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/drawing.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <array>

namespace SlipStep
{
  // `extern` in the header keeps it visible: constants are local by default.
  const char *const axes_style =
    "set border 3 lw 1 lc rgb '#444444'\n"
    "set tics nomirror out scale 0.6 textcolor rgb '#222222'\n"
    "set grid lc rgb '#dddddd' lw 0.7 dt solid\n"
    "set key outside right top Left reverse samplen 2.5 spacing 1.25\n";



  std::string legend(const RunResults &run)
  {
    if (!run.short_label.empty())
      return run.short_label;
    return run.summary.slides.empty() ? run.summary.command :
                                        speed_text(run.summary.slides[0].speed);
  }



  LegendPlace place_legend(const std::vector<RunResults>  &runs,
                           const std::vector<std::string> &others,
                           const unsigned int              height)
  {
    std::vector<std::string> names = others;
    for (const RunResults &run : runs)
      names.push_back(legend(run));
    std::size_t longest = 0;
    for (const std::string &name : names)
      longest = std::max(longest, name.size());

    // What is drawn beside a name, with a margin, and 8 pixels a letter. (Left
    // to itself, gnuplot takes more than browsers need.)
    const double           width      = 80. + 8. * longest;
    constexpr unsigned int row_height = 29, above_and_below = 90;
    LegendPlace            place;
    place.is_beside = width <= 0.4 * picture_width &&
                      row_height * names.size() + above_and_below <= height;
    if (place.is_beside)
      {
        const double edge = 1. - width / picture_width;
        place.commands    = "set rmargin at screen " + short_text(edge) +
                         "\nset key at screen " + short_text(edge + 0.02) +
                         ", graph 1 left top\n";
        return place;
      }
    const unsigned int n_columns =
      std::max(1, static_cast<int>(picture_width / width));
    place.more_height =
      row_height * ((names.size() + n_columns - 1) / n_columns);
    place.commands = "set key outside below left Left reverse maxcols " +
                     std::to_string(n_columns) + "\n";
    return place;
  }



  std::string run_style(const std::size_t i)
  {
    static const std::array<const char *, 7> colours = {"#0072B2",
                                                        "#D55E00",
                                                        "#009E73",
                                                        "#CC79A7",
                                                        "#E69F00",
                                                        "#56B4E9",
                                                        "#000000"};
    static const std::array<const char *, 4> dashes  = {"solid",
                                                        "(12,4)",
                                                        "(4,3)",
                                                        "(12,4,3,4)"};
    return std::string("lc rgb '") + colours[i % colours.size()] + "' dt " +
           dashes[i % dashes.size()];
  }



  std::string without_dash(const std::string &style)
  {
    return style.substr(0, style.find(" dt "));
  }



  Rows thinned(const Rows &points)
  {
    Range x, y;
    for (const auto &point : points)
      {
        x.add(point[0]);
        y.add(point[1]);
      }
    const double dx = std::max(x.width(), 1e-300);
    const double dy = std::max(y.width(), 1e-300);

    Rows        kept;
    std::size_t last = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        const double distance =
          std::hypot((points[i][0] - points[last][0]) / dx,
                     (points[i][1] - points[last][1]) / dy);
        if (i > 0 && i + 1 < points.size() && distance < 1e-3)
          continue;
        // Keeps corners: the curve may have rested before it jumped.
        if (i > last + 1 && distance > 3e-3)
          kept.push_back(points[i - 1]);
        kept.push_back(points[i]);
        last = i;
      }
    return kept;
  }



  double round_up(const double value)
  {
    const double decade = std::pow(10., std::floor(std::log10(value)));
    for (const double factor : {1., 2., 5.})
      if (factor * decade >= value * (1. - 1e-9))
        return factor * decade;
    return 10. * decade;
  }



  Colour3 mixed_colour(const std::vector<Colour3> &stops, const double share)
  {
    const double      at = (stops.size() - 1) * std::clamp(share, 0., 1.);
    const std::size_t begin =
      std::min(static_cast<std::size_t>(at), stops.size() - 2);
    Colour3 colour;
    for (unsigned int c = 0; c < 3; ++c)
      colour[c] =
        std::round(stops[begin][c] +
                   (at - begin) * (stops[begin + 1][c] - stops[begin][c]));
    return colour;
  }



  std::string background(const std::vector<Colour3> &stops, const double share)
  {
    const auto [red, green, blue] = mixed_colour(stops, share);
    return "background:rgb(" + exact_text(red) + "," + exact_text(green) + "," +
           exact_text(blue) + ")";
  }



  void plot_run(Figure                         &figure,
                const RunResults               &run,
                const std::size_t               i,
                const std::vector<std::string> &columns,
                const Rows                     &points,
                const double                    line_width,
                const bool                      is_named)
  {
    figure.plot(legend(run),
                columns,
                thinned(points),
                "with lines lw " + exact_text(line_width) + " " + run_style(i) +
                  (is_named ? " title " + gnuplot_text(legend(run)) :
                              " notitle"));
  }



  Picture finish(Figure                   &figure,
                 const std::string        &title,
                 const std::string        &caption,
                 std::vector<std::string> &warnings)
  {
    const std::string warning = figure.write();
    if (!warning.empty())
      warnings.push_back(warning);
    return {title, caption, figure.inline_svg()};
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
