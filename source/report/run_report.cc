// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/run_report.h>

#include <slipstep/report/repeat_command.h>
#include <slipstep/report/run_results.h>
#include <slipstep/report/run_figures.h>
#include <slipstep/report/run_law.h>
#include <slipstep/measured_data/measured_test.h>
#include <slipstep/report/page.h>
#include <slipstep/report/figure.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/write_file.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/patterns.h>

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>

namespace SlipStep
{
  void declare_report_parameters(Parameters &parameters)
  {
    using namespace dealii::Patterns;
    parameters.declare("Report/Title",
                       "",
                       Anything(),
                       "Title of report.html; the name of the case if empty.");
    parameters.declare(
      "Report/Reference kinetic coefficient",
      "",
      Anything(),
      "Kinetic friction coefficient to compare with: a formula of the sliding "
      "speed V in mm/min, e.g. 0.00420*log(V) + 0.100 (log is the natural "
      "logarithm). Empty: no comparison.");
    parameters.declare("Report/Reference name",
                       "reference",
                       Anything(),
                       "What tables and legends call the reference, e.g. "
                       "\"eq. 4 of the source paper\".");
    parameters.declare(
      "Report/Reference quasi-static coefficient",
      "0",
      Quantity(Dimension::number, 0.),
      "Divides the reference coefficient to give its dynamic loading ratio r "
      "(>= 0; 0: the reference is not shown in the picture of r over speed).");
    parameters.declare(
      "Report/Pictures",
      "",
      Anything(),
      "Further pictures of the report, each as what over what and separated by "
      "commas, e.g. peak over rest, force over time. Known are: " +
        picture_quantity_names() +
        ". A value is of a slide or of an instant, and only the like go "
        "together; over direction the picture is polar. What spans decades "
        "has a logarithmic axis.");
    parameters.declare(
      "Report/Measured",
      "",
      Anything(),
      "Measured tests that the report draws beside the runs, separated by "
      "commas, relative to the folder of the case. Tests that the programme "
      "follows are drawn anyway.");
    parameters.declare("Report/Reference speeds",
                       "",
                       Anything(),
                       "Sliding speeds at which the reference is marked, in "
                       "mm/min unless a unit is given, separated by commas. "
                       "Empty: the speeds of the runs.");
  }



  void check_report_parameters(const Parameters &parameters)
  {
    const Reference reference(parameters);
    (void)reference;
    check_pictures(parameters);
    for (const std::string &name : parameters.list("Report/Measured"))
      read_measured_test(parameters.resolve(name));
  }



  namespace
  {
    /// Cycles make many slides: the terminal shows the first and the last.
    std::vector<TableLine> shortened(std::vector<TableLine> lines)
    {
      constexpr std::size_t most = 60, kept = 20;
      if (lines.size() <= most)
        return lines;
      const auto first = lines.begin() + 1 + kept, last = lines.end() - kept;
      TableLine  gap(lines[0].size());
      gap[0] = "(" + std::to_string(last - first) + " more)";
      *first = gap;
      lines.erase(first + 1, last);
      return lines;
    }

    bool is_reverse(const SlideSummary &slide)
    {
      return std::cos(slide.angle) < -1e-9;
    }

    /// Whether a slide is not along the first axis, where a sign would do.
    bool angles_matter(const std::vector<ResultRow> &rows)
    {
      return std::any_of(rows.begin(), rows.end(), [](const ResultRow &row) {
        return std::abs(std::sin(row.slide.angle)) > 1e-6;
      });
    }

    /// Whether the slides are under different pressures.
    bool pressures_matter(const std::vector<ResultRow> &rows)
    {
      return std::any_of(rows.begin(), rows.end(), [&](const ResultRow &row) {
        return std::abs(row.slide.pressure - rows[0].slide.pressure) >
               1e-3 * rows[0].slide.pressure;
      });
    }

