// SPDX-License-Identifier: LGPL-2.1-or-later

// Pictures of tests and of what speaks for a name: differences by phases and
// along the covariates, and profiles of the parameters.

#include <slipstep/report/diagnosis_sections.h>
#include <slipstep/report/diagnosis_report.h>
#include <slipstep/report/curves.h>
#include <slipstep/report/profiles.h>

#include <boost/math/distributions/normal.hpp>

#include <map>
#include <set>

namespace SlipStep
{
  namespace
  {
    std::vector<DrawnTest> drawn_tests(const Diagnosis &diagnosis)
    {
      const bool             is_after = has_after(diagnosis);
      std::vector<DrawnTest> tests;
      for (const DiagnosedTest &test : diagnosis.tests)
        for (const bool is_second : {false, true})
          {
            const bool has_second = !test.measured_y.empty();
            if (is_second && !has_second)
              break;
            const auto       &before = is_second ? test.before_y : test.before;
            const auto       &after  = is_second ? test.after_y : test.after;
            const std::string name =
              test.condition.empty() ? test.name : test.condition;
            tests.push_back({test.name,
                             name + (is_second ? ", second axis" : ""),
                             test.time,
                             test.displacement,
                             is_second ? test.measured_y : test.measured,
                             is_after ? before : std::vector<double>(),
                             is_after ? after : before,
                             // Of a test with two axes each has its share.
                             test.noise / (has_second ? std::sqrt(2.) : 1.),
                             test.rms_before,
                             {}});
            for (const Phase phase : test.phase)
              tests.back().is_flank.push_back(is_flank(phase) ||
                                              phase == Phase::hold);
          }
      return tests;
    }



    constexpr std::size_t most_signatures = 4;

    /// The same effect has the same line in all pictures.
    std::vector<LegendLine>
    signature_lines(const Diagnosis                   &diagnosis,
                    const std::vector<CovariatePanel> &panels)
    {
      static const std::array<const char *, most_signatures> colours = {
        {Colour::after, "#E69F00", "#009E73", "#CC79A7"}};
      std::vector<LegendLine> lines;
      for (const CovariatePanel &panel : panels)
        for (const auto &[name, values] : panel.signatures)
          {
            const bool is_known =
              any_of(lines, [&, n = name](const auto &line) {
                return line.text == n;
              });
            if (!is_known && lines.size() < most_signatures)
              lines.push_back(
                {name,
                 colours[lines.size()],
                 holds(diagnosis.effects, name) ? "line" : "dashed"});
          }
      return lines;
    }

    void draw_panel(SmallPicture                  &picture,
                    const CovariatePanel          &panel,
                    const std::vector<LegendLine> &lines)
    {
      Range x, y;
      Rows  points;
      for (std::size_t i = 0; i < panel.x.size(); ++i)
        {
          const double error =
            i < panel.error.size() ? 200. * panel.error[i] : 0.;
          points.push_back({panel.x[i], 100. * panel.residual[i], error});
          x.add(panel.x[i]);
          y.add(100. * panel.residual[i] + error);
          y.add(100. * panel.residual[i] - error);
        }
      y.add(0.);
      picture.plot_level(0., "lc rgb '#222222' lw 1");
      for (const auto &[name, values] : panel.signatures)
        for (const LegendLine &line : lines)
          if (line.text == name)
            {
              Rows curve;
              for (std::size_t i = 0;
                   i < std::min(values.size(), panel.x.size());
                   ++i)
                {
                  curve.push_back({panel.x[i], 100. * values[i]});
                  y.add(100. * values[i]);
                }
              picture.plot(picture.add_data(name,
                                            {panel.covariate, "change_percent"},
                                            curve) +
                           " with lines " + line.style());
            }
      picture.plot(picture.add_data(
                     "left over",
                     {panel.covariate, "residual_percent", "two_deviations"},
                     points) +
                   " with yerrorbars pt 7 ps 0.6 lw 1.2 lc rgb '#222222'");
      // Points shall not stand on the border.
      const bool is_logarithmic =
        panel.is_logarithmic && x.lower > 0. && x.upper > x.lower;
      x = with_margin(x, 0.04, is_logarithmic);
      picture.axes(axis_label(panel.covariate, panel.unit),
                   x,
                   "Left over  [% of friction]",
                   y,
                   is_logarithmic);
    }



