// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/calibration_report.h>

#include <slipstep/report/curves.h>
#include <slipstep/utilities/text.h>

#include <boost/algorithm/string/replace.hpp>
#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <array>
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
        html += paragraph(close);
      return html;
    }

    TableLines parameter_lines(const Calibration &calibration)
    {
      TableLines lines = {table_head("parameter | unit | value | " +
                                     interval_name(calibration.confidence) +
                                     " | standard deviation | start | bounds")};
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
      return boost::algorithm::replace_all_copy(html_text(name), "/", "/<wbr>");
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
      return table_section(
        "Tests",
        test_lines(calibration, true),
        "rms: of measured minus fitted friction; start rms: with the start "
        "values; noise: estimated from the rows unless stated; correlated "
        "rows: how many in a row are off together; work: of friction per area "
        "of contact.");
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
      TableLines lines = {table_head(
        "search | misfit at the end | above the best | "
        "largest distance [% of the range] | of | iterations | ended because")};
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



    std::vector<DrawnTest> drawn_tests(const Calibration &calibration)
    {
      std::vector<DrawnTest> tests;
      for (const TestMisfit &test : calibration.tests)
        {
          DrawnTest drawn;
          drawn.name         = test.name;
          drawn.condition    = test.condition;
          drawn.time         = test.time;
          drawn.displacement = test.displacement;
          drawn.measured     = test.measured;
          drawn.simulated    = test.simulated;
          drawn.noise        = std::isfinite(test.noise) ? test.noise : 0.;
          drawn.gap          = test.noise > 0. ? noise_ratio(test) : test.rms;
          tests.push_back(drawn);
        }
      return tests;
    }

    /// The frames whose friction has its peak early, up to some way after it.
    std::vector<ConditionFrame>
    beginnings(const std::vector<ConditionFrame> &frames)
    {
      std::vector<ConditionFrame> result;
      for (const ConditionFrame &frame : frames)
        {
          if (frame.is_over_time)
            continue;
          double distance = 0.;
          bool   is_back  = false;
          for (const DrawnTest *const test : frame.tests)
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
          if (length == 0. || length > 0.4 * frame.x.width())
            continue;
          ConditionFrame beginning = frame;
          if (is_back)
            beginning.x.lower = frame.x.upper - length;
          else
            beginning.x.upper = frame.x.lower + length;
          // A handful of rows shows nothing new when enlarged.
          const auto &x = frame.tests.front()->displacement;
          if (count_if(x, [&](const double position) {
                return position >= beginning.x.lower &&
                       position <= beginning.x.upper;
              }) >= 20)
            result.push_back(beginning);
        }
      return result;
    }

    std::vector<double> residuals(const DrawnTest &test)
    {
      std::vector<double> result;
      for (std::size_t i = 0; i < test.measured.size(); ++i)
        result.push_back(test.measured[i] - test.simulated[i]);
      return result;
    }

    /// What the residuals of all tests of a frame have in common, which noise
    /// would hide; none for few rows.
    Rows local_means(const ConditionFrame &frame)
    {
      constexpr std::size_t            n_parts = 40, least = 5;
      std::array<double, n_parts>      sum{};
      std::array<std::size_t, n_parts> count{};
      for (const DrawnTest *const test : frame.tests)
        {
          const std::vector<double> left_over = residuals(*test);
          for (std::size_t i = 0; i < left_over.size(); ++i)
            {
              const double share =
                (frame.abscissa(*test)[i] - frame.x.lower) / frame.x.width();
              if (!std::isfinite(left_over[i]) || !(share >= 0. && share <= 1.))
                continue;
              const auto part =
                std::min(static_cast<std::size_t>(share * n_parts),
                         n_parts - 1);
              sum[part] += left_over[i];
              ++count[part];
            }
        }
      Rows rows;
      for (std::size_t part = 0; part < n_parts; ++part)
        if (count[part] >= least)
          rows.push_back(
            {frame.x.lower + (part + 0.5) / n_parts * frame.x.width(),
             sum[part] / count[part]});
      return rows.size() > 1 ? rows : Rows();
    }

    const LegendLine residual_line = {"measured − fitted", Colour::measured},
                     mean_line     = {"local mean", "#000000"};

    void draw_residuals(SmallPicture &picture, const ConditionFrame &frame)
    {
      double band = 0.;
      Range  y;
      for (const DrawnTest *const test : frame.tests)
        band = std::max(band, 2. * test->noise);
      picture.plot(picture.add_data("twice the noise",
                                    {"position", "lower", "upper"},
                                    {{frame.x.lower, -band, band},
                                     {frame.x.upper, -band, band}}) +
                   " using 1:2:3 with filledcurves fillcolor rgb '" +
                   noise_band_line.colour + "'");
      for (std::size_t i = frame.tests.size(); i-- > 0;)
        {
          const DrawnTest &test = *frame.tests[i];
          const Rows       rows = frame.rows(test, residuals(test));
          for (const auto &row : rows)
            y.add(std::abs(row[1]));
          picture.plot(
            picture.add_data(test.name,
                             {frame.is_over_time ? "time_s" : "displacement_mm",
                              "measured_minus_fitted"},
                             rows) +
            " with lines " +
            (i == 0 ? residual_line : replicate_line).style(1.2));
        }
      // Seen through dense curves.
      for (const double level : {-band, band})
        picture.plot_level(level, "lc rgb '#444444' dt (6,4) lw 1.2");
      const Rows means = local_means(frame);
      if (!means.empty())
        picture.plot(picture.add_data(frame.title + ", local means",
                                      {"position", "mean"},
                                      means) +
                     " with lines " + mean_line.style(2.2));
      y.add(band);
      frame.axes(picture, "Measured − fitted  [–]", {-y.upper, y.upper});
    }

    std::string draw_all_residuals(Page                              &page,
                                   const std::vector<ConditionFrame> &frames)
    {
      Gallery gallery{"What is left over",
                      "With a law that fits, nearly all lies within the band "
                      "and the local mean, over a fortieth of the width, "
                      "stays near zero.",
                      {residual_line}};
      for (std::size_t i = 0; i < frames.size(); ++i)
        {
          SmallPicture picture(page,
                               "residuals_" + std::to_string(i + 1),
                               frames[i].title);
          draw_residuals(picture, frames[i]);
          picture.finish(gallery);
        }
      if (any_of(frames, has_replicates))
        gallery.legend.push_back(replicate_line);
      gallery.legend.insert(gallery.legend.end(), {mean_line, noise_band_line});
      return gallery_section(gallery);
    }



    /// Measured and fitted curves, a picture per condition; the beginning of
    /// those that have an early peak; and what is left over against the noise.
    std::string draw_curves(Page &page, const Calibration &calibration)
    {
      const std::vector<DrawnTest>      tests = drawn_tests(calibration);
      std::string                       caption;
      const std::vector<ConditionFrame> frames =
        condition_frames(tests, caption);
      std::string html = draw_friction(
        page, "curves", "Measured and fitted", caption, frames, "fitted");
      html += draw_friction(page,
                            "curves_start",
                            "The beginning enlarged",
                            "",
                            beginnings(frames),
                            "fitted");
      return html + draw_all_residuals(page, frames);
    }



    std::string draw_fitted_profiles(Page &page, const Calibration &calibration)
    {
      const double quantile =
        boost::math::quantile(boost::math::normal(),
                              0.5 * (1. + calibration.confidence));
      std::vector<DrawnProfile> profiles;
      for (const FittedParameter &fitted : calibration.parameters)
        {
          const FitParameter &parameter = fitted.parameter;
          const auto          in_unit   = [&](const double value) {
            return parameter.in_unit(value);
          };
          DrawnProfile drawn{fitted.converted(in_unit),
                             label_of(parameter),
                             parameter.unit()};
          drawn.is_logarithmic = parameter.is_logarithmic;
          drawn.lower_bound    = parameter.in_unit(parameter.lower);
          drawn.upper_bound    = parameter.in_unit(parameter.upper);
          drawn.distance       = parameter.is_logarithmic ?
                                   quantile * fitted.deviation :
                                   parameter.in_unit(quantile * fitted.deviation);
          profiles.push_back(drawn);
        }
      return draw_profiles(page,
                           "How sharply each parameter is determined",
                           profiles,
                           calibration.confidence);
    }
  } // namespace



  std::vector<std::string>
  write_calibration_report(const std::filesystem::path &folder,
                           const Parameters            &parameters,
                           const Calibration           &calibration)
  {
    Page              page(folder);
    const std::string curves   = draw_curves(page, calibration);
    const std::string profiles = draw_fitted_profiles(page, calibration);
    page.write(title_of(parameters) + ": calibration",
               calibration_headline(calibration),
               problem_boxes(calibration.warnings) +
                 problem_boxes(page.warnings) + weak_section(calibration) +
                 parameter_section(calibration) +
                 table_section("Derived quantities",
                               derived_lines(calibration, true),
                               "In units of mm, s, N, MPa, rad.") +
                 curves + profiles + correlation_section(calibration) +
                 tests_section(calibration) + starts_section(calibration) +
                 cost_section(calibration) +
                 repeat_section("calibrate", parameters));
    return page.warnings;
  }
} // namespace SlipStep