    /// Whether runs have labels that say more than the column of speeds does.
    bool labels_matter(const std::vector<ResultRow> &rows)
    {
      return std::any_of(rows.begin(), rows.end(), [&](const ResultRow &row) {
        return row.label != rows[0].label &&
               row.label != speed_text(row.slide.speed);
      });
    }

    template <typename Test>
    bool any(const std::vector<ResultRow> &rows, const Test &test)
    {
      return std::any_of(rows.begin(), rows.end(), test);
    }

    /// A run has several slides, and which statements they are is known.
    bool statements_matter(const std::vector<ResultRow> &rows)
    {
      for (std::size_t i = 1; i < rows.size(); ++i)
        if (rows[i].run == rows[i - 1].run && rows[i].slide.statement > 0)
          return true;
      return false;
    }

    /// Whether slides follow rests, other than the same one to change pressure.
    bool rests_matter(const std::vector<ResultRow> &rows)
    {
      double rest = 0.;
      for (const ResultRow &row : rows)
        if (row.slide.rest > 0.)
          {
            if (!pressures_matter(rows) ||
                (rest > 0. && std::abs(row.slide.rest - rest) > 1e-6 * rest))
              return true;
            rest = row.slide.rest;
          }
      return false;
    }

    /// A column of the table of results.
    struct ResultColumn
    {
      std::string                                   head;
      std::function<std::string(const ResultRow &)> cell;
    };

    std::string degrees_text(const ResultRow &row)
    {
      return short_text(row.slide.angle * 180. / dealii::numbers::PI);
    }

    /// What makes the slides different.
    std::vector<ResultColumn>
    condition_columns(const std::vector<ResultRow> &rows)
    {
      const bool                with_angles = angles_matter(rows);
      std::vector<ResultColumn> columns;
      if (labels_matter(rows))
        columns.push_back(
          {"run", [](const ResultRow &row) { return row.label; }});
      if (statements_matter(rows))
        columns.push_back({"statement", [](const ResultRow &row) {
                             return std::to_string(row.slide.statement);
                           }});
      columns.push_back({"speed [mm/min]", [with_angles](const ResultRow &row) {
                           return (is_reverse(row.slide) && !with_angles ? "-" :
                                                                           "") +
                                  short_text(60. * row.slide.speed);
                         }});
      if (with_angles)
        columns.push_back({"angle [deg]", degrees_text});
      if (pressures_matter(rows))
        columns.push_back({"pressure [MPa]", [](const ResultRow &row) {
                             return short_text(row.slide.pressure);
                           }});
      if (rests_matter(rows))
        columns.push_back({"rest before [s]", [](const ResultRow &row) {
                             return short_text(row.slide.rest, 6);
                           }});
      return columns;
    }

    ResultColumn
    number_column(const std::string                              &head,
                  const unsigned int                              digits,
                  const std::function<double(const ResultRow &)> &value)
    {
      return {head, [digits, value](const ResultRow &row) {
                return fixed_text(value(row), digits);
              }};
    }

    /// What was found: no column for what no slide has.
    std::vector<ResultColumn> found_columns(const std::vector<ResultRow> &rows,
                                            const Reference &reference)
    {
      constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
      std::vector<ResultColumn> columns;
      if (any(rows, [](const ResultRow &row) { return row.has_peak; }))
        columns.push_back(
          number_column("peak", 4, [undefined](const ResultRow &row) {
            return row.has_peak ? row.slide.peak : undefined;
          }));
      if (any(rows, [](const ResultRow &row) { return row.has_dip; }))
        columns.push_back(
          number_column("dip", 4, [undefined](const ResultRow &row) {
            return row.has_dip ? row.slide.dip : undefined;
          }));
      const bool with_kinetic =
        any(rows, [](const ResultRow &row) { return row.has_kinetic(); });
      if (with_kinetic)
        columns.push_back(number_column("kinetic", 4, [](const ResultRow &row) {
          return row.slide.kinetic;
        }));
      if (any(rows, [](const ResultRow &row) { return !row.slides_fully(); }))
        {
          columns.push_back(number_column(
            "at the end", 4, [](const ResultRow &row) { return row.end; }));
          columns.push_back(
            number_column("slipping [%]", 1, [](const ResultRow &row) {
              return 100. * row.slide.slip_fraction;
            }));
        }
      if (reference.exists() && with_kinetic)
        {
          columns.push_back(
            number_column(reference.name(), 4, [](const ResultRow &row) {
              return row.reference;
            }));
          columns.push_back({"difference [%]", [](const ResultRow &row) {
                               return (row.difference > 0. ? "+" : "") +
                                      fixed_text(row.difference, 2);
                             }});
        }
      return columns;
    }

