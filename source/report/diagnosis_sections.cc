// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/candidates.h>
#include <slipstep/report/diagnosis_sections.h>

#include <slipstep/report/diagnosis_report.h>
#include <slipstep/report/curves.h>

namespace SlipStep
{
  namespace
  {
    /// "left: 12.5%"
    std::string css(const std::string &property, const double share)
    {
      return property + ":" + fixed_text(100. * std::clamp(share, 0., 1.), 1) +
             "%";
    }

    /// Of the objective, without decimals that mean nothing.
    std::string gain_text(const double gain)
    {
      return fixed_text(gain, std::abs(gain) < 100. ? 1 : 0);
    }

    std::string cell(const std::string &html, const std::string &kind = "")
    {
      return "<td" + (kind.empty() ? "" : " class='" + kind + "'") + ">" +
             html + "</td>";
    }

    std::string candidate_line(const CandidateResult &candidate,
                               const unsigned int     n_draws)
    {
      const std::string style =
        candidate.standing == Standing::named ? "named" :
        candidate.standing == Standing::rival ? "rival" :
        was_left_out(candidate.standing) ||
            candidate.standing == Standing::in_the_model ?
                                                "grey" :
                                                "";
      std::string remark = html_text(candidate.why);
      if (!candidate.cheapest_test.empty())
        remark += (remark.empty() ? "" : "; ") +
                  std::string("would show in: ") +
                  html_text(candidate.cheapest_test);
      return "<tr class='" + style + "'>" +
             cell("<b>" + html_text(candidate.name) +
                  "</b><br><span class='origin'>" +
                  html_text(plain_words(candidate.name)) + "</span>") +
             cell("<span class='status'>" +
                  html_text(name_of(candidate.standing)) + "</span>") +
             cell(html_text(chance_text(candidate, n_draws)), "number") +
             cell(gain_text(candidate.gain), "number") +
             cell(gain_text(candidate.left_out_gain), "number") +
             cell(percent_text(candidate.minimum_detectable), "number") +
             cell(remark.empty() ?
                    html_text("shows as: " + candidate.signature) :
                    remark,
                  "remark") +
             "</tr>\n";
    }

    // What covariates of the history mean, for those that are told.
    std::string history_words(const Diagnosis &diagnosis)
    {
      const auto has = [&](const std::string &covariate) {
        return any_of(diagnosis.where, [&](const Localisation &where) {
          return where.covariate == covariate;
        });
      };
      return std::string(
               has("change of speed") || has("change of pressure") ?
                 " Change of pressure or speed: the logarithm of its value "
                 "over its value some slip before." :
                 "") +
             (has("unloading") ? " Unloading: how far the pressure has fallen "
                                 "below the largest so far, as a share." :
                                 "");
    }



    std::string places_table(const std::vector<Localisation> &places)
    {
      TableLines lines = {table_head(
        "along | measured friction is | explains alone | phases | tests")};
      for (const Localisation &where : places)
        lines.push_back({range_text(where),
                         sign_text(where),
                         fixed_text(100. * where.share, 0) + " %",
                         list_text(where.phases),
                         list_text(where.tests)});
      return html_table(lines, "places");
    }



    void draw_element_check(SmallPicture &picture, const ElementCheck &check)
    {
      Range y, x;
      for (const double position : check.displacement)
        x.add(position);
      const auto add = [&](const std::string         &what,
                           const std::vector<double> &curve,
                           const std::string         &style) {
        Rows rows;
        for (std::size_t i = 0;
             i < std::min(check.displacement.size(), curve.size());
             ++i)
          {
            rows.push_back({check.displacement[i], curve[i]});
            y.add(curve[i]);
          }
        if (!rows.empty())
          picture.plot(
            picture.add_data(what, {"displacement_mm", "friction"}, rows) +
            " with lines " + style);
      };
      add("measured", check.measured, measured_line.style(1.2));
      add("contact point before", check.point_before, "lc rgb '#f0b58c' lw 4");
      add("contact point after", check.point_after, "lc rgb '#8fc3e6' lw 4");
      add("block before", check.block_before, before_line.style());
      add("block after",
          check.block_after,
          LegendLine{"", Colour::after}.style());
      picture.axes("Displacement  [mm]", x, "Friction  [–]", with_zero(y));
    }

    std::string draw_element_checks(Page                            &page,
                                    const std::vector<ElementCheck> &checks)
    {
      Gallery gallery{"",
                      "",
                      {measured_line,
                       {"block before", Colour::before, "dashed"},
                       {"block after", Colour::after},
                       {"contact point before", "#f0b58c"},
                       {"contact point after", "#8fc3e6"}}};
      for (std::size_t i = 0; i < checks.size(); ++i)
        {
          const ElementCheck &check = checks[i];
          if (check.displacement.empty())
            continue;
          SmallPicture picture(page,
                               "block_" + std::to_string(i + 1),
                               check.test);
          draw_element_check(picture, check);
          picture.finish(gallery);
        }
      return gallery_section(gallery);
    }

