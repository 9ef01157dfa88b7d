// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/candidates.h>
#include <slipstep/report/diagnosis_report.h>

#include <slipstep/report/diagnosis_sections.h>

#include <slipstep_diagnosis_style.h>

#include <boost/algorithm/string/replace.hpp>

#include <nlohmann/json.hpp>

namespace SlipStep
{
  namespace
  {
    constexpr std::size_t n_places = 3;

    std::string summary(const Diagnosis &diagnosis)
    {
      const Shrink &shrink = diagnosis.shrink;
      TableLines    lines  = {
            {"gap", "before", has_after(diagnosis) ? "after" : "", "noise"}};
      const auto add = [&](const std::string &name,
                           const double       before,
                           const double       after,
                           const std::string &noise) {
        lines.push_back({name,
                         percent_text(before),
                         has_after(diagnosis) ? percent_text(after) : "",
                         noise});
      };
      add("all tests",
          shrink.fitted_before,
          shrink.fitted_after,
          percent_text(shrink.noise_floor));
      if (shrink.left_out_before > 0.)
        add("conditions left out of the fit",
            shrink.left_out_before,
            shrink.left_out_after,
            percent_text(shrink.noise_floor));
      add("beyond the noise",
          shrink.systematic_before,
          shrink.systematic_after,
          "");
      const std::string under = reservation(diagnosis);
      return "  verdict: " +
             (diagnosis.is_cut_short ? "not decided, so far " : std::string()) +
             name_of(diagnosis.verdict) +
             (diagnosis.is_incomplete ? ", incomplete" : "") +
             (diagnosis.effects.empty() ? "" : " – " + names_text(diagnosis)) +
             (under.empty() ? "" : ", " + under) +
             "\n  chance of this gap by noise alone: " +
             chance_text(diagnosis.gap.p, diagnosis.n_draws) + "\n" +
             table_paragraph(lines);
    }

    std::string places(const std::string               &title,
                       const std::vector<Localisation> &all)
    {
      TableLines lines = {{title, "measured is", "explains", "most in"}};
      for (const Localisation &where : all)
        if (lines.size() <= n_places)
          lines.push_back({range_text(where),
                           sign_text(where),
                           fixed_text(100. * where.share, 0) + " %",
                           where.phases.empty() ? "" : where.phases[0]});
      return table_paragraph(lines);
    }

    std::string completed(const Diagnosis &diagnosis)
    {
      std::string text;
      for (const CompletedFormula &one : diagnosis.completed)
        text +=
          "\n" +
          wrapped_text("the formula of " + one.effect +
                       " lacks a factor (x is " + one.covariate +
                       "), with a gain of " + fixed_text(one.gain, 1) + ":") +
          wrapped_text(one.formula, 4);
      return text;
    }

    std::string candidates(const Diagnosis &diagnosis)
    {
      ColumnTable<CandidateResult> table(diagnosis.candidates);
      table.add("candidate", &CandidateResult::name);
      table.add("p", [&](const CandidateResult &candidate) {
        return chance_text(candidate, diagnosis.n_draws);
      });
      table.add("gain", 1, &CandidateResult::gain);
      table.add("left-out gain", 1, &CandidateResult::left_out_gain);
      table.add("smallest seen", [](const CandidateResult &candidate) {
        return percent_text(candidate.minimum_detectable);
      });
      table.add("status", [](const CandidateResult &candidate) {
        return name_of(candidate.standing);
      });
      std::string text = table_paragraph(table.lines);
      // Those of one reason together, in the order of the first of them.
      nlohmann::ordered_map<std::string, std::vector<std::string>> reasons;
      for (const CandidateResult &candidate : diagnosis.candidates)
        if (was_left_out(candidate.standing))
          reasons[candidate.why].push_back(candidate.name);
      for (const auto &[why, names] : reasons)
        text += wrapped_text(list_text(names) + ": " + why);
      return text;
    }

