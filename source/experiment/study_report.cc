// The pictures and the HTML of a refinement study.

#include <slipstep/experiment/report_data.h>
#include <slipstep/experiment/report_drawing.h>
#include <slipstep/experiment/report_html.h>
#include <slipstep/experiment/study_results.h>

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

    /// A straight line below the curve with the order that it shows.
    struct Guide
    {
      double order = std::numeric_limits<double>::quiet_NaN();
      Rows   rows;
    };

    /// From the last two errors of the curve, half as high.
    Guide guide_of(const StudyCurve &curve, const bool is_time)
    {
      Guide guide;
      for (std::size_t i = 1; i < curve.points.size(); ++i)
        {
          const StudyPoint &a = curve.points[i - 1], &b = curve.points[i];
          if (!std::isfinite(b.order))
            continue;
          const auto n = [is_time](const StudyPoint &point) {
            return static_cast<double>(is_time ? point.summary.steps :
                                                 point.summary.dofs);
          };
          guide.order = b.order;
          guide.rows  = {{n(a), a.error / 2.}, {n(b), b.error / 2.}};
        }
      return guide;
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

      std::string  plots[2];
      const char  *separator = "";
      unsigned int n_points  = 0;
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
      const Guide guide = guide_of(first, is_time);
      if (std::isfinite(guide.order))
        plots[0] +=
          ", " + figure.add_data("slope", {"size", "error"}, guide.rows) +
          " using 1:2 with lines lc rgb '#888888' dt (2,2) lw 1.5 title " +
          gnuplot_text("order " + fixed_text(guide.order, 2));

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
      std::string caption =
        "Relative to " + short_text(first.reference, 6) + " " + first.unit +
        " (" + first.reference_name +
        (std::isfinite(first.order) ? ", order " + fixed_text(first.order, 2) :
                                      "") +
        ").";
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
    std::string html;
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
        lines.push_back(
          {&point == &curve.points.front() ?
             curve.quantity +
               (curve.unit.empty() ? "" : " [" + curve.unit + "]") :
             "",
           point.label +
             (point.summary.status == "finished" ? "" : " (failed)"),
           std::to_string(point.summary.dofs),
           std::to_string(point.summary.steps),
           fixed_text(point.summary.cpu_time, 2),
           short_text(point.value, 7),
           short_text(point.error, 3),
           fixed_text(point.order, 2)});
    return html + "<h2>Convergence</h2>\n" + html_table(lines);
  }
} // namespace SlipStep
