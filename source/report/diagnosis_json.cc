// SPDX-License-Identifier: LGPL-2.1-or-later

// diagnosis.json: a stable format, see tests/diagnosis.

#include <slipstep/report/diagnosis_report.h>
#include <slipstep/report/diagnosis_text.h>

#include <slipstep/utilities/json_file.h>
#include <slipstep/utilities/version.h>

namespace SlipStep
{
  namespace
  {
    using json = nlohmann::ordered_json;

    json percent(const double share)
    {
      return 100. * share;
    }

    json percents(const double before, const double after)
    {
      return json::array({percent(before), percent(after)});
    }

    json to_json(const DiagnosedParameter &parameter)
    {
      // An open end is null.
      json interval = json::array({parameter.lower, parameter.upper});
      if (parameter.is_lower_open)
        interval[0] = nullptr;
      if (parameter.is_upper_open)
        interval[1] = nullptr;
      json profile = json::array();
      for (const auto &[value, increase] : parameter.profile)
        profile.push_back(json::array({value, increase}));
      return {{"name", parameter.name},
              {"path", parameter.path},
              {"value", parameter.value},
              {"interval95", interval},
              {"unit", parameter.unit},
              {"before", parameter.before},
              {"at_bound", parameter.is_at_bound},
              {"profile", profile}};
    }

    json to_json(const DiagnosedTest &test)
    {
      return {{"name", test.name},
              {"condition", test.condition},
              {"file", test.file},
              {"rows", test.measured.size()},
              {"outlier", test.is_outlier}};
    }

    json to_json(const Outlier &outlier)
    {
      return {{"test", outlier.test},
              {"words", outlier.words},
              {"of_rows", outlier.is_of_rows}};
    }

    json to_json(const NoiseComponent &component)
    {
      return {{"name", component.name},
              {"value", component.value},
              {"unit", component.unit},
              {"source", component.source},
              {"interval95", {component.lower, component.upper}}};
    }

    json to_json(const Localisation &where)
    {
      return {{"covariate", where.covariate},
              {"unit", where.unit},
              {"share", where.share},
              {"range", {where.from, where.to}},
              {"sign", where.sign},
              {"wavelength", where.wavelength},
              {"phases", where.phases},
              {"tests", where.tests}};
    }

    json to_json(const ElementCheck &check)
    {
      // Null unless the block came to the end.
      const auto if_there = [&](const json &value) {
        return check.block_after.empty() ? json() : value;
      };
      return {
        {"test", check.test},
        {"block_percent",
         if_there(percents(check.block_gap_before, check.block_gap_after))},
        {"point_percent",
         if_there(percents(check.point_gap_before, check.point_gap_after))},
        {"difference_percent", if_there(percent(check.difference))},
        {"remark", check.remark}};
    }

    json to_json(const CandidateResult &candidate);

    json to_json(const CompletedFormula &one);

    template <typename Element>
    json list(const std::vector<Element> &elements)
    {
      json result = json::array();
      for (const Element &element : elements)
        result.push_back(to_json(element));
      return result;
    }

    json to_json(const CandidateResult &candidate)
    {
      return {{"effect", candidate.name},
              {"status", name_of(candidate.standing)},
              {"score", candidate.score},
              {"p", candidate.p},
              {"gain", candidate.gain},
              {"left_out_gain", candidate.left_out_gain},
              {"minimum_detectable_percent",
               percent(candidate.minimum_detectable)},
              {"testable", candidate.is_testable},
              {"at_bound",
               any_of(candidate.parameters,
                      [](const DiagnosedParameter &parameter) {
                        return parameter.is_at_bound;
                      })},
              {"parameters", list(candidate.parameters)}};
    }

    json data_block(const Diagnosis &diagnosis)
    {
      return {{"tests", list(diagnosis.tests)},
              {"conditions", diagnosis.n_conditions},
              {"replicate_pairs", diagnosis.n_replicate_pairs},
              {"samples", diagnosis.n_samples},
              {"hash", diagnosis.data_hash},
              {"outliers", list(diagnosis.outliers)}};
    }

    json gap_block(const Diagnosis &diagnosis)
    {
      return {{"status", diagnosis.has_gap ? "gap" : "no_gap"},
              {"p", diagnosis.gap.p},
              {"p_smooth", diagnosis.gap.p_smooth},
              {"p_replicates", diagnosis.gap.p_replicates},
              {"p_together", diagnosis.gap.p_together},
              {"p_track", diagnosis.gap.p_track},
              {"excess", diagnosis.gap.excess},
              {"rms_percent", percent(diagnosis.shrink.fitted_before)},
              {"noise_floor_percent", percent(diagnosis.shrink.noise_floor)}};
    }

    json to_json(const CompletedFormula &one)
    {
      return {{"effect", one.effect},
              {"words", "the formula is not quite right"},
              {"covariate", one.covariate},
              {"factor", one.formula},
              {"gain", one.gain}};
    }