    /// What the terminal has no room for.
    std::vector<ResultColumn>
    further_columns(const std::vector<ResultRow> &rows)
    {
      std::vector<ResultColumn> columns;
      const bool                with_kinetic =
        any(rows, [](const ResultRow &row) { return row.has_kinetic(); });
      if (any(rows, [](const ResultRow &row) { return row.has_peak; }))
        {
          if (with_kinetic)
            columns.push_back(number_column(
              "drop [%]", 2, [](const ResultRow &row) { return row.drop; }));
          columns.push_back({"peak after [mm]", [](const ResultRow &row) {
                               return row.has_peak ?
                                        short_text(row.slide.peak_displacement,
                                                   3) :
                                        "–";
                             }});
        }
      columns.push_back({"length [mm]", [](const ResultRow &row) {
                           return short_text(row.slide.length);
                         }});
      if (with_kinetic)
        {
          columns.push_back(number_column("r", 4, [](const ResultRow &row) {
            return row.slide.dynamic_ratio;
          }));
          columns.push_back(number_column("μ", 4, [](const ResultRow &row) {
            return row.slide.coefficient;
          }));
        }
      return columns;
    }

    /// The table of results; the report shows more columns than the terminal.
    std::vector<TableLine> result_lines(const std::vector<ResultRow> &rows,
                                        const Reference              &reference,
                                        const bool                    in_full)
    {
      std::vector<ResultColumn> columns = condition_columns(rows);
      const auto append = [&columns](const std::vector<ResultColumn> &more) {
        columns.insert(columns.end(), more.begin(), more.end());
      };
      append(found_columns(rows, reference));
      if (in_full)
        append(further_columns(rows));
      std::vector<TableLine> lines(1 + rows.size());
      for (const ResultColumn &column : columns)
        {
          lines[0].push_back(column.head);
          for (std::size_t i = 0; i < rows.size(); ++i)
            lines[i + 1].push_back(column.cell(rows[i]));
        }
      return lines;
    }

    /// What the columns mean, of those that there are.
    std::string result_note(const std::vector<ResultRow> &rows)
    {
      std::string text;
      if (any(rows, [](const ResultRow &row) { return row.has_kinetic(); }))
        text +=
          "Kinetic, r, μ: at the end of the slide, means over the contact "
          "face. ";
      if (any(rows, [](const ResultRow &row) { return row.has_peak; }))
        text +=
          "Peak: where friction is higher than where the slide begins and "
          "ends. ";
      if (any(rows, [](const ResultRow &row) { return row.has_dip; }))
        text += "Dip: the least friction after a step of speed, where it is "
                "lower than before and in the end. ";
      if (any(rows, [](const ResultRow &row) { return !row.slides_fully(); }))
        text += "Slipping: share of the contact that slips at the end of the "
                "slide; below 100 % there is no kinetic friction. ";
      return note(text);
    }

    std::string run_name(const RunResults &run)
    {
      return !run.label.empty()             ? run.label :
             !run.summary.case_name.empty() ? run.summary.case_name :
                                              run.folder.filename().string();
    }

