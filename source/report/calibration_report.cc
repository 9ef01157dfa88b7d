// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/calibration_report.h>

#include <slipstep/report/curves.h>
#include <slipstep/report/profiles.h>

#include <boost/algorithm/string/replace.hpp>
#include <boost/math/distributions/normal.hpp>

namespace SlipStep
{
  namespace
  {
    /// Over all rows of all tests.
    double total_rms(const Calibration &calibration, double TestMisfit::*rms)
    {
      double sum = 0., n = 0.;
      for (const TestMisfit &test : calibration.tests)
        {
          sum += test.n_rows * test.*rms * test.*rms;
          n += test.n_rows;
        }
      return std::sqrt(sum / n);
    }

    /// Beyond this a factor says only that nothing is known.
    constexpr double largest_factor = 1000.;

    std::string factor_text(const double logarithm)
    {
      const double factor = std::exp(std::abs(logarithm));
      return factor > largest_factor ? "> " + short_text(largest_factor) :
                                       short_text(factor, factor < 1.1 ? 4 : 3);
    }



    bool is_open(const FittedParameter &fitted)
    {
      return fitted.constraint.empty() &&
             (fitted.is_lower_open || fitted.is_upper_open);
    }



    TableLines short_parameter_lines(const Calibration &calibration)
    {
      TableLines lines = {table_head("parameter | value | unit | " +
                                     interval_name(calibration.confidence) +
                                     " | start")};
      for (const FittedParameter &fitted : calibration.parameters)
        lines.push_back(
          {label_of(fitted.parameter),
           (fitted.is_at_bound ? "* " : "") + digits_text(fitted, fitted.value),
           fitted.parameter.unit(),
           interval_text(fitted),
           plain_text(fitted.parameter.in_unit(fitted.parameter.start), 5)});
      return lines;
    }

    /// "6 parameters from 4 tests: rms difference of friction 0.0021 ..."
    std::string calibration_headline(const Calibration &calibration)
    {
      std::string text =
        counted(calibration.parameters.size(), "parameter") + " from " +
        counted(calibration.tests.size(), "test") +
        ": rms difference of friction " +
        short_text(total_rms(calibration, &TestMisfit::rms), 3);
      const double ratio = std::sqrt(calibration.misfit / calibration.n_rows);
      if (std::isfinite(ratio))
        text += ", " +
                (ratio < 10. ? fixed_text(ratio, 2) : short_text(ratio, 3)) +
                " times the noise";
      text += "; it was " +
              short_text(total_rms(calibration, &TestMisfit::start_rms), 3) +
              " with the start values.";
      const std::size_t n_open = count_if(calibration.parameters, is_open);
      if (n_open > 0)
        text += " " + counted(n_open, "parameter") +
                (n_open == 1 ? " has" : " have") + " an open interval.";
      return text;
    }

    /// Those parameters whose interval is open, "" if there are none.
    std::string open_intervals(const Calibration &calibration)
    {
      std::string text;
      for (const FittedParameter &fitted : calibration.parameters)
        if (is_open(fitted))
          text += (text.empty() ? "" : ", ") + label_of(fitted.parameter) +
                  (!fitted.is_upper_open ? " (no lower end)" :
                   !fitted.is_lower_open ? " (no upper end)" :
                                           " (neither end)");
      return text.empty() ?
               "" :
               "Within the bounds given, these tests do not limit: " + text +
                 ".";
    }

    /// What one standard deviation along a weak direction changes:
    /// "Rate × 1.5, Amount -0.03".
    std::string change_text(const Calibration   &calibration,
                            const WeakDirection &direction)
    {
      std::string text;
      for (const std::size_t i : direction.members)
        {
          const FitParameter &parameter = calibration.parameters[i].parameter;
          const double        change    = direction.change[i];
          const std::string   unit      = parameter.unit();
          text += (text.empty() ? "" : ", ") + label_of(parameter);
          if (parameter.is_logarithmic)
            text += (change < 0. ? " ÷ " : " × ") + factor_text(change);
          else
            text += (change < 0. ? " " : " +") +
                    short_text(parameter.in_unit(change), 3) +
                    (unit.empty() ? "" : " " + unit);
        }
      return text;
    }

    /// @param in_full with what the terminal has no room for
    TableLines derived_lines(const Calibration &calibration, const bool in_full)
    {
      ColumnTable<DerivedQuantity> table(calibration.derived);
      table.add(in_full ? "quantity" : "derived", &DerivedQuantity::name);
      if (in_full)
        table.add("formula", &DerivedQuantity::formula);
      table.add_short("value", 4, &DerivedQuantity::value);
      table.add("standard deviation", [](const DerivedQuantity &quantity) {
        return std::isfinite(quantity.deviation) ?
                 "± " + short_text(quantity.deviation, 2) :
                 "unknown";
      });
      return table.lines;
    }

