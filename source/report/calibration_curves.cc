// SPDX-License-Identifier: LGPL-2.1-or-later

// Pictures of measured and fitted curves and of what is left over.

#include <slipstep/report/calibration_figures.h>
#include <slipstep/report/calibration_text.h>
#include <slipstep/report/panel_grid.h>

#include <slipstep/report/drawing.h>
#include <slipstep/report/text_table.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace SlipStep
{
  namespace
  {
    constexpr std::size_t most_panels = 12;

    /// Tests under the same condition, in one frame.
    struct Panel
    {
      std::string                     title;
      std::vector<const TestMisfit *> tests;
      bool                            is_over_time = false;
      Range                           x;
    };

    /// Whether a motion comes back, noise aside, or there is none: then curves
    /// over displacement lie on top of each other.
    bool comes_back(const std::vector<double> &displacement)
    {
      double highest = displacement.front(), lowest = highest;
      double fall = 0., rise = 0.;
      for (const double x : displacement)
        {
          highest = std::max(highest, x);
          lowest  = std::min(lowest, x);
          fall    = std::max(fall, highest - x);
          rise    = std::max(rise, x - lowest);
        }
      return std::min(fall, rise) > 0.01 * (highest - lowest) ||
             !(highest > lowest);
    }

    const std::vector<double> &abscissa(const Panel      &panel,
                                        const TestMisfit &test)
    {
      return panel.is_over_time ? test.time : test.displacement;
    }

    bool is_inside(const Panel &panel, const double x)
    {
      return x >= panel.x.lower && x <= panel.x.upper;
    }

    void find_range(Panel &panel)
    {
      for (const TestMisfit *const test : panel.tests)
        for (const double x : abscissa(panel, *test))
          panel.x.add(x);
      if (!std::isfinite(panel.x.width()))
        panel.x = {0., 1.};
      if (panel.x.width() == 0.)
        panel.x = {panel.x.lower - 0.5, panel.x.upper + 0.5};
    }

    double worst_ratio(const Panel &panel)
    {
      double worst = 0.;
      for (const TestMisfit *const test : panel.tests)
        worst =
          std::max(worst, test->noise > 0. ? noise_ratio(*test) : test->rms);
      return worst;
    }

    /// One panel per condition, as the tests come; of too many the worst ones.
    std::vector<Panel> panels_of(const Calibration &calibration,
                                 std::size_t       &n_left_out)
    {
      std::vector<Panel> panels;
      for (const TestMisfit &test : calibration.tests)
        {
          if (test.measured.empty())
            continue;
          const std::string title =
            test.condition.empty() ? test.name : test.condition;
          auto panel =
            std::find_if(panels.begin(), panels.end(), [&](const Panel &other) {
              return other.title == title;
            });
          if (panel == panels.end())
            panel = panels.insert(panel, Panel{title, {}, false, {}});
          panel->tests.push_back(&test);
          panel->is_over_time =
            panel->is_over_time || comes_back(test.displacement);
        }
      n_left_out =
        panels.size() > most_panels ? panels.size() - most_panels : 0;
      if (n_left_out > 0)
        {
          std::vector<double> ratios;
          for (const Panel &panel : panels)
            ratios.push_back(worst_ratio(panel));
          std::sort(ratios.begin(), ratios.end(), std::greater<double>());
          const double limit = ratios[most_panels - 1];
          panels.erase(std::remove_if(panels.begin(),
                                      panels.end(),
                                      [&](const Panel &panel) {
                                        return worst_ratio(panel) < limit;
                                      }),
                       panels.end());
          panels.resize(std::min(panels.size(), most_panels));
        }
      std::for_each(panels.begin(), panels.end(), find_range);
      return panels;
    }

    /// First, last, lowest and highest point of every column of pixels: the
    /// picture stays the same and the page small.
    Rows extremes_per_column(const Rows       &points,
                             const Range      &x,
                             const std::size_t n_columns)
    {
      if (points.size() <= 4 * n_columns)
        return points;
      Rows       kept;
      const bool is_backward = points.back()[0] < points.front()[0];
      const auto column_of   = [&](const std::vector<double> &point) {
        const double share = (point[0] - x.lower) / x.width();
        return static_cast<std::size_t>(
          std::clamp(is_backward ? 1. - share : share, 0., 1.) *
          (n_columns - 1));
      };
      for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end)
        {
          // Noise of the displacement shall not open a column again.
          const std::size_t column = column_of(points[begin]);
          while (end < points.size() && column_of(points[end]) <= column)
            ++end;
          const auto range =
            std::minmax_element(points.begin() + begin,
                                points.begin() + end,
                                [](const auto &a, const auto &b) {
                                  return a[1] < b[1];
                                });
          std::array<std::size_t, 4> chosen = {
            {begin,
             static_cast<std::size_t>(range.first - points.begin()),
             static_cast<std::size_t>(range.second - points.begin()),
             end - 1}};
          std::sort(chosen.begin(), chosen.end());
          for (std::size_t i = 0; i < chosen.size(); ++i)
            if (i == 0 || chosen[i] != chosen[i - 1])
              kept.push_back(points[chosen[i]]);
        }
      return kept;
    }

    /// The panels whose friction has its peak early, up to some way after it.
    std::vector<Panel> beginnings(const std::vector<Panel> &panels)
    {
      std::vector<Panel> result;
      for (const Panel &panel : panels)
        {
          if (panel.is_over_time)
            continue;
          double distance = 0.;
          bool   is_back  = false;
          for (const TestMisfit *const test : panel.tests)
            {
              const auto peak =
                std::max_element(test->simulated.begin(),
                                 test->simulated.end(),
                                 [](const double a, const double b) {
                                   return std::abs(a) < std::abs(b);
                                 }) -
                test->simulated.begin();
              const double way =
                test->displacement[peak] - test->displacement.front();
              distance = std::max(distance, std::abs(way));
              is_back  = is_back || way < 0.;
            }
          const double length = distance > 0. ? round_up(5. * distance) : 0.;
          if (length == 0. || length > 0.4 * panel.x.width())
            continue;
          Panel beginning = panel;
          if (is_back)
            beginning.x.lower = panel.x.upper - length;
          else
            beginning.x.upper = panel.x.lower + length;
          // A handful of rows shows nothing new when enlarged.
          const auto &x = panel.tests.front()->displacement;
          if (std::count_if(x.begin(), x.end(), [&](const double position) {
                return is_inside(beginning, position);
              }) >= 20)
            result.push_back(beginning);
        }
      return result;
    }

    /// @param ordinate of row i
    template <typename Ordinate>
    Rows thinned_curve(const Panel      &panel,
                       const TestMisfit &test,
                       const std::size_t n_columns,
                       const Ordinate   &ordinate)
    {
      const std::vector<double> &x = abscissa(panel, test);
      // One point beyond the border lets the curve run off the picture.
      const auto is_near = [&](const std::size_t i) {
        return is_inside(panel, x[i]) ||
               (i > 0 && is_inside(panel, x[i - 1])) ||
               (i + 1 < x.size() && is_inside(panel, x[i + 1]));
      };
      Rows points;
      for (std::size_t i = 0; i < x.size(); ++i)
        if (is_near(i) && std::isfinite(x[i]) && std::isfinite(ordinate(i)))
          points.push_back({x[i], ordinate(i)});
      return extremes_per_column(points, panel.x, n_columns);
    }

    /// Columns of pixels per curve; many tests share what a page may weigh.
    std::size_t columns_per_curve(const std::vector<Panel> &panels)
    {
      std::size_t n_tests = 0;
      for (const Panel &panel : panels)
        n_tests += panel.tests.size();
      return std::clamp<std::size_t>(10000 / std::max<std::size_t>(n_tests, 1),
                                     60,
                                     500);
    }

    /// Shades of blue and green for replicates: none looks like the fit.
    std::string measured_style(const std::size_t i)
    {
      static const std::array<const char *, 3> colours = {
        {"#0072B2", "#56B4E9", "#009E73"}};
      return std::string("lc rgb '") + colours[i % colours.size()] + "' lw 1.2";
    }

    const char *const fitted_style = "lc rgb '#D55E00' lw 2.2";
    const char *const mean_style   = "lc rgb '#000000' lw 2.2";
    const char *const band_style   = "rgb '#d9d9d9'";

    void write_axes(std::ostream &script, const Panel &panel)
    {
      const bool is_long = text_width(panel.title) > 44;
      script << "set title " << gnuplot_text(cut_text(panel.title, 62))
             << " font '," << (is_long ? 10 : 13) << "'\nset xlabel '"
             << (panel.is_over_time ? "Time  [s]" : "Displacement  [mm]")
             << "'\nset xrange [" << panel.x.lower - 0.01 * panel.x.width()
             << ':' << panel.x.upper + 0.01 * panel.x.width() << "]\n"
             << few_tics('x', panel.x.lower, panel.x.upper, false);
    }

    /// A friction that does not vary still needs an axis.
    void widen(Range &y)
    {
      if (!std::isfinite(y.width()))
        y = {0., 1.};
      const double margin = y.width() > 0. ?
                              0.06 * y.width() :
                              std::max(0.05 * std::abs(y.upper), 1e-6);
      y.lower -= margin;
      y.upper += margin;
    }

    void write_ordinate(std::ostream &script, const Range &y)
    {
      script << "set yrange [" << y.lower << ':' << y.upper << "]\n"
             << few_tics('y', y.lower, y.upper, false);
    }

    void
    plot_curves(Figure &figure, const Panel &panel, const std::size_t n_columns)
    {
      const std::vector<std::string> columns = {
        panel.is_over_time ? "time_s" : "displacement_mm", "friction"};
      Range       y;
      std::string measured, fitted;
      for (std::size_t i = 0; i < panel.tests.size(); ++i)
        {
          const TestMisfit &test = *panel.tests[i];
          const auto        add  = [&](const std::string         &what,
                               const std::vector<double> &values) {
            const Rows rows =
              thinned_curve(panel, test, n_columns, [&](const std::size_t row) {
                return values[row];
              });
            for (const auto &row : rows)
              y.add(row[1]);
            return figure.add_data(test.name + ", " + what, columns, rows);
          };
          measured += add("measured", test.measured) + " with lines " +
                      measured_style(i) + ", ";
          fitted += (i > 0 ? ", " : "") + add("fitted", test.simulated) +
                    " with lines " + fitted_style;
        }
      // Far above zero, an axis from zero would hide the difference.
      if (y.lower > 0. && y.lower < 0.5 * y.upper)
        y.lower = 0.;
      widen(y);
      write_axes(figure.script(), panel);
      write_ordinate(figure.script(), y);
      figure.script() << "plot " << measured << fitted << '\n';
    }

    /// What the residuals of all tests of a panel have in common, which noise
    /// would hide; none for few rows.
    Rows local_means(const Panel &panel)
    {
      constexpr std::size_t            n_parts = 40, least = 5;
      std::array<double, n_parts>      sum{};
      std::array<std::size_t, n_parts> count{};
      for (const TestMisfit *const test : panel.tests)
        for (std::size_t i = 0; i < test->measured.size(); ++i)
          {
            const double residual = test->measured[i] - test->simulated[i];
            const double share =
              (abscissa(panel, *test)[i] - panel.x.lower) / panel.x.width();
            if (!std::isfinite(residual) || !(share >= 0. && share <= 1.))
              continue;
            const auto part =
              std::min(static_cast<std::size_t>(share * n_parts), n_parts - 1);
            sum[part] += residual;
            ++count[part];
          }
      Rows rows;
      for (std::size_t part = 0; part < n_parts; ++part)
        if (count[part] >= least)
          rows.push_back(
            {panel.x.lower + (part + 0.5) / n_parts * panel.x.width(),
             sum[part] / count[part]});
      return rows.size() > 1 ? rows : Rows();
    }

    /// The band of twice the noise, to be drawn first.
    std::string band_plot(Figure &figure, const Panel &panel, const double band)
    {
      const double left  = panel.x.lower - 0.01 * panel.x.width();
      const double right = panel.x.upper + 0.01 * panel.x.width();
      return figure.add_data("twice the noise",
                             {"position", "lower", "upper"},
                             {{left, -band, band}, {right, -band, band}}) +
             " using 1:2:3 with filledcurves fillcolor " + band_style;
    }

    /// What has to be seen through dense curves, to be drawn last.
    std::string
    overlay_plot(Figure &figure, const Panel &panel, const double band)
    {
      const std::string edge  = " with lines lc rgb '#444444' dt (6,4) lw 1.2";
      const std::string level = exact_text(band);
      std::string       plots = ", " + level + edge + ", -" + level + edge;
      const Rows        means = local_means(panel);
      if (!means.empty())
        plots += ", " +
                 figure.add_data(panel.title + ", local means",
                                 {"position", "mean"},
                                 means) +
                 " with lines " + mean_style;
      return plots;
    }

    void plot_residuals(Figure           &figure,
                        const Panel      &panel,
                        const std::size_t n_columns)
    {
      double      band = 0.;
      Range       y;
      std::string plots;
      for (std::size_t i = 0; i < panel.tests.size(); ++i)
        {
          const TestMisfit &test = *panel.tests[i];
          const Rows        rows =
            thinned_curve(panel, test, n_columns, [&](const std::size_t row) {
              return test.measured[row] - test.simulated[row];
            });
          for (const auto &row : rows)
            y.add(std::abs(row[1]));
          if (std::isfinite(test.noise))
            band = std::max(band, 2. * test.noise);
          plots +=
            ", " +
            figure.add_data(test.name,
                            {panel.is_over_time ? "time_s" : "displacement_mm",
                             "measured_minus_fitted"},
                            rows) +
            " with lines " + measured_style(i);
        }
      y.add(band);
      y.lower = -y.upper;
      widen(y);
      write_axes(figure.script(), panel);
      write_ordinate(figure.script(), y);
      figure.script() << "plot " << band_plot(figure, panel, band) << plots
                      << overlay_plot(figure, panel, band) << '\n';
    }

    template <typename Plot>
    Picture draw(const std::filesystem::path               &folder,
                 const std::string                         &name,
                 const std::array<std::string, 3>          &texts,
                 const std::vector<Panel>                  &panels,
                 const std::vector<PanelGrid::LegendEntry> &legend,
                 const Plot                                &plot,
                 std::vector<std::string>                  &warnings)
    {
      const PanelGrid grid(panels.size(), 2, panels.size() == 1 ? 420 : 290);
      Figure figure(folder, name, texts[0], picture_width, grid.height());
      grid.begin(figure.script(), legend);
      figure.script() << "set ylabel '" << texts[1]
                      << "' offset 0.8\nset xzeroaxis lc rgb '#444444' lw 1 dt "
                         "solid\n";
      for (const Panel &panel : panels)
        {
          plot(figure, panel, columns_per_curve(panels));
          figure.script() << PanelGrid::after_first;
        }
      figure.script() << "unset multiplot\n";
      return finish(figure, texts[0], texts[2], warnings);
    }

    std::string caption_of(const std::vector<Panel> &panels,
                           const std::size_t         n_replicates,
                           const std::size_t         n_left_out)
    {
      std::string caption;
      if (n_replicates > 1)
        caption = "Tests under the same condition share a frame, in different "
                  "shades. ";
      if (n_left_out > 0)
        caption += std::to_string(n_left_out) + " of " +
                   std::to_string(n_left_out + panels.size()) +
                   " conditions are left out: those met best. ";
      return caption;
    }

    std::vector<PanelGrid::LegendEntry>
    legend(const std::string                         &measured,
           const std::size_t                          n_replicates,
           const std::vector<PanelGrid::LegendEntry> &further)
    {
      std::vector<PanelGrid::LegendEntry> entries;
      for (std::size_t i = 0; i < std::min<std::size_t>(n_replicates, 3); ++i)
        entries.push_back({"", measured_style(i)});
      entries.back().text = measured;
      entries.insert(entries.end(), further.begin(), further.end());
      return entries;
    }
  } // namespace



  std::vector<Picture> draw_curves(const std::filesystem::path &folder,
                                   const Calibration           &calibration,
                                   std::vector<std::string>    &warnings)
  {
    std::size_t              n_left_out = 0;
    const std::vector<Panel> panels     = panels_of(calibration, n_left_out);
    if (panels.empty())
      return {};
    std::size_t n_replicates = 0;
    for (const Panel &panel : panels)
      n_replicates = std::max(n_replicates, panel.tests.size());
    const std::string caption = caption_of(panels, n_replicates, n_left_out);
    const auto        curve_legend =
      legend("measured", n_replicates, {{"fitted", fitted_style}});

    std::vector<Picture> pictures = {
      draw(folder,
           "curves",
           {{"Measured and fitted", "Friction  [–]", caption}},
           panels,
           curve_legend,
           plot_curves,
           warnings)};
    const std::vector<Panel> early = beginnings(panels);
    if (!early.empty())
      pictures.push_back(draw(folder,
                              "curves_start",
                              {{"The beginning enlarged", "Friction  [–]", ""}},
                              early,
                              curve_legend,
                              plot_curves,
                              warnings));
    pictures.push_back(
      draw(folder,
           "residuals",
           {{"What is left over",
             "Measured − fitted  [–]",
             caption + "With a law that fits, nearly all lies within the band "
                       "and the local mean, over a fortieth of the width, "
                       "stays near zero."}},
           panels,
           legend("measured − fitted",
                  n_replicates,
                  {{"local mean", mean_style},
                   {"± twice the noise", band_style, true}}),
           plot_residuals,
           warnings));
    return pictures;
  }
} // namespace SlipStep
