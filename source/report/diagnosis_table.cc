// SPDX-License-Identifier: LGPL-2.1-or-later

// What the terminal shows at the end of a diagnosis.

#include <slipstep/report/diagnosis_text.h>

#include <slipstep/report/text_table.h>
#include <slipstep/utilities/text.h>

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
      return "  verdict: " + name_of(diagnosis.verdict) +
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
                       "), which gains " + fixed_text(one.gain, 1) + ":") +
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
      TableLines lines = {table_head("parameter added | value | unit | " +
                                     interval_name(diagnosis.confidence))};
      bool       is_any_at_bound = false;
      for (const DiagnosedParameter &parameter : named_parameters(diagnosis))
        {
          lines.push_back({label_text(parameter),
                           (parameter.is_at_bound ? "* " : "") +
                             value_text(parameter, parameter.value),
                           parameter.unit,
                           interval_text(parameter)});
          is_any_at_bound = is_any_at_bound || parameter.is_at_bound;
        }
      return table_paragraph(lines) +
             (is_any_at_bound ? "  * at a bound\n" : "");
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
  } // namespace



  std::string diagnosis_table(const Diagnosis &diagnosis)
  {
    return wrapped_text(headline(diagnosis)) + "\n" + summary(diagnosis) +
           places("where", diagnosis.where) +
           places("where the rest is", diagnosis.remains) +
           completed(diagnosis) + candidates(diagnosis) +
           parameters(diagnosis) + blocks(diagnosis) + next_test(diagnosis);
  }
} // namespace SlipStep
