// SPDX-License-Identifier: LGPL-2.1-or-later

// The map of tests and phases: where the difference is, before and after.

#include <slipstep/report/diagnosis_sections.h>
#include <slipstep/report/diagnosis_text.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace SlipStep
{
  namespace
  {
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
      return background({{{255., 255., 255.}},
                         {{240., 150., 70.}},
                         {{110., 30., 0.}}},
                        share) +
             (share > 0.7 ? ";color:#fff" : "");
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
  } // namespace



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
      text += " " + std::to_string(diagnosis.tests.size() - map.tests.size()) +
              " tests are left out: those met best before.";
    return html + note(text);
  }
} // namespace SlipStep