    // @param gallery has a title and a caption
    std::string draw_panels(Page                              &page,
                            const std::string                 &name,
                            const std::vector<CovariatePanel> &panels,
                            const std::vector<LegendLine>     &lines,
                            Gallery                            gallery)
    {
      gallery.legend.insert(gallery.legend.end(), lines.begin(), lines.end());
      for (std::size_t i = 0; i < panels.size(); ++i)
        {
          const CovariatePanel &panel = panels[i];
          if (panel.x.empty() || panel.residual.size() != panel.x.size())
            continue;
          SmallPicture picture(page,
                               name + "_" + std::to_string(i + 1),
                               "Against " + panel.covariate);
          draw_panel(picture, panel, lines);
          picture.finish(gallery);
        }
      return gallery_section(gallery);
    }



    constexpr std::size_t most_lines = 30;

    /// Root mean square by phase, as a share of friction.
    using Line = std::map<Phase, double>;

    struct HeatMap
    {
      std::vector<const DiagnosedTest *> tests;
      std::set<Phase>                    phases; ///< those that occur
      std::vector<Line>                  before, after;
      double                             largest = 0.;
    };

    Line line_of(const DiagnosedTest       &test,
                 const std::vector<double> &simulated,
                 const std::vector<double> &simulated_y)
    {
      std::map<Phase, std::pair<double, double>> sums;
      const auto add = [&](const std::vector<double> &measured,
                           const std::vector<double> &values) {
        const std::size_t n =
          std::min({measured.size(), values.size(), test.phase.size()});
        for (std::size_t i = 0; i < n; ++i)
          {
            const double difference = measured[i] - values[i];
            if (!std::isfinite(difference))
              continue;
            auto &[sum, count] = sums[test.phase[i]];
            sum += difference * difference;
            count += 1.;
          }
      };
      add(test.measured, simulated);
      add(test.measured_y, simulated_y);
      Line line;
      for (const auto &[phase, sum] : sums)
        line[phase] = std::sqrt(sum.first / sum.second) /
                      (test.level > 0. ? test.level : 1.);
      return line;
    }

    HeatMap make_map(const Diagnosis &diagnosis)
    {
      HeatMap map;
      for (const DiagnosedTest &test : diagnosis.tests)
        if (!test.measured.empty() && !test.phase.empty())
          map.tests.push_back(&test);
      while (map.tests.size() > most_lines)
        map.tests.erase(std::min_element(map.tests.begin(),
                                         map.tests.end(),
                                         [](const auto *a, const auto *b) {
                                           return a->rms_before < b->rms_before;
                                         }));
      for (const DiagnosedTest *const test : map.tests)
        {
          map.before.push_back(line_of(*test, test->before, test->before_y));
          for (const auto &[phase, rms] : map.before.back())
            map.phases.insert(phase);
          if (has_after(diagnosis))
            map.after.push_back(line_of(*test, test->after, test->after_y));
        }
      for (const auto *const lines : {&map.before, &map.after})
        for (const Line &line : *lines)
          for (const auto &[phase, rms] : line)
            map.largest = std::max(map.largest, rms);
      return map;
    }

    /// From white at the noise to dark brown at the largest difference: told
    /// apart by lightness.
    std::string cell_style(const double share)
    {
      return background(
        {{{255., 255., 255.}}, {{240., 150., 70.}}, {{110., 30., 0.}}}, share);
    }

    std::string table(const HeatMap           &map,
                      const std::vector<Line> &lines,
                      const std::string       &caption,
                      const double             noise)
    {
      std::string html =
        "<div><div class='scroll'><table class='heat'><caption>" + caption +
        "</caption>\n<thead><tr><th></th>";
      for (const Phase phase : map.phases)
        html += "<th scope='col'><span>" + name_of(phase) + "</span></th>";
      html += "</tr></thead>\n<tbody>\n";
      for (std::size_t i = 0; i < lines.size(); ++i)
        {
          const std::string name = html_text(map.tests[i]->name);
          html +=
            "<tr><th scope='row' title=\"" + name + "\">" + name + "</th>";
          for (const Phase phase : map.phases)
            {
              const auto found = lines[i].find(phase);
              html +=
                found == lines[i].end() ?
                  std::string("<td></td>") :
                  "<td style='" +
                    cell_style((found->second - noise) /
                               std::max(map.largest - noise, noise + 1e-9)) +
                    "'>" + fixed_text(100. * found->second, 1) + "</td>";
            }
          html += "</tr>\n";
        }
      return html + "</tbody></table></div></div>\n";
    }

