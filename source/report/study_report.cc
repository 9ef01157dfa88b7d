// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/study_report.h>

#include <slipstep/utilities/json_file.h>
#include <slipstep/utilities/version.h>
#include <slipstep/utilities/write_file.h>

#include <set>

namespace SlipStep
{
  namespace
  {
    std::string name_with_unit(const StudyCurve &curve)
    {
      return curve.quantity +
             (curve.unit.empty() ? "" : " [" + curve.unit + "]");
    }



    /// One run: its label, unknowns, steps, CPU time, value, error, order.
    TableLine run_line(const StudyPoint &point)
    {
      return {point.label,
              std::to_string(point.summary.dofs),
              std::to_string(point.summary.steps),
              fixed_text(point.summary.cpu_time, 2),
              short_text(point.value, 7),
              point.error_text(),
              fixed_text(point.order, 2)};
    }



    /// What was found, one line per curve: quantity, runs, reference, error of
    /// the finest run, order, cheapest run for 1 %.
    TableLines study_summary(const std::vector<StudyCurve> &curves)
    {
      TableLines lines = {table_head(
        "quantity | runs | reference | error of the finest | order | "
        "cheapest for 1 %")};
      for (const StudyCurve &curve : curves)
        {
          const StudyPoint *finest   = curve.finest();
          const StudyPoint *cheapest = curve.cheapest(0.01);
          lines.push_back({name_with_unit(curve),
                           curve.sequence,
                           short_text(curve.reference, 6),
                           finest == nullptr ? "–" : finest->error_text(),
                           fixed_text(curve.order, 2),
                           cheapest == nullptr ?
                             "–" :
                             cheapest->label + " (" +
                               short_text(cheapest->summary.cpu_time, 2) +
                               " s)"});
        }
      return lines;
    }



    std::string reference_text(const StudyCurve &curve)
    {
      if (!std::isfinite(curve.reference))
        return "no reference";
      std::ostringstream out;
      out << "reference " << curve.reference << " (" << curve.reference_name
          << (std::isfinite(curve.order) ?
                ", order " + fixed_text(curve.order, 2) :
                "")
          << "), ";
      if (curve.uncertainty == 0.)
        out << "the same in all runs";
      else if (std::isfinite(curve.uncertainty))
        out << "uncertain by " << short_text(curve.uncertainty, 2)
            << (curve.reference == 0. ?
                  "" :
                  " (relative " + short_text(curve.relative_uncertainty(), 2) +
                    ")");
      else
        out << "but the values are not seen to approach a limit";
      return out.str();
    }



    /// Colours of Okabe and Ito; shapes and dashes tell the same in print.
    LegendLine line_of(const StudyCurve &curve)
    {
      using Kind = StudySequence::Kind;
      return curve.kind == Kind::uniform ?
               LegendLine{curve.sequence, "#0072B2"} :
             curve.kind == Kind::adaptive ?
               LegendLine{curve.sequence, "#D55E00", "dashed"} :
               LegendLine{curve.sequence, "#009E73", "dotted"};
    }

    std::string style_of(const StudyCurve &curve)
    {
      using Kind = StudySequence::Kind;
      return "lc rgb '" + line_of(curve).colour + "' " +
             (curve.kind == Kind::uniform  ? "dt solid pt 7 ps 0.9 lw 2" :
              curve.kind == Kind::adaptive ? "dt (12,4) pt 5 ps 0.9 lw 2" :
                                             "dt (4,3) pt 9 ps 1.1 lw 2");
    }

    bool has_uncertainty(const StudyCurve &curve)
    {
      const double uncertainty = curve.relative_uncertainty();
      return uncertainty > 0. && std::isfinite(uncertainty);
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
          const std::string style = " with linespoints " + style_of(*curve);
          plots[0] +=
            separator + data + (is_time ? " using 2:4" : " using 1:4") + style;
          plots[1] += separator + data + " using 3:4" + style;
          separator = ", ";
        }
      if (n_points == 0)
        return {};
      const Rows guide = guide_of(first, is_time);
      if (!guide.empty())
        plots[0] += ", " + figure.add_data("slope", {"size", "error"}, guide) +
                    " using 1:2 with lines lc rgb '#888888' dt (2,2) lw 1.5";
      // Below nothing can be told. Across the frame, however far runs reach.
      const std::string uncertainty = exact_text(first.relative_uncertainty());
      const std::string grey        = " lc rgb '#888888' lw 1.5";
      if (!has_uncertainty(first))
        return plots;
      figure.script() << "set arrow nohead from graph 0, first " << uncertainty
                      << " to graph 1, first " << uncertainty << grey << '\n';
      for (std::string &plot : plots)
        plot += ", " + uncertainty + " with lines" + grey;
      return plots;
    }



    std::string legend_of(const std::vector<const StudyCurve *> &curves,
                          const bool                             is_time)
    {
      const StudyCurve       &first = *curves.front();
      std::vector<LegendLine> lines;
      for (const StudyCurve *curve : curves)
        lines.push_back(line_of(*curve));
      if (!guide_of(first, is_time).empty())
        lines.push_back(
          {"order " + fixed_text(first.order, 2), "#888888", "dotted"});
      if (has_uncertainty(first))
        lines.push_back({"uncertainty of the reference", "#888888"});
      return legend_line(lines);
    }