    std::vector<TableLine> cost_lines(const std::vector<RunResults> &runs)
    {
      // A single point has neither mesh nor systems to solve.
      const bool             has_mesh = runs[0].summary.command != "point";
      std::vector<TableLine> lines    = {{"run"}};
      if (has_mesh)
        lines[0].insert(lines[0].end(), {"cells", "unknowns", "ranks"});
      const bool is_adaptive =
        std::any_of(runs.begin(), runs.end(), [](const RunResults &run) {
          return run.summary.mesh_error.tolerance > 0.;
        });
      if (is_adaptive)
        lines[0].insert(lines[0].end(),
                        {"estimated error of the mesh [%]", "at worst [%]"});
      lines[0].insert(lines[0].end(), {"steps", "rejected"});
      if (has_mesh)
        lines[0].insert(lines[0].end(),
                        {"Newton per step", "linear per Newton"});
      lines[0].insert(lines[0].end(),
                      {"wall time [s]", "CPU time [s]", "memory [MB]"});
      const auto ratio = [](const double a, const double b) {
        return b > 0. ? fixed_text(a / b, 2) : std::string("–");
      };
      for (const RunResults &run : runs)
        {
          const Summary &s    = run.summary;
          TableLine      line = {run_name(run)};
          if (has_mesh)
            line.insert(line.end(),
                        {std::to_string(s.cells),
                         std::to_string(s.dofs),
                         std::to_string(s.ranks)});
          if (is_adaptive)
            for (const double error : {s.mesh_error.last, s.mesh_error.largest})
              line.push_back(s.mesh_error.tolerance > 0. ?
                               short_text(100. * error, 2) :
                               "–");
          line.insert(line.end(),
                      {std::to_string(s.steps),
                       std::to_string(s.rejected_steps)});
          if (has_mesh)
            line.insert(line.end(),
                        {ratio(s.newton_iterations, s.steps),
                         ratio(s.linear_iterations, s.newton_iterations)});
          line.insert(line.end(),
                      {fixed_text(s.wall_time, 1),
                       fixed_text(s.cpu_time, 1),
                       fixed_text(s.peak_memory, 0)});
          lines.push_back(line);
        }
      return lines;
    }

    std::vector<TableLine> energy_lines(const std::vector<RunResults> &runs)
    {
      // A point stands for 1 mm² of contact, a block in 2-D for 1 mm of its
      // thickness.
      const Summary         &first = runs[0].summary;
      const std::string      unit  = first.command == "point" ? " [N mm/mm²]" :
                                     first.dimension == 2     ? " [N mm/mm]" :
                                                                " [N mm]";
      std::vector<TableLine> lines = {{"run",
                                       "work put in" + unit,
                                       "stored" + unit,
                                       "dissipated" + unit,
                                       "unaccounted [% of the work]"}};
      for (const RunResults &run : runs)
        lines.push_back({run_name(run),
                         short_text(run.summary.work, 6),
                         short_text(run.summary.stored, 6),
                         short_text(run.summary.dissipated, 6),
                         short_text(100. * run.summary.balance_error, 2)});
      return lines;
    }

    /// Whether the machine lets the contact slide steadily; empty without a
    /// spring.
    std::vector<TableLine> stability_lines(const std::vector<RunResults> &runs)
    {
      std::vector<TableLine> lines = {{"run",
                                       "speed [mm/min]",
                                       "pressure [MPa]",
                                       "k [MPa/mm]",
                                       "critical k [MPa/mm]",
                                       "at [Hz]",
                                       "steady sliding"}};
      for (const RunResults &run : runs)
        for (const StabilitySummary &s : run.summary.stability)
          lines.push_back(
            {run_name(run),
             short_text(60. * s.speed),
             short_text(s.pressure),
             short_text(s.stiffness),
             std::isinf(s.critical_stiffness) ?
               "∞" :
               short_text(s.critical_stiffness),
             s.critical_frequency > 0. ? short_text(s.critical_frequency) : "–",
             s.is_stable() ? "stable" : "unstable: stick-slip"});
      return lines.size() > 1 ? lines : std::vector<TableLine>();
    }