    std::string parameters(const Diagnosis &diagnosis)
    {
      TableLines  lines = {table_head("parameter added | value | unit | " +
                                     interval_name(diagnosis.confidence))};
      std::string at_bounds;
      for (const DiagnosedParameter &parameter : named_parameters(diagnosis))
        {
          lines.push_back({label_text(parameter),
                           (parameter.is_at_bound ? "* " : "") +
                             value_text(parameter, parameter.value),
                           parameter.unit,
                           interval_text(parameter)});
          if (parameter.is_at_bound)
            at_bounds += (at_bounds.empty() ? "" : ", ") +
                         label_text(parameter) + ' ' + bounds_text(parameter);
        }
      return table_paragraph(lines) +
             (at_bounds.empty() ?
                "" :
                wrapped_text("* at a bound of the diagnosis: " + at_bounds)) +
             wrapped_text(interval_reservation(diagnosis));
    }

    std::string blocks(const Diagnosis &diagnosis)
    {
      if (diagnosis.element_checks.empty())
        return "";
      std::string remarks;
      TableLines  lines = {table_head(
        "with finite elements | block before | after | point before | after | "
         "block - point")};
      for (const ElementCheck &check : diagnosis.element_checks)
        if (check.block_after.empty())
          remarks += wrapped_text(check.test + ": " + check.remark);
        else
          lines.push_back(element_line(check));
      return (lines.size() > 1 ? table_paragraph(lines) : "\n") + remarks;
    }

    std::string next_test(const Diagnosis &diagnosis)
    {
      const NextTest &next = diagnosis.next_test;
      if (next.words.empty())
        return "";
      return "\n" +
             wrapped_text(
               "next test: " + next.words +
               (next.separates.empty() ?
                  "" :
                  (next.tells() ? " (tells about " : " (tells little about ") +
                    list_text(next.separates) + ")")) +
             (next.programme.empty() ? "" : "    " + next.programme + "\n");
    }



    std::string card(const std::string &title, const std::string &content)
    {
      return "<div class='card'><h2>" + html_text(title) + "</h2>\n" + content +
             "</div>\n";
    }



    std::vector<std::string> all_in_quotes(std::vector<std::string> names)
    {
      for (std::string &name : names)
        name = in_quotes(name);
      return names;
    }

    /// No line ends between a number and its sign of percent.
    std::string kept_together(const std::string &text)
    {
      return boost::algorithm::replace_all_copy(text, " %", "\u00a0%");
    }

    std::string where_card(const Diagnosis &diagnosis)
    {
      const std::string title = "Where simulation and measurement disagree";
      if (!diagnosis.has_gap || diagnosis.where.empty())
        return card(title,
                    paragraph(diagnosis.has_gap ? "Everywhere alike" :
                                                  "Nowhere beyond the noise",
                              "big"));
      const Localisation &where = diagnosis.where[0];
      std::string         text =
        "Measured friction is " + sign_text(where) + " there than simulated";
      if (!where.phases.empty())
        text += std::string(", most in phase") +
                (where.phases.size() > 1 ? "s " : " ") +
                list_text(where.phases);
      if (!where.tests.empty())
        text += ", in " + list_text(all_in_quotes(where.tests));
      return card(title,
                  paragraph(capitalised(place_words(where)), "big") +
                    paragraph(text + ".") +
                    note("Explains " + fixed_text(100. * where.share, 0) +
                         " % of the difference beyond the noise."));
    }

    std::string effect_words(const std::string &effect)
    {
      return plain_words(effect) + " (" + effect + ")";
    }

    std::string named_effects(const Diagnosis &diagnosis)
    {
      std::string html;
      for (const std::string &effect : diagnosis.effects)
        html += paragraph(effect_words(effect), "big");
      if (!diagnosis.rivals.empty())
        html += paragraph("or, as these tests do not tell them apart:");
      for (const RivalEffect &rival : diagnosis.rivals)
        html +=
          paragraph(effect_words(rival.name) +
                    (!rival.instead_of.empty() && diagnosis.effects.size() > 1 ?
                       ", in place of " + rival.instead_of :
                       ""));
      return html + note("Explains " +
                         fixed_text(100. * diagnosis.explained_share, 0) +
                         " % of the difference beyond the noise.");
    }

