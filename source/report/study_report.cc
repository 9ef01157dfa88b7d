// SPDX-License-Identifier: LGPL-2.1-or-later

// The pictures and the HTML of a refinement study.

#include <slipstep/report/run_figures.h>
#include <slipstep/report/page.h>
#include <slipstep/report/study_report.h>
#include <slipstep/utilities/text.h>

#include <array>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// Colours of Okabe and Ito; shapes and dashes tell the same in print.
    std::string style_of(const StudySequence::Kind kind)
    {
      return kind == StudySequence::Kind::uniform ?
               "lc rgb '#0072B2' dt solid pt 7 ps 0.9 lw 2" :
             kind == StudySequence::Kind::adaptive ?
               "lc rgb '#D55E00' dt (12,4) pt 5 ps 0.9 lw 2" :
               "lc rgb '#009E73' dt (4,3) pt 9 ps 1.1 lw 2";
    }

    /// Steps, or unknowns.
    double count(const StudyPoint &point, const bool is_time)
    {
      return is_time ? point.summary.steps : point.summary.dofs;
    }

    /// A straight line below the last two errors of the curve with the order
    /// that it shows; no rows if it shows none.
    Rows guide_of(const StudyCurve &curve, const bool is_time)
    {
      std::vector<const StudyPoint *> shown;
      for (const StudyPoint &point : curve.points)
        if (std::isfinite(point.error))
          shown.push_back(&point);
      if (shown.size() < 2 || !std::isfinite(curve.order))
        return {};
      const StudyPoint &a = *shown[shown.size() - 2], &b = *shown.back();
      const double      n_a = count(a, is_time), n_b = count(b, is_time);
      const double      slope = curve.order / (is_time ? 1. : curve.dimension);
      return {{n_a, a.error / 2.},
              {n_b, a.error / 2. * std::pow(n_a / n_b, slope)}};
    }

    /// What the two parts of a picture plot; none if no run has an error.
    std::array<std::string, 2>
    plots_of(Figure                                &figure,
             const std::vector<const StudyCurve *> &curves,
             const bool                             is_time)
    {
      const StudyCurve          &first = *curves.front();
      std::array<std::string, 2> plots;
      const char                *separator = "";
      unsigned int               n_points  = 0;
      for (const StudyCurve *curve : curves)
        {
          Rows rows;
          for (const StudyPoint &point : curve->points)
            if (std::isfinite(point.error))
              rows.push_back({static_cast<double>(point.summary.dofs),
                              static_cast<double>(point.summary.steps),
                              point.summary.cpu_time,
                              point.error});
          n_points += rows.size();
          const std::string data =
            figure.add_data(curve->quantity + ", " + curve->sequence,
                            {"unknowns", "steps", "cpu_s", "relative_error"},
                            rows);
          const std::string style = " with linespoints " +
                                    style_of(curve->kind) + " title " +
                                    gnuplot_text(curve->sequence);
          plots[0] +=
            separator + data + (is_time ? " using 2:4" : " using 1:4") + style;
          plots[1] += separator + data + " using 3:4" + style;
          separator = ", ";
        }
      if (n_points == 0)
        return {};
      const Rows guide = guide_of(first, is_time);
      if (!guide.empty())
        plots[0] +=
          ", " + figure.add_data("slope", {"size", "error"}, guide) +
          " using 1:2 with lines lc rgb '#888888' dt (2,2) lw 1.5 title " +
          gnuplot_text("order " + fixed_text(first.order, 2));
      // Below nothing can be told.
      const double uncertainty = first.relative_uncertainty();
      if (uncertainty > 0. && std::isfinite(uncertainty))
        for (std::string &plot : plots)
          plot += ", " + exact_text(uncertainty) +
                  " with lines lc rgb '#888888' lw 1.5 title " +
                  gnuplot_text("uncertainty of the reference");
      return plots;
    }



    Picture draw(const std::filesystem::path           &folder,
                 const std::size_t                      number,
                 const std::vector<const StudyCurve *> &curves,
                 std::vector<std::string>              &warnings)
    {
      const StudyCurve &first   = *curves.front();
      const bool        is_time = first.kind == StudySequence::Kind::time_step;
      const std::string title   = "Convergence of the " + first.quantity +
                                (is_time ? " with the time step" : "");
      Figure figure(folder,
                    "convergence_" + std::to_string(number),
                    title,
                    picture_width,
                    380);

      const auto plots = plots_of(figure, curves, is_time);
      if (plots[0].empty())
        return {};
      figure.script() << axes_style
                      << "set key inside left bottom Left reverse\n"
                         "set logscale xy\nset format '10^{%T}'\n"
                         "set multiplot layout 1,2\nset ylabel 'relative error'"
                         "\nset xlabel '"
                      << (is_time ? "steps" : "unknowns") << "'\nplot "
                      << plots[0]
                      << "\nset ylabel ''\nset format x '%g'\n"
                         "set xlabel 'CPU time [s]'\nplot "
                      << plots[1] << "\nunset multiplot\n";
      const std::string caption =
        "Relative to " + short_text(first.reference, 6) + " " + first.unit +
        " (" + first.reference_name +
        (std::isfinite(first.order) ? ", order " + fixed_text(first.order, 2) :
                                      "") +
        "), which is itself uncertain by " +
        short_text(first.relative_uncertainty(), 2) +
        " of it. Runs whose difference is not above that are not shown.";
      return finish(figure, title, caption, warnings);
    }
  } // namespace



  std::vector<Picture> draw_study(const std::filesystem::path   &folder,
                                  const std::vector<StudyCurve> &curves,
                                  std::vector<std::string>      &warnings)
  {
    std::vector<Picture> pictures;
    std::size_t          number = 0;
    for (std::size_t i = 0; i < curves.size();)
      {
        // Uniform and adaptive meshes of a quantity share a picture.
        std::vector<const StudyCurve *> together = {&curves[i++]};
        while (i < curves.size() &&
               together[0]->kind == StudySequence::Kind::uniform &&
               curves[i].kind == StudySequence::Kind::adaptive)
          together.push_back(&curves[i++]);
        const Picture picture = draw(folder, ++number, together, warnings);
        if (!picture.svg.empty())
          pictures.push_back(picture);
      }
    return pictures;
  }



  std::string study_html(const std::vector<StudyCurve> &curves,
                         const std::vector<Picture>    &pictures)
  {
    std::string html =
      heading("What was found") + html_table(study_summary(curves)) +
      "<p>Errors are relative; \"&lt;\" stands where the "
      "difference to the reference is not above the "
      "reference's own uncertainty, \"?\" where no limit is "
      "in sight. An order takes three monotone differences. "
      "The cheapest run for 1 % is the one with the least "
      "unknowns times steps whose error, and that of all "
      "finer ones, is at most 1 % with that uncertainty.</p>\n";
    for (const Picture &picture : pictures)
      html += figure_element(picture);
    std::vector<TableLine> lines = {{"quantity",
                                     "run",
                                     "unknowns",
                                     "steps",
                                     "CPU time [s]",
                                     "value",
                                     "relative error",
                                     "order"}};
    for (const StudyCurve &curve : curves)
      for (const StudyPoint &point : curve.points)
        {
          TableLine line = run_line(point);
          if (point.summary.status != "finished")
            line[0] += " (failed)";
          line.insert(line.begin(),
                      &point == &curve.points.front() ? name_with_unit(curve) :
                                                        "");
          lines.push_back(line);
        }
    return html + heading("Convergence") + html_table(lines);
  }
} // namespace SlipStep