    std::string block_words(const Diagnosis &diagnosis)
    {
      const bool is_far =
        any_of(diagnosis.element_checks, [&](const ElementCheck &check) {
          return check.difference > diagnosis.shrink.noise_floor;
        });
      return is_far ? " Here block and contact point differ by more than the "
                      "noise: the block bends, and friction at its foot tilts "
                      "it, so that its pressure is uneven; the parameters "
                      "were fitted without this effect." :
                      "";
    }



    std::string tests_in_numbers(const Diagnosis &diagnosis)
    {
      const bool                 is_after = has_after(diagnosis);
      ColumnTable<DiagnosedTest> table(diagnosis.tests);
      const bool                 is_left_out = table.has(
        [](const DiagnosedTest &test) { return test.left_out_before > 0.; });
      const auto add = [&](const std::string &head,
                           double DiagnosedTest::*share) {
        table.add(head, [&](const DiagnosedTest &test) {
          return percent_text(test.*share);
        });
      };
      table.add("test", [](const DiagnosedTest &test) {
        return test.name + (test.is_outlier ? " (outlier)" : "");
      });
      add(is_after ? "rms before" : "rms", &DiagnosedTest::rms_before);
      if (is_after)
        add("after", &DiagnosedTest::rms_after);
      if (is_left_out)
        add(is_after ? "left out, before" : "left out",
            &DiagnosedTest::left_out_before);
      if (is_left_out && is_after)
        add("left out, after", &DiagnosedTest::left_out_after);
      table.add("noise", [](const DiagnosedTest &test) {
        return percent_text(test.level > 0. ? test.noise / test.level : 0.);
      });
      table.add("condition", &DiagnosedTest::condition);
      return table_section(
        "Every test in numbers",
        table.lines,
        "Root mean square of measured minus simulated, in % of the friction of "
        "the test; left out: as predicted from the tests under all other "
        "conditions.",
        "numbers tests");
    }

    std::string places_section(const Diagnosis &diagnosis)
    {
      if (diagnosis.where.empty())
        return "";
      return heading("Where simulation and measurement disagree") +
             places_table(diagnosis.where) +
             note(
               std::string(
                 "Explains alone: how much of the difference beyond the noise "
                 "a smooth correction along this quantity would remove; the "
                 "shares overlap. The range, if there is one, is where the "
                 "difference shows most.") +
               history_words(diagnosis));
    }

    std::string remains_section(const Diagnosis &diagnosis)
    {
      if (!diagnosis.is_incomplete)
        return "";
      const std::string names = list_text(diagnosis.effects);
      return heading("What " + names + " " +
                     (diagnosis.effects.size() > 1 ? "do" : "does") +
                     " not explain") +
             (diagnosis.remains.empty() ?
                paragraph("More than noise is left, but it depends on no "
                          "quantity that is known for the tests.") :
                places_table(diagnosis.remains) +
                  note("As above, for the difference that is left with the "
                       "effects added: a formula is not quite right, or "
                       "something weaker is missing as well."));
    }

    std::string all_candidates(const Diagnosis &diagnosis)
    {
      if (diagnosis.candidates.empty())
        return "";
      std::string html =
        heading("All effects that were considered") +
        "<div class='scroll'><table class='candidates'>\n<thead><tr>"
        "<th>effect</th><th>status</th><th class='number'>chance p</th>"
        "<th class='number'>gain</th><th class='number'>left-out gain</th>"
        "<th class='number'>smallest detectable</th><th>remark</th></tr></thead>"
        "\n<tbody>\n";
      for (const CandidateResult &candidate : diagnosis.candidates)
        html += candidate_line(candidate, diagnosis.n_draws);
      return html + "</tbody></table></div>\n" +
             note(
               "p: chance that noise alone would make any of these effects "
               "look as needed as this one. Gain: by how much adding it alone "
               "lowers the objective (sum of squares of difference over "
               "noise); left out: the same on conditions that were not "
               "fitted; – where it was not worth a fit. Smallest detectable: "
               "the smallest change of friction that would have been seen.");
    }

