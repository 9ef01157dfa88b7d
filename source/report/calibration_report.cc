// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/calibration_report.h>

#include <slipstep/report/calibration_figures.h>
#include <slipstep/report/calibration_text.h>

#include <slipstep/report/run_results.h>
#include <slipstep/report/page.h>
#include <slipstep/report/figure.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/write_file.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// What the reader must not miss: results that the tests do not support.
    std::string weak_section(const Calibration &calibration)
    {
      std::string       html  = heading("What these tests do not determine");
      const std::string open  = open_intervals(calibration);
      const std::string close = close_pairs(calibration);
      if (calibration.weak.empty() && open.empty())
        html += "<p>Every parameter has an interval between its bounds.</p>\n";
      for (const WeakDirection &direction : calibration.weak)
        html += "<div class='problem'>" + html_text(direction.words) +
                "<br><span class='origin'>Along one standard deviation: " +
                html_text(change_text(calibration, direction)) +
                "</span></div>\n";
      if (!open.empty())
        html += problem_box(open);
      if (!close.empty())
        html += "<p>" + html_text(close) + "</p>\n";
      return html;
    }

    std::vector<TableLine> parameter_lines(const Calibration &calibration)
    {
      std::vector<TableLine> lines = {{"parameter",
                                       "unit",
                                       "value",
                                       interval_name(calibration.confidence),
                                       "standard deviation",
                                       "start",
                                       "bounds"}};
      for (const FittedParameter &fitted : calibration.parameters)
        {
          const FitParameter &parameter = fitted.parameter;
          const auto          text      = [&](const double value) {
            return plain_text(parameter.in_unit(value), 5);
          };
          lines.push_back(
            {parameter.path,
             parameter.unit().empty() ? "–" : parameter.unit(),
             digits_text(fitted, fitted.value) +
               (fitted.is_at_bound ? " (at bound)" : ""),
             interval_text(fitted),
             deviation_text(fitted),
             text(parameter.start),
             text(parameter.lower) + " … " + text(parameter.upper)});
        }
      return lines;
    }

    std::string parameter_section(const Calibration &calibration)
    {
      std::string text =
        "≥, ≤, open: the tests do not limit the value on the other side. "
        "×/÷: the scale is logarithmic. " +
        std::to_string(calibration.n_rows) + " rows count as " +
        fixed_text(calibration.n_effective, 0) + " independent ones";
      if (calibration.inflation > 1.)
        text += "; all variances are multiplied by " +
                short_text(calibration.inflation, 3) +
                ", because what is left over is larger than the noise or "
                "hangs together";
      return heading("Parameters") +
             html_table(parameter_lines(calibration), "numbers unbroken") +
             note(text + ".");
    }

    std::string derived_section(const Calibration &calibration)
    {
      if (calibration.derived.empty())
        return "";
      return heading("Derived quantities") +
             html_table(derived_lines(calibration, true)) +
             note("In units of mm, s, N, MPa, rad.");
    }

    /// Blue for negative, orange for positive, both pale enough for the number
    /// on them.
    std::string correlation_colour(const double correlation)
    {
      const Colour3 end =
        correlation < 0. ? Colour3{{0., 114., 178.}} : Colour3{{213., 94., 0.}};
      return background({{{255., 255., 255.}}, end},
                        std::isfinite(correlation) ?
                          0.7 * std::min(std::abs(correlation), 1.) :
                          0.);
    }

    /// A place where a long name may be broken.
    std::string breakable(const std::string &name)
    {
      std::string html;
      for (const char c : html_text(name))
        html += c == '/' ? std::string("/<wbr>") : std::string(1, c);
      return html;
    }

    std::string correlation_section(const Calibration &calibration)
    {
      const auto &matrix = calibration.correlation;
      if (matrix.size() < 2)
        return "";
      std::string html =
        heading("Correlation of the parameters") +
        "<div class='scroll'><table class='numbers matrix'>\n<thead><tr><td></td>";
      for (const FittedParameter &fitted : calibration.parameters)
        html +=
          "<th scope='col'>" + breakable(label_of(fitted.parameter)) + "</th>";
      html += "</tr></thead>\n<tbody>\n";
      for (std::size_t i = 0; i < matrix.size(); ++i)
        {
          html += "<tr><th scope='row'>" +
                  html_text(label_of(calibration.parameters[i].parameter)) +
                  "</th>";
          for (std::size_t j = 0; j < matrix[i].size(); ++j)
            html += i == j ? std::string("<td style='background:#eee'>1</td>") :
                             "<td style='" + correlation_colour(matrix[i][j]) +
                               "'>" + correlation_text(matrix[i][j]) + "</td>";
          html += "</tr>\n";
        }
      return html + "</tbody></table></div>\n" +
             note("Near 1 or -1, two parameters make up for each other; 0 also "
                  "where nothing is known of one. Blue: negative, orange: "
                  "positive.");
    }

    std::string tests_section(const Calibration &calibration)
    {
      if (calibration.tests.empty())
        return "";
      return heading("Tests") + html_table(test_lines(calibration, true)) +
             note("rms: of measured minus fitted friction; start rms: with the "
                  "start values; noise: estimated from the rows unless stated; "
                  "correlated rows: how many in a row are off together; work: "
                  "of friction per area of contact.");
    }

    /// In how far the result depends on where the search began.
    std::string verdict(const std::vector<StartComparison> &starts)
    {
      const std::size_t n_same =
        count_if(starts,
                 [](const StartComparison &start) { return start.is_same; });
      const std::size_t n_equal =
        count_if(starts,
                 [](const StartComparison &start) { return start.is_equal; });
      std::string text = std::to_string(n_same) + " of " +
                         std::to_string(starts.size()) +
                         " searches ended in the best optimum";
      if (n_equal > n_same)
        text += "; " + std::to_string(n_equal - n_same) +
                " found values elsewhere that fit as well, so that the tests "
                "do not tell them apart";
      if (n_same == 1 && starts.size() > 1 && n_equal == 1)
        text += ": a better one may have been missed";
      return text + ".";
    }

    std::string starts_section(const Calibration &calibration)
    {
      const std::vector<StartComparison> compared = compare_starts(calibration);
      if (compared.empty())
        return "";
      std::vector<TableLine> lines = {{"search",
                                       "misfit at the end",
                                       "above the best",
                                       "largest distance [% of the range]",
                                       "of",
                                       "iterations",
                                       "ended because"}};
      for (std::size_t i = 0; i < compared.size(); ++i)
        {
          const StartResult     &start        = calibration.starts[i];
          const StartComparison &comparison   = compared[i];
          const bool             has_distance = comparison.distance > 0.;
          lines.push_back(
            {std::to_string(i + 1),
             short_text(start.misfit, 6),
             i == 0 ? "best" : plain_text(comparison.excess, 3),
             comparison.has_end && i > 0 ?
               fixed_text(100. * comparison.distance, 1) :
               "–",
             has_distance ?
               label_of(calibration.parameters[comparison.farthest].parameter) :
               "–",
             std::to_string(start.iterations),
             start.message});
        }
      return heading("Does it depend on the start?") + "<p>" +
             verdict(compared) + "</p>\n" + html_table(lines) +
             note("The misfit is the sum of squares of difference over noise; "
                  "with the start values of the case it was " +
                  short_text(calibration.start_misfit, 6) + ".");
    }

    std::string cost_section(const Calibration &calibration)
    {
      return heading("Cost") +
             html_table({{"simulations of all tests",
                          "steps of one",
                          "wall time [s]",
                          "CPU time [s]"},
                         {std::to_string(calibration.n_simulations),
                          std::to_string(calibration.n_steps),
                          fixed_text(calibration.wall_time, 1),
                          fixed_text(calibration.cpu_time, 1)}});
    }
  } // namespace



  std::vector<std::string>
  write_calibration_report(const std::filesystem::path &folder,
                           const Parameters            &parameters,
                           const Calibration           &calibration)
  {
    const std::filesystem::path picture_folder = folder / "report";
    std::filesystem::create_directories(picture_folder);
    std::vector<std::string> warnings;
    std::string              curves;
    for (const Gallery &gallery :
         draw_curves(picture_folder, calibration, warnings))
      curves += gallery_section(gallery);
    const Gallery profiles =
      draw_fitted_profiles(picture_folder, calibration, warnings);

    std::string content;
    for (const std::string &warning : calibration.warnings)
      content += problem_box(warning);
    for (const std::string &warning : warnings)
      content += problem_box(warning);
    content += weak_section(calibration) + parameter_section(calibration) +
               derived_section(calibration) + curves +
               gallery_section(profiles) + correlation_section(calibration) +
               tests_section(calibration) + starts_section(calibration) +
               cost_section(calibration) +
               repeat_section("calibrate", parameters);
    write_file(folder / "report.html",
               html_page(title_of(parameters) + ": calibration",
                         calibration_headline(calibration),
                         content));
    return warnings;
  }
} // namespace SlipStep