    TableLines test_lines(const Calibration &calibration, const bool in_full)
    {
      ColumnTable<TestMisfit> table(calibration.tests);
      table.add("test", &TestMisfit::name);
      table.add("rows", &TestMisfit::n_rows);
      table.add_short("start rms", 3, &TestMisfit::start_rms);
      table.add_short("rms", 3, &TestMisfit::rms);
      table.add("noise", [&](const TestMisfit &test) {
        return short_text(test.noise, 3) +
               (in_full && test.noise_is_stated ? " (stated)" : "");
      });
      table.add("rms/noise", 2, noise_ratio);
      if (!in_full)
        return table.lines;

      table.add("mean offset", 5, &TestMisfit::mean);
      table.add_short("correlated rows", 2, &TestMisfit::correlation_length);
      table.add_short("work measured [N/mm]", 4, &TestMisfit::measured_work);
      table.add_short("fitted [N/mm]", 4, &TestMisfit::simulated_work);
      table.add("difference [%]", [](const TestMisfit &test) {
        const double difference =
          100. * (test.simulated_work / test.measured_work - 1.);
        return (difference > 0. ? "+" : "") + fixed_text(difference, 2);
      });
      return table.lines;
    }



    /// Whether both parameters are members of the same weak direction.
    bool are_named(const Calibration &calibration,
                   const std::size_t  i,
                   const std::size_t  j)
    {
      return any_of(calibration.weak, [&](const WeakDirection &weak) {
        return holds(weak.members, i) && holds(weak.members, j);
      });
    }

    std::string correlation_text(const double correlation)
    {
      // Full correlation is claimed only where it is full.
      if (std::abs(correlation) > 0.9999 && std::abs(correlation) < 1.)
        return correlation < 0. ? "< -0.9999" : "> 0.9999";
      return fixed_text(correlation, std::abs(correlation) > 0.99 ? 4 : 2);
    }

