#include <slipstep/experiment/report.h>

#include <slipstep/experiment/report_data.h>
#include <slipstep/experiment/report_figures.h>
#include <slipstep/experiment/report_html.h>
#include <slipstep/utilities/figure.h>
#include <slipstep/utilities/version.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
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
  }



  namespace
  {
    /// Length in characters, not bytes.
    std::size_t text_width(const std::string &text)
    {
      return std::count_if(text.begin(), text.end(), [](const char c) {
        return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
      });
    }

    /// Columns to the right, but the first, which holds names.
    std::string text_table(const std::vector<TableLine> &lines)
    {
      std::vector<std::size_t> widths(lines[0].size(), 0);
      for (const TableLine &line : lines)
        for (std::size_t i = 0; i < line.size(); ++i)
          widths[i] = std::max(widths[i], text_width(line[i]));

      std::string text;
      for (std::size_t n = 0; n < lines.size(); ++n)
        {
          for (std::size_t i = 0; i < lines[n].size(); ++i)
            {
              const std::string space(widths[i] - text_width(lines[n][i]), ' ');
              text += (i == 0 ? "  " : "   ") +
                      (i == 0 ? lines[n][i] + space : space + lines[n][i]);
            }
          text.erase(text.find_last_not_of(' ') + 1);
          text += '\n';
          if (n == 0)
            {
              std::size_t total = 0;
              for (const std::size_t width : widths)
                total += width + 3;
              text += "  " + std::string(total - 3, '-') + '\n';
            }
        }
      return text;
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

    /// Whether labels say more than the column of speeds does.
    bool labels_matter(const std::vector<ResultRow> &rows)
    {
      return std::any_of(rows.begin(), rows.end(), [&](const ResultRow &row) {
        return !row.label.empty() && row.label != speed_text(row.slide.speed);
      });
    }

    /// The table of results; the report shows more columns than the terminal.
    std::vector<TableLine> result_lines(const std::vector<ResultRow> &rows,
                                        const Reference              &reference,
                                        const bool                    in_full)
    {
      const bool with_labels = labels_matter(rows);
      const bool with_angles = angles_matter(rows);
      TableLine  head;
      if (with_labels)
        head.push_back("run");
      head.push_back("speed [mm/min]");
      if (with_angles)
        head.push_back("angle [deg]");
      head.insert(head.end(), {"peak", "kinetic"});
      if (reference.exists())
        head.insert(head.end(), {reference.name(), "difference [%]"});
      if (in_full)
        head.insert(head.end(),
                    {"drop [%]", "peak after [mm]", "length [mm]", "r", "μ"});

      std::vector<TableLine> lines = {head};
      for (const ResultRow &row : rows)
        {
          const SlideSummary &slide = row.slide;
          TableLine           line;
          if (with_labels)
            line.push_back(row.label);
          line.push_back((is_reverse(slide) && !with_angles ? "-" : "") +
                         short_text(60. * slide.speed));
          if (with_angles)
            line.push_back(
              short_text(slide.angle * 180. / dealii::numbers::PI));
          line.insert(line.end(),
                      {fixed_text(slide.peak, 4),
                       fixed_text(slide.kinetic, 4)});
          if (reference.exists())
            line.insert(line.end(),
                        {fixed_text(row.reference, 4),
                         (row.difference > 0. ? "+" : "") +
                           fixed_text(row.difference, 2)});
          if (in_full)
            line.insert(line.end(),
                        {fixed_text(row.drop, 2),
                         short_text(slide.peak_displacement, 3),
                         short_text(slide.length),
                         fixed_text(slide.dynamic_ratio, 4),
                         fixed_text(slide.coefficient, 4)});
          lines.push_back(line);
        }
      return lines;
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
      return "<h2>Quantities of interest</h2>\n" + html_table(lines);
    }

    std::vector<TableLine> effect_lines(const Parameters &parameters,
                                        const RunResults &run)
    {
      std::vector<TableLine> lines = {{"effect", "parameter", "value"}};
      for (const std::string &effect : run.summary.effects)
        {
          const std::string section = "Friction/" + effect + "/";
          const auto        paths   = parameters.paths(section);
          for (const std::string &path : paths)
            lines.push_back({path == paths.front() ? effect : "",
                             path.substr(section.size()),
                             parameters.text(path)});
          if (paths.empty())
            lines.push_back({effect, "", ""});
        }
      return lines;
    }

    bool begins_with(const std::string &text, const std::string &beginning)
    {
      return text.compare(0, beginning.size(), beginning) == 0;
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
                          return begins_with(path, "Friction/" + effect + "/");
                        });
          if (parameters.is_set(path) && !shown_above &&
              !begins_with(path, "Report/"))
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
      text += text_table(result_lines(rows, reference, false));
    for (const RunResults &run : results)
      if (run.summary.status == "failed")
        text += "  " + run_name(run) + ": failed: " + run.summary.reason + "\n";
    for (const std::string &problem : problems)
      text += "  " + problem + "\n";
    return text;
  }



  namespace
  {
    const char *const style = R"(
:root { color-scheme: light; }
body { font: 16px/1.5 "DejaVu Sans", Verdana, sans-serif; color: #222;
  background: #fff; max-width: 900px; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.6em; margin: 0 0 .2em; }
h2 { font-size: 1.2em; margin: 2em 0 .5em; border-bottom: 1px solid #ccc;
  padding-bottom: .15em; }
.headline { font-size: 1.1em; margin: .4em 0 1.2em; }
.origin { color: #666; font-size: .85em; }
.problem { border-left: 4px solid #D55E00; background: #fdf3ec;
  padding: .5em .8em; margin: .8em 0; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .85em; margin: .5em 0 1em;
  font-variant-numeric: tabular-nums; }
th { text-align: left; vertical-align: bottom; border-bottom: 2px solid #888;
  font-weight: 600; }
th, td { padding: .25em .8em .25em 0; }
td { border-bottom: 1px solid #e4e4e4; vertical-align: top; }
.numbers th, .numbers td { text-align: right; }
.numbers th:first-child, .numbers td:first-child { text-align: left;
  white-space: nowrap; }
.values td:last-child { font-family: "DejaVu Sans Mono", monospace; }
figure { margin: 0 0 1.5em; break-inside: avoid; }
figcaption { color: #555; font-size: .85em; }
svg { width: 100%; height: auto; display: block; }
.map svg path, .map svg polygon { shape-rendering: crispEdges; }
summary { cursor: pointer; color: #0072B2; margin: 1em 0; }
pre { background: #f4f4f4; padding: .7em 1em; overflow-x: auto;
  font-size: .85em; }
@media print { body { margin: 0; max-width: none; font-size: 11pt; }
  .scroll { overflow: visible; } h2 { break-after: avoid; }
  tr { break-inside: avoid; } pre { white-space: pre-wrap; } }
)";

    std::string problem_boxes(const std::vector<RunResults>  &runs,
                              const std::vector<std::string> &warnings)
    {
      std::string html;
      const auto  add = [&html](const std::string &text) {
        html += "<p class='problem'>" + html_text(text) + "</p>\n";
      };
      for (const RunResults &run : runs)
        {
          if (run.summary.status == "failed")
            add("Run " + run_name(run) + " failed: " + run.summary.reason +
                ". What follows shows it up to there.");
          for (const std::string &warning : run.summary.warnings)
            add("Run " + run_name(run) + ": " + warning);
        }
      for (const std::string &warning : warnings)
        add(warning);
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

    std::string quoted(const std::string &text)
    {
      return text.find_first_of(" '\"$&;()<>|*?`\\") == std::string::npos ?
               text :
               "\"" + text + "\"";
    }

    /// The options --set that the user gave.
    std::string settings(const Parameters &parameters)
    {
      std::string text;
      for (const std::string &path : parameters.paths())
        if (parameters.is_set(path) &&
            begins_with(parameters.origin(path), "--set"))
          text += " --set \"" + path + "=" + parameters.text(path) + "\"";
      return text;
    }

    /// How to get these results again.
    std::string repetition(const Parameters              &parameters,
                           const std::vector<RunResults> &runs)
    {
      // ./run tells how it was called.
      const char *const script = std::getenv("SLIPSTEP_CALLED_AS");
      const auto        call = [&](const Summary &s, const std::string &file) {
        return (s.ranks > 1 ?
                         "mpirun -np " + std::to_string(s.ranks) + " slipstep " :
                       script != nullptr ? quoted(script) + " " :
                                           "slipstep ") +
               s.command + " " + quoted(file);
      };
      std::string html =
        "<p>The whole case, as its file is now:</p>\n<pre>" +
        html_text(call(runs[0].summary, parameters.case_file().string()) +
                  settings(parameters)) +
        "\n</pre>\n";
      std::string single;
      for (const RunResults &run : runs)
        if (std::filesystem::exists(run.folder / "used_parameters.prm"))
          single +=
            call(run.summary, (run.folder / "used_parameters.prm").string()) +
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

    std::string page(const Parameters               &parameters,
                     const Reference                &reference,
                     const std::vector<RunResults>  &runs,
                     const std::vector<Picture>     &pictures,
                     const std::string              &study,
                     const std::vector<std::string> &warnings)
    {
      const auto         rows  = result_rows(runs, reference);
      const std::string  title = html_text(case_title(parameters, runs));
      std::ostringstream html;
      html << "<!DOCTYPE html>\n<html lang='en'>\n<head>\n"
           << "<meta charset='utf-8'>\n<meta name='viewport' "
           << "content='width=device-width, initial-scale=1'>\n<title>" << title
           << "</title>\n<style>" << style << "</style>\n</head>\n<body>\n<h1>"
           << title << "</h1>\n<p class='headline'>"
           << html_text(headline(rows, reference)) << "</p>\n"
           << problem_boxes(runs, warnings) << study;
      if (!rows.empty())
        html
          << html_table(result_lines(rows, reference, true))
          << "<p class='origin'>kinetic, r, μ: at the end of the slide, means "
             "over the contact face; drop: from peak to kinetic.</p>\n";
      html << figures(pictures);
      if (!runs.empty())
        {
          html << "<h2>Energy</h2>\n"
               << html_table(energy_lines(runs)) << quantities(runs)
               << "<h2>Cost</h2>\n"
               << html_table(cost_lines(runs)) << "<h2>Friction law</h2>\n"
               << html_table(effect_lines(parameters, runs[0]), "values")
               << "<h2>Conditions</h2>\n"
               << html_table(condition_lines(parameters, runs), "values")
               << "<h2>Repeat it</h2>\n"
               << repetition(parameters, runs);
        }
      html << "<p class='origin'>slipstep " << html_text(version()) << " ("
           << html_text(git_hash())
           << "). Data and gnuplot scripts of the pictures: folder report/ "
              "beside this file.</p>\n</body>\n</html>\n";
      return html.str();
    }
  } // namespace



  std::vector<std::string> write_report(const std::filesystem::path &folder,
                                        const Parameters            &parameters,
                                        const std::vector<ReportedRun> &runs,
                                        const std::string              &study)
  {
    const Reference             reference(parameters);
    std::vector<std::string>    warnings;
    const auto                  results        = load_runs(runs, warnings);
    const std::filesystem::path picture_folder = folder / "report";
    std::filesystem::create_directories(picture_folder);
    const auto pictures =
      draw_pictures(picture_folder, results, reference, warnings);

    const std::filesystem::path file = folder / "report.html";
    std::ofstream               out(file);
    out << page(parameters, reference, results, pictures, study, warnings)
        << std::flush;
    if (!out)
      throw RunError(file.string() +
                     ": this file cannot be written (is the disk full?)");
    return warnings;
  }
} // namespace SlipStep