    std::string steps_section(const Diagnosis &diagnosis)
    {
      if (diagnosis.steps.empty())
        return "";
      const double noise   = diagnosis.shrink.noise_floor;
      double       largest = noise, calibrated = noise;
      for (const GapStep &step : diagnosis.steps)
        if (std::isfinite(step.rms))
          {
            largest = std::max(largest, step.rms);
            if (&step != &diagnosis.steps.front())
              calibrated = std::max(calibrated, step.rms);
          }
      if (!(largest > 0.))
        return "";
      // A start that is far off would make dots of everything else.
      const bool is_cut = largest > 4. * calibrated;
      if (is_cut)
        largest = 1.5 * calibrated;
      std::string html =
        heading("From the starting model down to the noise") +
        "<p class='legend'><span><i class='dashed' style='color:#222'></i>noise "
        "alone, " +
        percent_text(noise) + " of friction</span></p>\n";
      std::vector<GapBar> bars;
      for (const GapStep &step : diagnosis.steps)
        bars.push_back({step.label, step.rms, Colour::before});
      if (bars.size() > 1)
        bars.back().colour = Colour::after;
      return html + gap_bars(bars, noise, 1.02 * largest) +
             note("Root mean square of measured minus simulated, in % of "
                  "friction. Grey: the part that the step removed." +
                  std::string(is_cut ? " A bar with » is longer than drawn." :
                                       ""));
    }

    std::string diagnosed_parameters(const Diagnosis &diagnosis)
    {
      TableLines lines = {table_head("parameter | unit | before | after | " +
                                     interval_name(diagnosis.confidence))};
      for (const DiagnosedParameter &parameter : diagnosis.parameters)
        lines.push_back({label_text(parameter),
                         parameter.unit.empty() ? "–" : parameter.unit,
                         std::isfinite(parameter.before) ?
                           value_text(parameter, parameter.before) :
                         parameter.effect.empty() ? "–" :
                                                    "new",
                         value_text(parameter, parameter.value) +
                           (parameter.is_at_bound ?
                              " (bound: " + bounds_text(parameter) + ")" :
                              ""),
                         interval_text(parameter)});
      if (!has_after(diagnosis))
        lines[0][3] = "fitted";
      return table_section(
        "Parameters",
        lines,
        "≥, ≤, open: the tests do not limit the value on the other side." +
          (diagnosis.is_incomplete ? " " + interval_reservation(diagnosis) :
                                     "") +
          (diagnosis.improved_case.empty() ?
             "" :
             " The case with these values: " + diagnosis.improved_case + "."),
        "numbers unbroken");
    }

    std::string elements_section(Page &page, const Diagnosis &diagnosis)
    {
      if (diagnosis.element_checks.empty())
        return "";
      std::string html  = heading("The block with finite elements");
      TableLines  lines = {table_head(
        "test | block before | block after | point before | point after | "
         "block − point, after")};
      for (const ElementCheck &check : diagnosis.element_checks)
        {
          if (!check.remark.empty())
            html += paragraph(check.test + ": " + check.remark);
          if (!check.displacement.empty())
            lines.push_back(element_line(check));
        }
      html += draw_element_checks(page, diagnosis.element_checks);
      return html + (lines.size() < 2 ?
                       "" :
                       html_table(lines) +
                         note("Root mean square of the difference from "
                              "the measurement, in % of friction; the "
                              "last column is the difference of block "
                              "and contact point. The search uses the "
                              "contact point; this is the check on the "
                              "block." +
                              block_words(diagnosis)));
    }
  } // namespace



  std::string gap_bars(const std::vector<GapBar> &bars,
                       const double               noise,
                       const double               largest)
  {
    const auto width = [&](const double end) {
      return css("width", std::min(1., end / largest));
    };
    std::string html;
    double      before = 0.;
    for (const auto &[label, value, colour] : bars)
      {
        html += "<div class='bar'><span class='label'>" + html_text(label) +
                "</span><span class='track'>";
        if (before > value)
          html += "<i class='was' style='" + width(before) + "'></i>";
        html += "<i" + std::string(value > largest ? " class='cut'" : "") +
                " style='" + width(value) + ";background:" + colour + "'></i>";
        if (noise > 0.)
          html += "<i class='floor' style='" + css("left", noise / largest) +
                  "'></i>";
        html += "</span><span class='number'>" + percent_text(value) +
                "</span></div>\n";
        before = value;
      }
    return html;
  }



  std::string tests_section(const Diagnosis &diagnosis)
  {
    return tests_in_numbers(diagnosis) + places_section(diagnosis);
  }



  std::string candidates_section(const Diagnosis &diagnosis)
  {
    return remains_section(diagnosis) + all_candidates(diagnosis) +
           steps_section(diagnosis);
  }



  std::string parameters_section(Page &page, const Diagnosis &diagnosis)
  {
    return diagnosed_parameters(diagnosis) + elements_section(page, diagnosis);
  }
} // namespace SlipStep