    json verdict_block(const Diagnosis &diagnosis)
    {
      json rivals = json::array(), rival_of = json::array();
      for (const RivalEffect &rival : diagnosis.rivals)
        {
          rivals.push_back(rival.name);
          rival_of.push_back(rival.instead_of);
        }
      return {{"status", name_of(diagnosis.verdict)},
              {"headline", headline(diagnosis)},
              {"effects", diagnosis.effects},
              {"ambiguous_with", rivals},
              {"rival_of", rival_of},
              {"withdrawn", diagnosis.withdrawn},
              {"look_alike",
               diagnosis.look_alike.has_value() ?
                 look_alike_words(*diagnosis.look_alike) :
                 ""},
              {"incomplete", diagnosis.is_incomplete},
              {"worth_little", is_worth_little(diagnosis)},
              {"remainder_where", list(diagnosis.remains)},
              {"formulas_not_quite_right", list(diagnosis.completed)},
              {"explained_share", diagnosis.explained_share},
              {"remainder_p", diagnosis.remainder_p},
              {"would_overturn", diagnosis.would_overturn}};
    }

    json not_testable_block(const Diagnosis &diagnosis)
    {
      json result = json::array();
      for (const CandidateResult &candidate : diagnosis.candidates)
        if (candidate.standing == Standing::not_testable)
          result.push_back({{"effect", candidate.name},
                            {"why", candidate.why},
                            {"cheapest_test", candidate.cheapest_test}});
      return result;
    }

    json new_model_block(const Diagnosis &diagnosis)
    {
      json correction;
      if (diagnosis.correction.has_value())
        correction = {{"covariate", diagnosis.correction->covariate},
                      {"formula", diagnosis.correction->formula},
                      {"share", diagnosis.correction->share}};
      return {{"prm", diagnosis.improved_case},
              {"added", diagnosis.effects},
              {"correction", correction}};
    }

    json shrink_block(const Diagnosis &diagnosis)
    {
      const Shrink &shrink = diagnosis.shrink;
      json          tests  = json::array();
      for (const DiagnosedTest &test : diagnosis.tests)
        tests.push_back(
          {{"name", test.name},
           {"fitted", percents(test.rms_before, test.rms_after)},
           {"left_out", percents(test.left_out_before, test.left_out_after)},
           {"noise", percent(test.level > 0. ? test.noise / test.level : 0.)}});
      json steps = json::array();
      for (const GapStep &step : diagnosis.steps)
        steps.push_back({{"label", step.label},
                         {"rms", percent(step.rms)},
                         {"objective", step.objective}});
      return {{"unit", "% of friction"},
              {"fitted", percents(shrink.fitted_before, shrink.fitted_after)},
              {"left_out",
               percents(shrink.left_out_before, shrink.left_out_after)},
              {"systematic",
               percents(shrink.systematic_before, shrink.systematic_after)},
              {"noise_floor", percent(shrink.noise_floor)},
              {"per_test", tests},
              {"steps", steps}};
    }

    json next_test_block(const NextTest &next)
    {
      if (next.words.empty())
        return nullptr;
      return {{"words", next.words},
              {"programme", next.programme},
              {"separates", next.separates},
              {"distance", next.distance}};
    }

    json budget_block(const Diagnosis &diagnosis)
    {
      return {{"candidates", diagnosis.n_candidates},
              {"refits", diagnosis.n_refits},
              {"draws", diagnosis.n_draws},
              {"cut_short", diagnosis.is_cut_short},
              {"level", diagnosis.level},
              {"confidence", diagnosis.confidence},
              {"wall_s", diagnosis.wall_time},
              {"cpu_s", diagnosis.cpu_time}};
    }
  } // namespace



  void write_diagnosis_json(const std::filesystem::path &file,
                            const Parameters            &parameters,
                            const Diagnosis             &diagnosis)
  {
    const json object = {{"schema", "slipstep/diagnosis/1"},
                         {"version", version()},
                         {"git_hash", git_hash()},
                         {"case", parameters.case_file().stem().string()},
                         {"seeds", json::array({diagnosis.seed})},
                         {"data", data_block(diagnosis)},
                         {"start_model",
                          {{"effects", diagnosis.start_effects},
                           {"parameters", list(diagnosis.start_parameters)}}},
                         {"noise", list(diagnosis.noise)},
                         {"gap", gap_block(diagnosis)},
                         {"where", list(diagnosis.where)},
                         {"verdict", verdict_block(diagnosis)},
                         {"candidates", list(diagnosis.candidates)},
                         {"not_testable", not_testable_block(diagnosis)},
                         {"new_model", new_model_block(diagnosis)},
                         {"shrink", shrink_block(diagnosis)},
                         {"next_test", next_test_block(diagnosis.next_test)},
                         {"fe_check", list(diagnosis.element_checks)},
                         {"budget", budget_block(diagnosis)},
                         {"warnings", diagnosis.warnings}};
    write_json(file, object);
  }
} // namespace SlipStep