    /// What would have been seen.
    std::string power_words(const Diagnosis &diagnosis)
    {
      std::vector<const CandidateResult *> seen;
      std::size_t                          n_blind = 0;
      for (const CandidateResult &candidate : diagnosis.candidates)
        if (candidate.is_testable &&
            std::isfinite(candidate.minimum_detectable))
          seen.push_back(&candidate);
        else if (candidate.standing == Standing::not_testable)
          ++n_blind;
      const std::string blind = std::to_string(n_blind) + " of " +
                                std::to_string(seen.size() + n_blind) +
                                " effects cannot be tested here.";
      if (seen.empty())
        return blind;
      const auto ends = std::minmax_element(seen.begin(),
                                            seen.end(),
                                            [](const auto *a, const auto *b) {
                                              return a->minimum_detectable <
                                                     b->minimum_detectable;
                                            });
      return "An effect would have been seen if it changed friction by " +
             percent_text((*ends.first)->minimum_detectable) + " (" +
             (*ends.first)->name + ") to " +
             percent_text((*ends.second)->minimum_detectable) + " (" +
             (*ends.second)->name + ") or more." +
             (n_blind > 0 ? " " + blind : "");
    }

    std::string what_was_missing(const Diagnosis &diagnosis)
    {
      if (diagnosis.is_cut_short && diagnosis.effects.empty())
        return paragraph("Not decided, since the search was cut short", "big");
      switch (diagnosis.verdict)
        {
          case Verdict::named:
          case Verdict::ambiguous:
            return named_effects(diagnosis);
          case Verdict::unnamed:
            return paragraph("Something that " + nothing_explains(diagnosis),
                             "big") +
                   (diagnosis.withdrawn.empty() ?
                      "" :
                      paragraph("Withdrawn, since too much remained "
                                "unexplained: " +
                                list_text(diagnosis.withdrawn) + "."));
          case Verdict::no_gap:
            return paragraph("Nothing, as far as these tests can tell", "big") +
                   paragraph(power_words(diagnosis));
          case Verdict::not_testable:
            return paragraph("These tests cannot tell", "big") +
                   paragraph(power_words(diagnosis));
        }
      return "";
    }

    std::string shrink_card(const Diagnosis &diagnosis)
    {
      const Shrink &shrink      = diagnosis.shrink;
      const bool    is_after    = has_after(diagnosis);
      const bool    is_left_out = shrink.left_out_before > 0.;
      const double  largest     = 1.05 * std::max({shrink.fitted_before,
                                                   shrink.fitted_after,
                                                   shrink.left_out_before,
                                                   shrink.left_out_after,
                                                   shrink.noise_floor,
                                                   1e-12});
      const auto    bars        = [&](const double before, const double after) {
        std::vector<GapBar> both = {{"before", before, Colour::before},
                                    {"after", after, Colour::after}};
        if (!is_after)
          both = {{"now", before, Colour::after}};
        return gap_bars(both, shrink.noise_floor, largest);
      };
      std::string html =
        paragraph(percent_text(shrink.fitted_before) +
                    (is_after ? " → " + percent_text(shrink.fitted_after) :
                                "") +
                    " of friction",
                  "big") +
        bars(shrink.fitted_before, shrink.fitted_after);
      if (is_left_out)
        html += note("Under conditions left out of the fit:") +
                bars(shrink.left_out_before, shrink.left_out_after);
      html += note(
        "Dashed: " +
        std::string(shrink.is_noise_overrated() ? "the assumed noise, " :
                                                  "noise alone, ") +
        percent_text(shrink.noise_floor) +
        (is_after ?
           ". Beyond the noise: " + percent_text(shrink.systematic_before) +
             " → " + percent_text(shrink.systematic_after) :
           "") +
        ".");
      return card(!is_after      ? "How large the gap is" :
                  shrink.grows() ? "How the plain gap changed" :
                                   "How far the gap shrank",
                  html);
    }