    /// Pairs that the tests determine only together, apart from those that a
    /// weak direction names; "" if there are none.
    std::string close_pairs(const Calibration &calibration)
    {
      constexpr double                            close    = 0.95;
      constexpr std::size_t                       n_listed = 6;
      std::vector<std::pair<double, std::string>> pairs;
      const auto &matrix = calibration.correlation;
      for (std::size_t i = 0; i < matrix.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          if (std::abs(matrix[i][j]) > close && !are_named(calibration, i, j))
            pairs.emplace_back(std::abs(matrix[i][j]),
                               label_of(calibration.parameters[j].parameter) +
                                 " and " +
                                 label_of(calibration.parameters[i].parameter) +
                                 " (" + correlation_text(matrix[i][j]) + ")");
      if (pairs.empty())
        return "";
      stable_sort(pairs, [](const auto &a, const auto &b) {
        return a.first > b.first;
      });
      std::string text;
      for (std::size_t i = 0; i < std::min(pairs.size(), n_listed); ++i)
        text += (i > 0 ? ", " : "") + pairs[i].second;
      if (pairs.size() > n_listed)
        text += ", and " + std::to_string(pairs.size() - n_listed) + " more";
      return "These values depend on each other, so that changing one alone "
             "spoils the fit (correlation): " +
             text + ".";
    }

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
        html += paragraph(open, "problem");
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
                ", because the remaining differences are larger than the "
                "noise or correlated";
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



    std::string correlation_section(const Calibration &calibration)
    {
      const auto &matrix = calibration.correlation;
      if (matrix.size() < 2)
        return "";
      std::string html =
        heading("Correlation of the parameters") +
        "<div class='scroll'><table class='numbers matrix'>\n<thead><tr><td></td>";
      // Long names may be broken.
      for (const FittedParameter &fitted : calibration.parameters)
        html += "<th scope='col'>" +
                boost::algorithm::replace_all_copy(
                  html_text(label_of(fitted.parameter)), "/", "/<wbr>") +
                "</th>";
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
             note("Near 1 or -1, two parameters compensate each other; 0 also "
                  "where nothing is known about one of them. Blue: negative, "
                  "orange: positive.");
    }

    /// In how far the result depends on where the search began.
    std::string verdict(const std::vector<StartComparison> &starts)
    {
      const std::size_t n_same =
        count_if(starts, std::mem_fn(&StartComparison::is_same));
      const std::size_t n_equal =
        count_if(starts, std::mem_fn(&StartComparison::is_equal));
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
      const auto             add = [&](const TestMisfit          &test,
                           const std::string         &condition,
                           const std::vector<double> &displacement,
                           const std::vector<double> &measured,
                           const std::vector<double> &simulated,
                           const double               noise) {
        tests.push_back({test.name,
                         condition,
                         test.time,
                         displacement,
                         measured,
                         {},
                         simulated,
                         std::isfinite(noise) ? noise : 0.,
                         test.noise > 0. ? noise_ratio(test) : test.rms,
                         {}});
      };
      for (const TestMisfit &test : calibration.tests)
        {
          add(test,
              test.condition,
              test.displacement,
              test.measured,
              test.simulated,
              test.noise_1 > 0. ? test.noise_1 : test.noise);
          if (!test.measured_2.empty())
            add(test,
                (test.condition.empty() ? test.name : test.condition) +
                  ", second axis",
                test.displacement_2,
                test.measured_2,
                test.simulated_2,
                test.noise_2);
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
      return html + draw_residuals(page, frames);
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



  std::string interval_name(const double confidence)
  {
    return short_text(100. * confidence) + " % interval";
  }



  std::string digits_text(const FittedParameter &fitted, const double value)
  {
    const FitParameter &parameter = fitted.parameter;
    const double        size      = std::abs(parameter.in_unit(fitted.value));
    const double        deviation = parameter.is_logarithmic ?
                                      fitted.deviation * size :
                                      parameter.in_unit(fitted.deviation);
    const double        shown     = parameter.in_unit(value);
    // Two digits of the deviation, the value to the same decimals; but not for
    // values that differ by orders of magnitude or need many zeros.
    if (deviation > 0. && deviation < 0.3 * size && size > 1e-3 && size < 1e6 &&
        (!parameter.is_logarithmic || shown > 0.1 * size))
      {
        const int decimals = 1 - std::floor(std::log10(deviation));
        if (decimals >= 0)
          return fixed_text(shown, std::min(decimals, 8));
        const double step = std::pow(10., -decimals);
        return fixed_text(step * std::round(shown / step), 0);
      }
    const bool   is_known = deviation > 0. && deviation < size;
    const double digits   = is_known ? 2. - std::log10(deviation / size) : 3.;
    return plain_text(shown, std::clamp(static_cast<int>(digits), 3, 7));
  }



  std::string interval_text(const FittedParameter &fitted)
  {
    if (!fitted.constraint.empty())
      return "–";
    const std::string lower = digits_text(fitted, fitted.lower);
    const std::string upper = digits_text(fitted, fitted.upper);
    return fitted.is_lower_open ?
             (fitted.is_upper_open ? "open" : "≤ " + upper) :
             (fitted.is_upper_open ? "≥ " + lower : lower + " … " + upper);
  }



  std::string deviation_text(const FittedParameter &fitted)
  {
    if (!std::isfinite(fitted.deviation))
      return "unknown";
    return fitted.parameter.is_logarithmic ?
             "×/÷ " + factor_text(fitted.deviation) :
             "± " + short_text(fitted.parameter.in_unit(fitted.deviation), 2);
  }



  std::string calibration_table(const Calibration &calibration)
  {
    std::string text = wrapped_text(calibration_headline(calibration)) +
                       table_paragraph(short_parameter_lines(calibration));
    if (any_of(calibration.parameters,
               std::mem_fn(&FittedParameter::is_at_bound)))
      text += "  * at a bound, or at a condition of the law\n";
    text += table_paragraph(derived_lines(calibration, false)) +
            table_paragraph(test_lines(calibration, false));
    if (!calibration.weak.empty())
      text += "\n  What these tests hardly determine:\n";
    for (const WeakDirection &direction : calibration.weak)
      {
        std::string words = wrapped_text(direction.words, 4);
        if (words.size() > 2)
          words[2] = '-';
        text += words;
      }
    return text;
  }



  std::vector<std::string>
  write_calibration_report(const std::filesystem::path &folder,
                           const Parameters            &parameters,
                           const Calibration           &calibration)
  {
    Page              page(folder);
    const std::string curves   = draw_curves(page, calibration);
    const std::string profiles = draw_fitted_profiles(page, calibration);
    page.write(
      title_of(parameters) + ": calibration",
      calibration_headline(calibration),
      problem_boxes(calibration.warnings) + problem_boxes(page.warnings) +
        weak_section(calibration) + parameter_section(calibration) +
        table_section("Derived quantities",
                      derived_lines(calibration, true),
                      "In units of mm, s, N, MPa, rad.") +
        curves + profiles + correlation_section(calibration) +
        table_section(
          "Tests",
          test_lines(calibration, true),
          "rms: of measured minus fitted friction; start rms: with the start "
          "values; noise: estimated from the rows unless stated; correlated "
          "rows: how many successive rows deviate together; work: of friction "
          "per area of contact.") +
        starts_section(calibration) + cost_section(calibration) +
        heading("Repeat it") + case_call("calibrate", parameters));
    return page.warnings;
  }
} // namespace SlipStep