    /// As HTML; "" if it could not be drawn.
    std::string draw(Page                                  &page,
                     const std::size_t                      number,
                     const std::vector<const StudyCurve *> &curves)
    {
      const StudyCurve &first   = *curves.front();
      const bool        is_time = first.kind == StudySequence::Kind::time_step;
      const std::string title   = "Convergence of the " + first.quantity +
                                (is_time ? " with the time step" : "");
      Figure figure(page.pictures,
                    "convergence_" + std::to_string(number),
                    title,
                    picture_width,
                    380);

      const auto plots = plots_of(figure, curves, is_time);
      if (plots[0].empty())
        return {};
      figure.script() << axes_style
                      << "unset key\n"
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
        " of it. Runs that differ by no more than this are not shown.";
      return figure_element(
        title, page.svg_of(figure), caption, false, legend_of(curves, is_time));
    }



    /// Error against unknowns and against processor time, a picture per
    /// quantity.
    std::string draw_study(Page &page, const std::vector<StudyCurve> &curves)
    {
      std::string html;
      std::size_t number = 0;
      for (std::size_t i = 0; i < curves.size();)
        {
          // Uniform and adaptive meshes of a quantity share a picture.
          std::vector<const StudyCurve *> together = {&curves[i++]};
          while (i < curves.size() &&
                 together[0]->kind == StudySequence::Kind::uniform &&
                 curves[i].kind == StudySequence::Kind::adaptive)
            together.push_back(&curves[i++]);
          html += draw(page, ++number, together);
        }
      return html;
    }
  } // namespace



  std::string study_tables(const std::vector<StudyCurve> &curves)
  {
    std::ostringstream    out;
    std::set<std::string> problems;
    out << '\n' << text_table(study_summary(curves));
    for (const StudyCurve &curve : curves)
      {
        TableLines lines = {table_head(
          "run | unknowns | steps | CPU [s] | value | error | order")};
        for (const StudyPoint &point : curve.points)
          lines.push_back(run_line(point));
        for (const std::string &problem : curve.problems())
          problems.insert("  " + problem + "\n");
        out << '\n'
            << name_with_unit(curve) << ", " << curve.sequence << ": "
            << reference_text(curve) << '\n'
            << text_table(lines);
      }
    // Once, not for every quantity.
    out << (problems.empty() ? "" : "\n");
    for (const std::string &failure : problems)
      out << failure;
    return out.str();
  }



  void write_study_csv(const std::filesystem::path   &file,
                       const std::vector<StudyCurve> &curves)
  {
    std::ostringstream out;
    out << "sequence,run,status,cells,unknowns,steps,cpu_s,memory_MB,quantity,"
           "unit,value,reference,relative_error,order,"
           "reference_uncertainty,error_bound\n";
    const auto quoted = [](const std::string &text) {
      return "\"" + text + "\"";
    };
    const auto text = [](const double value) {
      return std::isfinite(value) ? exact_text(value) : std::string("nan");
    };
    for (const StudyCurve &curve : curves)
      for (const StudyPoint &point : curve.points)
        out << curve.sequence << ',' << quoted(point.label) << ','
            << point.summary.status << ',' << point.summary.cells << ','
            << point.summary.dofs << ',' << point.summary.steps << ','
            << text(point.summary.cpu_time) << ','
            << text(point.summary.peak_memory) << ',' << quoted(curve.quantity)
            << ',' << curve.unit << ',' << text(point.value) << ','
            << text(curve.reference) << ',' << text(point.error) << ','
            << text(point.order) << ',' << text(curve.uncertainty) << ','
            << text(point.error_bound) << '\n';
    write_file(file, out.str());
  }



  void write_study_json(const std::filesystem::path   &file,
                        const std::vector<StudyCurve> &curves)
  {
    using json = nlohmann::ordered_json;
    json list  = json::array();
    for (const StudyCurve &curve : curves)
      {
        json runs = json::array();
        for (const StudyPoint &point : curve.points)
          runs.push_back({{"run", point.label},
                          {"status", point.summary.status},
                          {"unknowns", point.summary.dofs},
                          {"steps", point.summary.steps},
                          {"cpu_s", point.summary.cpu_time},
                          {"value", point.value},
                          {"relative_error", point.error},
                          {"error_bound", point.error_bound},
                          {"order", point.order}});
        const StudyPoint *cheapest = curve.cheapest(0.01);
        list.push_back({{"quantity", curve.quantity},
                        {"unit", curve.unit},
                        {"sequence", curve.sequence},
                        {"reference", curve.reference},
                        {"reference_from", curve.reference_name},
                        {"reference_uncertainty", curve.uncertainty},
                        {"problems", curve.problems()},
                        {"order", curve.order},
                        {"cheapest_for_1_percent",
                         cheapest == nullptr ? json() : json(cheapest->label)},
                        {"runs", runs}});
      }
    write_json(file, {{"version", version()}, {"curves", list}});
  }



  std::string study_section(Page &page, const std::vector<StudyCurve> &curves)
  {
    const std::string html =
      heading("What was found") + html_table(study_summary(curves)) +
      "<p>Errors are relative; \"&lt;\" stands where the "
      "difference to the reference is not above the "
      "reference's own uncertainty, \"?\" where no limit is "
      "in sight. An order takes three monotone differences. "
      "The cheapest run for 1 % is the one with the smallest "
      "product of unknowns and steps among those whose error, "
      "with the uncertainty added, is at most 1 %, as it is in "
      "all finer runs.</p>\n" +
      draw_study(page, curves);
    TableLines lines = {
      table_head("quantity | run | unknowns | steps | CPU time [s] | value | "
                 "relative error | order")};
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