    std::string badge(const Diagnosis &diagnosis)
    {
      // Told by the words and the mark, not by the colour alone.
      const std::string mark = diagnosis.verdict == Verdict::named     ? "●" :
                               diagnosis.verdict == Verdict::ambiguous ? "◐" :
                               diagnosis.verdict == Verdict::unnamed   ? "?" :
                               diagnosis.verdict == Verdict::no_gap    ? "=" :
                                                                         "○";
      std::string       text = short_verdict(diagnosis);
      if (!diagnosis.effects.empty())
        text += ": " + names_text(diagnosis);
      if (!reservation(diagnosis).empty())
        text += ", " + reservation(diagnosis);
      return "<p class='badge " + name_of(diagnosis.verdict) + "'>" + mark +
             " " + html_text(text) + "</p>\n";
    }

    std::string next_test_section(const NextTest &next)
    {
      if (next.words.empty())
        return "";
      std::string html =
        heading("The next test") + paragraph(next.words, "big");
      if (!next.programme.empty())
        html += "<p>As written in a case: <code>" + html_text(next.programme) +
                "</code></p>\n";
      std::string text;
      if (!next.separates.empty())
        text =
          (next.separates.size() > 1 ? "It separates " : "It would show ") +
          list_text(next.separates);
      if (!text.empty() && next.distance > 0.)
        text += ": the predictions differ by " + short_text(next.distance, 2) +
                " standard deviations" +
                (next.tells() ? "" :
                                "; it is the best of the usual tests, but "
                                "tells little");
      return html + (text.empty() ? "" : paragraph(text + "."));
    }

    std::string correction_section(const Diagnosis &diagnosis)
    {
      if (diagnosis.verdict != Verdict::unnamed ||
          !diagnosis.correction.has_value())
        return "";
      return heading("A correction, cause unknown") +
             paragraph("A smooth factor on friction that depends on " +
                       diagnosis.correction->covariate + " removes " +
                       fixed_text(100. * diagnosis.correction->share, 0) +
                       " % of the difference beyond the noise. It describes "
                       "the difference and does not explain it; outside the "
                       "tested range it keeps the value at the edge of the "
                       "range.") +
             "<p><code>" + html_text(diagnosis.correction->formula) +
             "</code></p>\n";
    }

    std::string noise_table(const Diagnosis &diagnosis)
    {
      if (diagnosis.noise.empty())
        return "";
      TableLines lines = {table_head("noise | value (95 % interval) | from")};
      for (const NoiseComponent &noise : diagnosis.noise)
        lines.push_back({noise.name,
                         short_text(noise.value, 2) +
                           (noise.upper > noise.lower ?
                              " (" + short_text(noise.lower, 2) + " … " +
                                short_text(noise.upper, 2) + ")" :
                              "") +
                           (noise.unit.empty() ? "" : " " + noise.unit),
                         noise.source});
      return html_table(lines, "places");
    }

    std::string bullets(const std::string              &title,
                        const std::vector<std::string> &texts)
    {
      if (texts.empty())
        return "";
      std::string html = "<p><b>" + html_text(title) + "</b></p>\n<ul>\n";
      for (const std::string &text : texts)
        html += "<li>" + html_text(text) + "</li>\n";
      return html + "</ul>\n";
    }