    std::string stability(const std::vector<RunResults> &runs)
    {
      const std::vector<TableLine> lines = stability_lines(runs);
      if (lines.empty())
        return "";
      return heading("Stability of steady sliding") + html_table(lines) +
             "<p class='origin'>Below the critical stiffness k of the machine a "
             "small disturbance of steady sliding grows, swinging with the "
             "frequency given.</p>\n";
    }

    /// The quantities of interest of all runs, if the case names any.
    std::string quantities(const std::vector<RunResults> &runs)
    {
      if (runs[0].summary.quantities.empty())
        return "";
      std::vector<TableLine> lines = {{"run"}};
      for (const QuantityValue &quantity : runs[0].summary.quantities)
        lines[0].push_back(quantity.name + (quantity.unit.empty() ?
                                              "" :
                                              " [" + quantity.unit + "]"));
      for (const RunResults &run : runs)
        {
          lines.push_back({run_name(run)});
          for (const QuantityValue &quantity : run.summary.quantities)
            lines.back().push_back(short_text(quantity.value, 6));
        }
      return heading("Quantities of interest") + html_table(lines);
    }

    /// What the user set, and in what the variants differ.
    std::vector<TableLine> condition_lines(const Parameters &parameters,
                                           const std::vector<RunResults> &runs)
    {
      std::vector<TableLine> lines = {{"key", "value"}};
      for (const std::string &path : parameters.paths())
        {
          const bool shown_above =
            std::any_of(runs[0].summary.effects.begin(),
                        runs[0].summary.effects.end(),
                        [&path](const std::string &effect) {
                          return boost::algorithm::starts_with(path,
                                                               "Friction/" +
                                                                 effect + "/");
                        });
          if (parameters.is_set(path) && !shown_above &&
              !boost::algorithm::starts_with(path, "Report/"))
            lines.push_back({path, parameters.text(path)});
        }
      for (const Variant &variant : parameters.variants())
        for (const Variant::Override &change : variant.overrides)
          lines.push_back(
            {"in " + variant.label + ": " + change.path, change.value});
      return lines;
    }
  } // namespace



  std::string result_table(const Parameters               &parameters,
                           const std::vector<ReportedRun> &runs)
  {
    const Reference          reference(parameters);
    std::vector<std::string> problems;
    const auto               results = load_runs(runs, problems);
    const auto               rows    = result_rows(results, reference);

    std::string text;
    if (!rows.empty())
      text += text_table(shortened(result_lines(rows, reference, false)));
    const auto stability = stability_lines(results);
    if (!stability.empty())
      text += "\n" + text_table(stability);
    for (const RunResults &run : results)
      if (run.summary.status == "failed")
        text += "  " + run_name(run) + ": failed: " + run.summary.reason + "\n";
    for (const RunResults &run : results)
      if (!run.summary.missing_energy().empty())
        text += "  " + run_name(run) +
                ": warning: " + run.summary.missing_energy() + "\n";
    for (const RunResults &run : results)
      if (!run.summary.missed_tolerance().empty())
        text += "  " + run_name(run) +
                ": warning: " + run.summary.missed_tolerance() + "\n";
    for (const std::string &problem : problems)
      text += "  " + problem + "\n";
    return text;
  }



  namespace
  {
    std::string problem_boxes(const std::vector<RunResults>  &runs,
                              const std::vector<std::string> &warnings)
    {
      std::string html;
      for (const RunResults &run : runs)
        {
          if (run.summary.status == "failed")
            html += problem_box("Run " + run_name(run) +
                                " failed: " + run.summary.reason +
                                ". What follows shows it up to there.");
          for (const std::string &warning : run.summary.warnings)
            html += problem_box("Run " + run_name(run) + ": " + warning);
        }
      for (const std::string &warning : warnings)
        html += problem_box(warning);
      return html;
    }