    /// Tests by phases, before and after.
    std::string heat_map_section(const Diagnosis &diagnosis)
    {
      const HeatMap map   = make_map(diagnosis);
      const double  noise = diagnosis.shrink.noise_floor;
      if (map.tests.empty())
        return "";
      std::string html = heading("Tests and phases") + "<div class='maps'>\n" +
                         table(map,
                               map.before,
                               has_after(diagnosis) ? "before" : "simulated",
                               noise);
      if (has_after(diagnosis))
        html += table(map, map.after, "after", noise);
      html += "</div>\n<p class='legend'>noise alone, " + percent_text(noise) +
              " <span class='gradient' style='background:linear-gradient(to "
              "right,#fff,rgb(240,150,70),rgb(110,30,0))'></span> " +
              percent_text(map.largest) + "</p>\n";
      std::string text =
        "Root mean square of measured minus simulated, in % of friction.";
      if (diagnosis.tests.size() > map.tests.size())
        text += " " +
                std::to_string(diagnosis.tests.size() - map.tests.size()) +
                " tests are left out: those with the smallest misfit before.";
      return html + note(text);
    }



    /// What the formulas of named effects lack along their covariates.
    std::string draw_completed_formulas(Page &page, const Diagnosis &diagnosis)
    {
      std::vector<CovariatePanel> panels;
      std::string                 effects;
      for (const CompletedFormula &one : diagnosis.completed)
        {
          panels.push_back(one.panel);
          effects += (effects.empty() ? "" : ", ") + one.effect;
        }
      Gallery gallery{
        "The formula of " + effects + " is not quite right",
        "Measured minus simulated friction with the formula of the effect "
        "alone, as means of bins with two standard deviations; line: a free "
        "factor along the variable of the formula, which stands beside the "
        "formula in the improved case. Its shape shows what the formula lacks.",
        {{"left over by the formula", "#222222", "dot"}}};
      return draw_panels(
        page, "formula", panels, signature_lines(diagnosis, panels), gallery);
    }
  } // namespace



  std::string draw_tests(Page &page, const Diagnosis &diagnosis)
  {
    const bool                        is_after = has_after(diagnosis);
    const std::vector<DrawnTest>      tests    = drawn_tests(diagnosis);
    std::string                       caption;
    const std::vector<ConditionFrame> frames = condition_frames(tests, caption);
    return draw_friction(
             page,
             "test",
             is_after ? "Measured, before and after" : "Measured and simulated",
             caption +
               "With a complete law, nearly all measured points lie within "
               "the noise band. Steep flanks are cut off where the difference "
               "lies elsewhere.",
             frames,
             is_after ? "after" : "simulated") +
           heat_map_section(diagnosis);
  }



  std::string draw_covariates(Page &page, const Diagnosis &diagnosis)
  {
    const std::vector<LegendLine> lines =
      signature_lines(diagnosis, diagnosis.panels);
    Gallery gallery{
      "What is left over, and what would explain it",
      "Measured minus simulated friction before anything was added, as means "
      "of bins with two standard deviations; lines: what each effect would "
      "change there. An effect explains a difference if its line goes through "
      "the points everywhere.",
      {{"left over before", "#222222", "dot"}}};
    if (lines.empty())
      {
        gallery.title   = "What is left over";
        gallery.caption = "Measured minus simulated friction, as means of bins "
                          "with two standard deviations.";
        gallery.legend[0].text = "left over";
      }
    const std::string html =
      draw_panels(page, "covariate", diagnosis.panels, lines, gallery);
    return html + draw_completed_formulas(page, diagnosis);
  }



  std::string draw_named_profiles(Page &page, const Diagnosis &diagnosis)
  {
    const double quantile =
      boost::math::quantile(boost::math::normal(),
                            0.5 * (1. + diagnosis.confidence));
    std::vector<DrawnProfile> profiles;
    for (const DiagnosedParameter &parameter : named_parameters(diagnosis))
      {
        DrawnProfile drawn{parameter, label_text(parameter), parameter.unit};
        remove_erase_if(drawn.profile, [](const auto &point) {
          return !std::isfinite(point.first) || !std::isfinite(point.second);
        });
        for (auto &point : drawn.profile)
          point.second /= quantile * quantile;
        std::sort(drawn.profile.begin(), drawn.profile.end());
        profiles.push_back(drawn);
      }
    return draw_profiles(page,
                         "How sharply the new parameters are determined",
                         profiles,
                         diagnosis.confidence);
  }
} // namespace SlipStep