    std::string honesty_section(const Diagnosis &diagnosis)
    {
      std::vector<std::string> tests, rows, copies;
      for (const Outlier &outlier : diagnosis.outliers)
        (outlier.is_copy    ? copies :
         outlier.is_of_rows ? rows :
                              tests)
          .push_back(outlier.test + ": " + outlier.words);
      const auto chance = [&](const double p) {
        return chance_text(p, diagnosis.n_draws);
      };
      const std::size_t n_in_model =
        diagnosis.candidates.size() - diagnosis.n_candidates;
      const TableLines lines = {
        {"what the verdict rests on", ""},
        {"tests", std::to_string(diagnosis.tests.size())},
        {"conditions", std::to_string(diagnosis.n_conditions)},
        {"pairs of replicates", std::to_string(diagnosis.n_replicate_pairs)},
        {"numbers compared, averages of rows",
         std::to_string(diagnosis.n_samples)},
        {"effects considered",
         std::to_string(diagnosis.n_candidates) +
           (n_in_model > 0 ?
              " (" + std::to_string(n_in_model) + " more are in the model)" :
              "")},
        {"fits of the whole campaign", std::to_string(diagnosis.n_refits)},
        {"samples of noise drawn", std::to_string(diagnosis.n_draws)},
        {"chance of a false alarm accepted", percent_text(diagnosis.level)},
        {"chance of this gap by noise alone", chance(diagnosis.gap.p)},
        {"… as a smooth difference", chance(diagnosis.gap.p_smooth)},
        {"… as a difference that replicates share",
         chance(diagnosis.gap.p_replicates)},
        {"… as smooth difference and waves at once",
         chance(diagnosis.gap.p_together)},
        {"… as waves along the track", chance(diagnosis.gap.p_track)},
        {"chance of what remains", chance(diagnosis.remainder_p)},
        {"seed", std::to_string(diagnosis.seed)},
        {"hash of the data",
         diagnosis.data_hash.empty() ? "–" : diagnosis.data_hash},
        {"wall time, CPU time, without the block",
         fixed_text(diagnosis.wall_time, 1) + " s, " +
           fixed_text(diagnosis.cpu_time, 1) + " s"}};
      std::string html =
        "<div class='honest'>\n" + heading("How far this can be trusted");
      if (diagnosis.n_replicate_pairs == 0)
        html += paragraph("No two tests share a condition: the size of the "
                          "noise is stated, not measured. Repeat a test or "
                          "two before you believe the verdict.",
                          "problem");
      html +=
        bullets("What would overturn this verdict", diagnosis.would_overturn) +
        bullets(counted(tests.size(), "test") + " out of line with the others",
                tests) +
        bullets("Copies", copies) +
        bullets("Numbers that nothing explains", rows) +
        bullets("Warnings", diagnosis.warnings) + html_table(lines, "numbers");
      return html + noise_table(diagnosis) + "</div>\n";
    }
  } // namespace



  std::string diagnosis_table(const Diagnosis &diagnosis)
  {
    return wrapped_text(headline(diagnosis)) + "\n" + summary(diagnosis) +
           places("where", diagnosis.where) +
           places("where the rest is", diagnosis.remains) +
           completed(diagnosis) + candidates(diagnosis) +
           parameters(diagnosis) + blocks(diagnosis) + next_test(diagnosis);
  }



  std::vector<std::string>
  write_diagnosis_report(const std::filesystem::path &folder,
                         const Parameters            &parameters,
                         const Diagnosis             &diagnosis)
  {
    Page               page(folder);
    std::ostringstream sections;
    sections << draw_tests(page, diagnosis) << tests_section(diagnosis)
             << draw_covariates(page, diagnosis)
             << candidates_section(diagnosis)
             << draw_named_profiles(page, diagnosis)
             << parameters_section(page, diagnosis)
             << next_test_section(diagnosis.next_test)
             << correction_section(diagnosis) << honesty_section(diagnosis);
    page.write(title_of(parameters) + ": diagnosis",
               kept_together(headline(diagnosis)),
               kept_together(
                 "<style>\n" + std::string(diagnosis_style) + "</style>\n" +
                 badge(diagnosis) + "<div class='cards'>\n" +
                 where_card(diagnosis) +
                 card("What was missing", what_was_missing(diagnosis)) +
                 shrink_card(diagnosis) + "</div>\n" +
                 problem_boxes(page.warnings) + sections.str()) +
                 heading("Repeat it") + case_call("diagnose", parameters));
    return page.warnings;
  }
} // namespace SlipStep
