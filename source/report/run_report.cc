// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/run_report.h>

#include <slipstep/report/run_results.h>
#include <slipstep/report/run_figures.h>
#include <slipstep/measured_data/measured_test.h>
#include <slipstep/measured_data/raw_files.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/patterns.h>

#include <boost/algorithm/string/predicate.hpp>

#include <set>

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
      "Further pictures of the report, each as one quantity over another and "
      "separated by commas, e.g. peak over rest, force over time. Known are: " +
        picture_quantity_names() +
        ". A value belongs to a slide or to an instant, and only values of the "
        "same kind can be combined; over direction the picture is polar. "
        "Values that span decades have a logarithmic axis.");
    parameters.declare(
      "Report/Measured",
      "",
      Anything(),
      "Measured tests that the report draws beside the runs, files separated by "
      "commas (measured/wet_*.csv are all of such names), relative to the folder "
      "of the case. Tests that the programme follows are drawn anyway.");
    parameters.declare("Report/Reference speeds",
                       "",
                       Anything(),
                       "Sliding speeds at which the reference is marked, in "
                       "mm/min unless a unit is given, separated by commas. "
                       "Empty: the speeds of the runs.");
  }



  void check_report_parameters(const Parameters &parameters)
  {
    Reference{parameters};
    check_pictures(parameters);
    for (const auto &file : named_files(parameters, "Report/Measured"))
      read_measured_test(file);
  }



  namespace
  {
    /// Cycles make many slides, of which the first and the last are shown.
    TableLines shortened(TableLines lines)
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



    /// A run has several slides, and which statements they are is known.
    bool statements_matter(const ResultRows &rows)
    {
      for (std::size_t i = 1; i < rows.size(); ++i)
        if (rows[i].run == rows[i - 1].run && rows[i].slide.statement > 0)
          return true;
      return false;
    }

    /// Whether slides follow rests, other than the same one to change pressure.
    bool rests_matter(const ResultRows &rows, const bool pressures_matter)
    {
      double rest = 0.;
      for (const ResultRow &row : rows)
        if (row.slide.rest > 0.)
          {
            if (!pressures_matter ||
                (rest > 0. && std::abs(row.slide.rest - rest) > 1e-6 * rest))
              return true;
            rest = row.slide.rest;
          }
      return false;
    }

    using ResultTable = ColumnTable<ResultRow>;

    /// What makes the slides different.
    void add_conditions(ResultTable &table)
    {
      const ResultRows &rows = table.rows;
      if (table.has([&](const ResultRow &row) {
            return row.label != rows[0].label &&
                   row.label != speed_text(row.slide.speed);
          }))
        table.add("run", &ResultRow::label);
      if (statements_matter(rows))
        table.add("statement", of_slide(&SlideSummary::statement));
      // Along the first axis a sign will do.
      const bool with_angles = table.has([](const ResultRow &row) {
        return std::abs(std::sin(row.slide.angle)) > 1e-6;
      });
      table.add("speed [mm/min]", [with_angles](const ResultRow &row) {
        const bool is_reverse = std::cos(row.slide.angle) < -1e-9;
        return (is_reverse && !with_angles ? "-" : "") +
               short_text(60. * row.slide.speed);
      });
      if (with_angles)
        table.add_short("angle [deg]", 4, [](const ResultRow &row) {
          return row.slide.angle * 180. / dealii::numbers::PI;
        });
      const bool with_pressures = table.has([&](const ResultRow &row) {
        return std::abs(row.slide.pressure - rows[0].slide.pressure) >
               1e-3 * rows[0].slide.pressure;
      });
      if (with_pressures)
        table.add_short("pressure [MPa]", 4, of_slide(&SlideSummary::pressure));
      if (rests_matter(rows, with_pressures))
        table.add_short("rest before [s]", 6, of_slide(&SlideSummary::rest));
    }

    /// What was found: no column for what no slide has.
    void add_found(ResultTable &table, const Reference &reference)
    {
      if (table.has(&ResultRow::has_peak))
        table.add_friction("peak", &ResultRow::peak);
      if (table.has(&ResultRow::has_dip))
        table.add_friction("dip", &ResultRow::dip);
      const bool with_kinetic = table.has(&ResultRow::has_kinetic);
      if (with_kinetic)
        table.add_friction("kinetic", of_slide(&SlideSummary::kinetic));
      if (table.has(&ResultRow::is_on_the_way))
        table.add_friction("at the end", &ResultRow::end);
      if (table.has(std::not_fn(&ResultRow::slides_fully)))
        table.add("slipping [%]", 1, [](const ResultRow &row) {
          return 100. * row.slide.slip_fraction;
        });
      if (reference.exists() && with_kinetic)
        {
          table.add_friction(reference.name, &ResultRow::reference);
          table.add("difference [%]", [](const ResultRow &row) {
            return (row.difference > 0. ? "+" : "") +
                   fixed_text(row.difference, 2);
          });
        }
    }

    /// What the terminal has no room for.
    void add_more(ResultTable &table)
    {
      const bool with_kinetic = table.has(&ResultRow::has_kinetic);
      if (table.has(&ResultRow::has_peak))
        {
          if (with_kinetic)
            table.add("drop [%]", 2, &ResultRow::drop);
          table.add("peak after [mm]", [](const ResultRow &row) {
            return row.has_peak ? short_text(row.slide.peak_displacement, 2) :
                                  "–";
          });
        }
      table.add_short("length [mm]", 4, of_slide(&SlideSummary::length));
      if (with_kinetic)
        {
          table.add("r", 4, of_slide(&SlideSummary::dynamic_ratio));
          table.add_friction("μ", of_slide(&SlideSummary::coefficient));
        }
    }

    /// The table of results; the report shows more columns than the terminal.
    TableLines result_lines(const ResultRows &rows,
                            const Reference  &reference,
                            const bool        in_full)
    {
      ResultTable table(rows);
      add_conditions(table);
      add_found(table, reference);
      if (in_full)
        add_more(table);
      return table.lines;
    }

    /// What the columns mean, of those that there are.
    std::string result_note(const ResultRows &rows)
    {
      const ResultTable table(rows);
      std::string       text;
      if (table.has(&ResultRow::has_kinetic))
        text +=
          "Kinetic, r, μ: at the end of the slide, means over the contact "
          "face. ";
      if (table.has(&ResultRow::has_peak))
        text +=
          "Peak: the largest friction of a slide, if that is higher than at "
          "its beginning and its end. ";
      if (table.has(&ResultRow::has_dip))
        text += "Dip: the least friction after a step of speed, if that is "
                "lower than before the step and at the end of the slide. ";
      if (table.has(&ResultRow::is_on_the_way))
        text += "At the end: friction there, whether or not it is kinetic. "
                "It is no kinetic friction where the contact does not slide "
                "as fast as it is driven, or the loading ratio r still rises "
                "by more than 1 %, or friction still changes by more than 2 %, "
                "in the last tenth of the slide. ";
      if (table.has(std::not_fn(&ResultRow::slides_fully)))
        text += "Slipping: share of the contact that slips at the end of the "
                "slide; below 100 % there is no kinetic friction, nor while "
                "the contact sticks and slips. ";
      return note(text);
    }

    std::string run_name(const RunResults &run)
    {
      return !run.label.empty()             ? run.label :
             !run.summary.case_name.empty() ? run.summary.case_name :
                                              run.folder.filename().string();
    }

    TableLines cost_lines(const Runs &runs)
    {
      // A single point has neither mesh nor systems to solve.
      ColumnTable<RunResults> table(runs);
      const bool              has_mesh = table.has(
        [](const RunResults &run) { return run.summary.command != "point"; });
      const auto of_summary = [](const auto number) {
        return [=](const RunResults &run) { return run.summary.*number; };
      };
      const auto ratio = [](const double a, const double b) {
        return b > 0. ? fixed_text(a / b, 2) : std::string("–");
      };
      table.add("run", run_name);
      if (has_mesh)
        {
          table.add("cells", of_summary(&Summary::cells));
          table.add("unknowns", of_summary(&Summary::dofs));
          table.add("ranks", of_summary(&Summary::ranks));
        }
      const auto is_adaptive = [](const RunResults &run) {
        return run.summary.mesh_error.tolerance > 0.;
      };
      if (table.has(is_adaptive))
        for (const auto &[head, error] :
             {std::make_pair("estimated error of the mesh [%]",
                             &MeshErrorSummary::last),
              std::make_pair("at worst [%]", &MeshErrorSummary::largest)})
          table.add(head, [&, error = error](const RunResults &run) {
            return is_adaptive(run) ?
                     short_text(100. * run.summary.mesh_error.*error, 2) :
                     "–";
          });
      table.add("steps", of_summary(&Summary::steps));
      table.add("rejected", of_summary(&Summary::rejected_steps));
      if (has_mesh)
        {
          table.add("Newton per step", [&](const RunResults &run) {
            return ratio(run.summary.newton_iterations, run.summary.steps);
          });
          table.add("linear per Newton", [&](const RunResults &run) {
            return ratio(run.summary.linear_iterations,
                         run.summary.newton_iterations);
          });
        }
      table.add("wall time [s]", 1, of_summary(&Summary::wall_time));
      table.add("CPU time [s]", 1, of_summary(&Summary::cpu_time));
      table.add("memory [MB]", 0, of_summary(&Summary::peak_memory));
      return table.lines;
    }

    /// A number and its unit.
    using Measure = std::pair<std::string, std::string>;

    // The unit stands in the head if all runs have the same.
    template <typename MeasureOf>
    void add_measures(ColumnTable<RunResults> &table,
                      const std::string       &name,
                      const MeasureOf         &measure)
    {
      std::set<std::string> units;
      for (const RunResults &run : table.rows)
        units.insert(measure(run).second);
      units.erase("");
      table.add(name + (units.size() == 1 ? " [" + *units.begin() + "]" : ""),
                [&](const RunResults &run) {
                  const auto [value, unit] = measure(run);
                  return value +
                         (units.size() > 1 && !unit.empty() ? " " + unit : "");
                });
    }

    TableLines energy_lines(const Runs &runs)
    {
      ColumnTable<RunResults> table(runs);
      table.add("run", run_name);
      for (const auto &[name, energy] :
           {std::make_pair("work put in", &Summary::work),
            std::make_pair("stored", &Summary::stored),
            std::make_pair("dissipated", &Summary::dissipated)})
        add_measures(table, name, [energy = energy](const RunResults &run) {
          return Measure(short_text(run.summary.*energy, 6),
                         "N mm" + per_size(run.summary.dimension));
        });
      table.add("unaccounted [% of the work]", [](const RunResults &run) {
        return short_text(100. * run.summary.balance_error, 2);
      });
      return table.lines;
    }

    /// Whether the machine lets the contact slide steadily; a head alone
    /// without a spring.
    TableLines stability_lines(const Runs &runs)
    {
      // Most laws slide alike whichever way.
      const bool with_directions = any_of(runs, [](const RunResults &run) {
        const auto &all = run.summary.stability;
        for (std::size_t i = 0; i < all.size(); ++i)
          for (std::size_t j = 0; j < i; ++j)
            if (short_text(all[i].speed) == short_text(all[j].speed) &&
                short_text(all[i].pressure) == short_text(all[j].pressure))
              return true;
        return false;
      });
      TableLines lines = {
        table_head("run | speed [mm/min] | " +
                   std::string(with_directions ? "angle [deg] | " : "") +
                   "pressure [MPa] | k [MPa/mm] | critical k [MPa/mm] | "
                   "at [Hz] | steady sliding")};
      for (const RunResults &run : runs)
        for (const StabilitySummary &s : run.summary.stability)
          {
            std::vector<std::string> line = {run_name(run),
                                             short_text(60. * s.speed)};
            if (with_directions)
              line.push_back(short_text(s.direction));
            line.insert(line.end(),
                        {short_text(s.pressure),
                         short_text(s.stiffness),
                         std::isinf(s.critical_stiffness) ?
                           "∞" :
                           short_text(s.critical_stiffness),
                         s.critical_frequency > 0. ?
                           short_text(s.critical_frequency) :
                           "–",
                         !s.is_stable() ? "unstable: stick-slip" :
                                          // As a disturbance that is not small
                                          // can make it.
                           any_of(run.summary.slides,
                                  [&](const SlideSummary &slide) {
                                    return slide.swings() && s.is_of(slide);
                                  }) ?
                                          "stable, but the run swings" :
                                          "stable"});
            lines.push_back(line);
          }
      return lines;
    }

    /// The quantities of interest of all runs; "" if there are none.
    std::string quantities(const Runs &runs)
    {
      std::vector<std::string> names;
      for (const RunResults &run : runs)
        for (const QuantityValue &quantity : run.summary.quantities)
          if (!holds(names, quantity.name))
            names.push_back(quantity.name);
      if (names.empty())
        return "";
      ColumnTable<RunResults> table(runs);
      table.add("run", run_name);
      for (const std::string &name : names)
        add_measures(table, name, [&](const RunResults &run) {
          for (const QuantityValue &quantity : run.summary.quantities)
            if (quantity.name == name)
              return Measure(short_text(quantity.value, 6), quantity.unit);
          return Measure("–", "");
        });
      return heading("Quantities of interest") + html_table(table.lines);
    }

    /// What the user set, and in what the variants differ.
    TableLines condition_lines(const Parameters &parameters, const Runs &runs)
    {
      TableLines lines = {{"key", "value"}};
      for (const std::string &path : parameters.paths())
        {
          const bool shown_above =
            any_of(runs[0].summary.effects, [&path](const std::string &effect) {
              return boost::algorithm::starts_with(path,
                                                   "Friction/" + effect + "/");
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



    std::string problems_of(const Runs &runs)
    {
      std::string html;
      for (const RunResults &run : runs)
        {
          if (run.summary.status == "failed")
            html += paragraph("Run " + run_name(run) +
                                " failed: " + run.summary.reason +
                                ". The results below end there.",
                              "problem");
          for (const std::string &warning : run.summary.warnings)
            html +=
              paragraph("Run " + run_name(run) + ": " + warning, "problem");
        }
      return html;
    }

    /// How to get these results again.
    std::string repetition(const Parameters &parameters,
                           const Runs       &runs,
                           const bool        is_one_case)
    {
      const Summary &first = runs[0].summary;
      std::string    html, single;
      if (is_one_case)
        html = paragraph("The whole case, as its file is now:") +
               case_call(first.command, parameters, first.ranks);
      for (const RunResults &run : runs)
        if (std::filesystem::exists(run.folder / "used_parameters.prm"))
          single += program_call(run.summary.command,
                                 (run.folder / "used_parameters.prm").string(),
                                 run.summary.ranks) +
                    "\n";
      if (!single.empty())
        html += paragraph("One run, with every value it used:") + "<pre>" +
                html_text(single) + "</pre>\n";
      return html;
    }

    void write_page(const RunFigures  &drawn,
                    const std::string &law,
                    const std::string &study,
                    const bool         is_one_case)
    {
      const Parameters  &parameters = drawn.parameters;
      const auto        &runs       = drawn.runs;
      const auto         rows       = result_rows(runs, drawn.reference);
      std::ostringstream html;
      html << problems_of(runs) << problem_boxes(drawn.page.warnings) << study;
      if (!rows.empty())
        html << html_table(shortened(result_lines(rows, drawn.reference, true)))
             << result_note(rows);
      html << drawn.shown;
      if (!drawn.folded.empty())
        html << "<details><summary>The contact face of the other runs"
                "</summary>\n"
             << drawn.folded << "</details>\n";
      html << law
           << table_section("Stability of steady sliding",
                            stability_lines(runs),
                            "Below the critical stiffness k of the machine a "
                            "small disturbance of steady sliding grows, "
                            "oscillating at the frequency given.");
      if (!runs.empty())
        {
          html << heading("Energy") << html_table(energy_lines(runs))
               << quantities(runs) << heading("Cost")
               << html_table(cost_lines(runs));
          // Of several cases the parameters are of none.
          if (is_one_case)
            html << table_section("Friction law",
                                  effect_table(drawn),
                                  "",
                                  "law")
                 << heading("Conditions")
                 << html_table(condition_lines(parameters, runs), "values");
          html << heading("Repeat it")
               << repetition(parameters, runs, is_one_case);
        }
      drawn.page.write(title_of(parameters,
                                runs.empty() ? "slipstep" :
                                               runs[0].summary.case_name),
                       rows.empty() ?
                         headline_of_pushes(runs) :
                         headline(rows,
                                  drawn.reference,
                                  is_one_case && has_one_law(parameters)),
                       html.str());
    }
  } // namespace



  bool has_one_law(const Parameters &parameters)
  {
    for (const Variant &variant : parameters.variants())
      for (const Variant::Override &change : variant.overrides)
        if (boost::algorithm::starts_with(change.path, "Friction/"))
          return false;
    return true;
  }



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
    if (stability.size() > 1)
      text += "\n" + text_table(stability);
    std::string failures, of_energy, of_mesh;
    for (const RunResults &run : results)
      {
        const auto tell = [&](std::string       &lines,
                              const std::string &kind,
                              const std::string &what) {
          if (!what.empty())
            lines += "  " + run_name(run) + kind + what + "\n";
        };
        if (run.summary.status == "failed")
          tell(failures, ": failed: ", run.summary.reason);
        tell(of_energy, ": warning: ", run.summary.missing_energy());
        tell(of_mesh, ": warning: ", run.summary.mesh_error.missed());
      }
    text += failures + of_energy + of_mesh;
    for (const std::string &problem : problems)
      text += "  " + problem + "\n";
    return text;
  }



  std::vector<std::string> write_report(const std::filesystem::path &folder,
                                        const Parameters            &parameters,
                                        const std::vector<ReportedRun> &runs,
                                        const std::string              &study,
                                        const bool is_one_case)
  {
    const Reference reference(parameters);
    Page            page(folder);
    const auto      results = load_runs(runs, page.warnings);
    RunFigures      figures{page, parameters, results, reference};
    draw_pictures(figures);
    const std::string law = law_at_work(figures);
    write_page(figures, law, study, is_one_case);
    return page.warnings;
  }
} // namespace SlipStep