    /// All pictures; those of further runs are folded away.
    std::string figures(const std::vector<Picture> &pictures)
    {
      std::string shown, folded;
      for (const Picture &picture : pictures)
        if (!picture.svg.empty())
          (picture.is_secondary ? folded : shown) += figure_element(picture);
      if (!folded.empty())
        shown += "<details><summary>The contact face of the other runs"
                 "</summary>\n" +
                 folded + "</details>\n";
      return shown;
    }

    /// How to get these results again.
    std::string repetition(const Parameters              &parameters,
                           const std::vector<RunResults> &runs,
                           const bool                     is_one_case)
    {
      std::string html =
        !is_one_case ? "" :
                       "<p>The whole case, as its file is now:</p>\n<pre>" +
                         html_text(program_call(runs[0].summary.command,
                                                parameters.case_file().string(),
                                                runs[0].summary.ranks) +
                                   given_settings(parameters)) +
                         "\n</pre>\n";
      std::string single;
      for (const RunResults &run : runs)
        if (std::filesystem::exists(run.folder / "used_parameters.prm"))
          single += program_call(run.summary.command,
                                 (run.folder / "used_parameters.prm").string(),
                                 run.summary.ranks) +
                    "\n";
      if (!single.empty())
        html += "<p>One run, with every value it used:</p>\n<pre>" +
                html_text(single) + "</pre>\n";
      return html;
    }

    std::string case_title(const Parameters              &parameters,
                           const std::vector<RunResults> &runs)
    {
      const std::string title = parameters.text("Report/Title");
      if (!title.empty())
        return title;
      return runs.empty() ? "slipstep" : runs[0].summary.case_name;
    }

    /// Whether all variants slide under the same law.
    bool has_one_law(const Parameters &parameters)
    {
      for (const Variant &variant : parameters.variants())
        for (const Variant::Override &change : variant.overrides)
          if (boost::algorithm::starts_with(change.path, "Friction/"))
            return false;
      return true;
    }

    std::string page(const RunFigures  &drawn,
                     const std::string &law,
                     const std::string &study,
                     const bool         is_one_case)
    {
      const Parameters  &parameters = drawn.parameters;
      const auto        &runs       = drawn.runs;
      const auto         rows       = result_rows(runs, drawn.reference);
      std::ostringstream html;
      html << problem_boxes(runs, drawn.warnings) << study;
      if (!rows.empty())
        html << html_table(result_lines(rows, drawn.reference, true))
             << result_note(rows);
      html << figures(drawn.pictures) << law << stability(runs);
      if (!runs.empty())
        {
          html << heading("Energy") << html_table(energy_lines(runs))
               << quantities(runs) << heading("Cost")
               << html_table(cost_lines(runs));
          // Of several cases the parameters are of none.
          if (is_one_case)
            html << heading("Friction law")
                 << html_table(effect_table(drawn), "law")
                 << heading("Conditions")
                 << html_table(condition_lines(parameters, runs), "values");
          html << heading("Repeat it")
               << repetition(parameters, runs, is_one_case);
        }
      return html_page(case_title(parameters, runs),
                       rows.empty() ?
                         headline_of_pushes(runs) :
                         headline(rows,
                                  drawn.reference,
                                  is_one_case && has_one_law(parameters)),
                       html.str());
    }
  } // namespace



  std::vector<std::string> write_report(const std::filesystem::path &folder,
                                        const Parameters            &parameters,
                                        const std::vector<ReportedRun> &runs,
                                        const std::string              &study,
                                        const bool is_one_case)
  {
    const Reference          reference(parameters);
    std::vector<std::string> warnings;
    const auto               results = load_runs(runs, warnings);
    RunFigures               figures{
      folder / "report", parameters, results, reference, warnings};
    std::filesystem::create_directories(figures.folder);
    draw_pictures(figures);
    const std::string law = law_at_work(figures);
    write_file(folder / "report.html", page(figures, law, study, is_one_case));
    return warnings;
  }
} // namespace SlipStep
