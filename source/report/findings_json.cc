// SPDX-License-Identifier: LGPL-2.1-or-later

// calibration.json and diagnosis.json: stable formats, see tests/report.

#include <slipstep/report/calibration_report.h>
#include <slipstep/report/diagnosis_report.h>

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

    /// Logarithmic scales count in natural logarithms, which have no unit.
    double change_in_unit(const FitParameter &parameter, const double change)
    {
      return parameter.is_logarithmic ? change : parameter.in_unit(change);
    }
  } // namespace



  // The library finds these by their argument, in lists as well.

  static void to_json(json &object, const FittedParameter &fitted)
  {
    const FitParameter &parameter = fitted.parameter;
    const auto          shown     = fitted.converted(
      [&](const double value) { return parameter.in_unit(value); });
    object = {{"path", parameter.path},
              {"unit", parameter.unit()},
              {"value", shown.value},
              {"start", parameter.in_unit(parameter.start)},
              {"lower_bound", parameter.in_unit(parameter.lower)},
              {"upper_bound", parameter.in_unit(parameter.upper)},
              {"scale", parameter.is_logarithmic ? "logarithmic" : "linear"},
              {"deviation", change_in_unit(parameter, fitted.deviation)},
              {"interval",
               {{"lower", shown.lower},
                {"upper", shown.upper},
                {"lower_open", fitted.is_lower_open},
                {"upper_open", fitted.is_upper_open}}},
              {"at_bound", fitted.is_at_bound},
              {"constraint", fitted.constraint},
              {"profile", shown.profile}};
  }



  static void to_json(json &object, const DerivedQuantity &quantity)
  {
    object = {{"name", quantity.name},
              {"formula", quantity.formula},
              {"value", quantity.value},
              {"deviation", quantity.deviation}};
  }



  static void to_json(json &object, const TestMisfit &test)
  {
    object = {{"name", test.name},
              {"condition", test.condition},
              {"file", test.file},
              {"rows", test.n_rows},
              {"noise", test.noise},
              {"noise_stated", test.noise_is_stated},
              {"rms", test.rms},
              {"start_rms", test.start_rms},
              {"mean", test.mean},
              {"correlation_length", test.correlation_length},
              {"measured_work", test.measured_work},
              {"simulated_work", test.simulated_work}};
  }



  static void to_json(json &object, const DiagnosedParameter &parameter)
  {
    // An open end is null.
    const auto end = [](const double value, const bool is_open) {
      return is_open ? json() : json(value);
    };
    object = {{"name", parameter.name},
              {"path", parameter.path},
              {"value", parameter.value},
              {"interval95",
               {end(parameter.lower, parameter.is_lower_open),
                end(parameter.upper, parameter.is_upper_open)}},
              {"unit", parameter.unit},
              {"before", parameter.before},
              {"at_bound", parameter.is_at_bound},
              {"profile", parameter.profile}};
  }



  static void to_json(json &object, const DiagnosedTest &test)
  {
    object = {{"name", test.name},
              {"condition", test.condition},
              {"file", test.file},
              {"rows", test.measured.size()},
              {"outlier", test.is_outlier}};
  }



  static void to_json(json &object, const Outlier &outlier)
  {
    object = {{"test", outlier.test},
              {"words", outlier.words},
              {"of_rows", outlier.is_of_rows}};
  }



  static void to_json(json &object, const NoiseComponent &component)
  {
    object = {{"name", component.name},
              {"value", component.value},
              {"unit", component.unit},
              {"source", component.source},
              {"interval95", {component.lower, component.upper}}};
  }



  static void to_json(json &object, const Localisation &where)
  {
    object = {{"covariate", where.covariate},
              {"unit", where.unit},
              {"share", where.share},
              {"range", {where.from, where.to}},
              {"sign", where.sign},
              {"wavelength", where.wavelength},
              {"phases", where.phases},
              {"tests", where.tests}};
  }



  static void to_json(json &object, const ElementCheck &check)
  {
    // Null unless the block came to the end.
    const auto if_there = [&](const json &value) {
      return check.block_after.empty() ? json() : value;
    };
    object = {
      {"test", check.test},
      {"block_percent",
       if_there(percents(check.block_gap_before, check.block_gap_after))},
      {"point_percent",
       if_there(percents(check.point_gap_before, check.point_gap_after))},
      {"difference_percent", if_there(percent(check.difference))},
      {"remark", check.remark}};
  }



  static void to_json(json &object, const CandidateResult &candidate)
  {
    object = {{"effect", candidate.name},
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
                      std::mem_fn(&DiagnosedParameter::is_at_bound))},
              {"parameters", candidate.parameters}};
  }



  static void to_json(json &object, const CompletedFormula &one)
  {
    object = {{"effect", one.effect},
              {"words", "the formula is not quite right"},
              {"covariate", one.covariate},
              {"factor", one.formula},
              {"gain", one.gain}};
  }



  static void to_json(json &object, const GapStep &step)
  {
    object = {{"label", step.label},
              {"rms", percent(step.rms)},
              {"objective", step.objective}};
  }



  namespace
  {
    json weak_directions(const Calibration &calibration)
    {
      json result = json::array();
      for (const WeakDirection &direction : calibration.weak)
        {
          json paths = json::array(), change = json::array();
          for (const std::size_t i : direction.members)
            {
              const FitParameter &parameter =
                calibration.parameters[i].parameter;
              paths.push_back(parameter.path);
              change.push_back(change_in_unit(parameter, direction.change[i]));
            }
          result.push_back({{"parameters", paths},
                            {"change", change},
                            {"words", direction.words}});
        }
      return result;
    }

    json starts(const Calibration &calibration)
    {
      const auto in_units = [&](const std::vector<double> &values) {
        json result = json::array();
        for (std::size_t i = 0; i < values.size(); ++i)
          result.push_back(
            calibration.parameters[i].parameter.in_unit(values[i]));
        return result;
      };
      json result = json::array();
      for (const StartResult &start : calibration.starts)
        result.push_back({{"start", in_units(start.start)},
                          {"end", in_units(start.end)},
                          {"misfit", start.misfit},
                          {"iterations", start.iterations},
                          {"message", start.message}});
      return result;
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

    json verdict_block(const Diagnosis &diagnosis)
    {
      json rivals = json::array(), rival_of = json::array();
      for (const RivalEffect &rival : diagnosis.rivals)
        {
          rivals.push_back(rival.name);
          rival_of.push_back(rival.instead_of);
        }
      return {{"status", name_of(diagnosis.verdict)},
              {"decided", !diagnosis.is_cut_short},
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
              {"remainder_where", diagnosis.remains},
              {"formulas_not_quite_right", diagnosis.completed},
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
              {"parameters", diagnosis.parameters},
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
      return {{"unit", "% of friction"},
              {"fitted", percents(shrink.fitted_before, shrink.fitted_after)},
              {"left_out",
               percents(shrink.left_out_before, shrink.left_out_after)},
              {"systematic",
               percents(shrink.systematic_before, shrink.systematic_after)},
              {"noise_floor", percent(shrink.noise_floor)},
              {"per_test", tests},
              {"steps", diagnosis.steps}};
    }
  } // namespace



  void write_calibration_json(const std::filesystem::path &file,
                              const Parameters            &parameters,
                              const Calibration           &calibration)
  {
    write_json(file,
               {{"version", version()},
                {"git_hash", git_hash()},
                {"case", parameters.case_file().stem().string()},
                {"confidence", calibration.confidence},
                {"parameters", calibration.parameters},
                {"derived", calibration.derived},
                {"tests", calibration.tests},
                {"correlation", calibration.correlation},
                {"weak_directions", weak_directions(calibration)},
                {"starts", starts(calibration)},
                {"misfit", calibration.misfit},
                {"start_misfit", calibration.start_misfit},
                {"rows", calibration.n_rows},
                {"effective_rows", calibration.n_effective},
                {"inflation", calibration.inflation},
                {"simulations", calibration.n_simulations},
                {"steps", calibration.n_steps},
                {"wall_s", calibration.wall_time},
                {"cpu_s", calibration.cpu_time},
                {"warnings", calibration.warnings}});
  }



  void write_diagnosis_json(const std::filesystem::path &file,
                            const Parameters            &parameters,
                            const Diagnosis             &diagnosis)
  {
    const NextTest &next = diagnosis.next_test;
    json            next_test;
    if (!next.words.empty())
      next_test = {{"words", next.words},
                   {"programme", next.programme},
                   {"separates", next.separates},
                   {"distance", next.distance}};
    write_json(file,
               {{"schema", "slipstep/diagnosis/1"},
                {"version", version()},
                {"git_hash", git_hash()},
                {"case", parameters.case_file().stem().string()},
                {"seeds", json::array({diagnosis.seed})},
                {"data",
                 {{"tests", diagnosis.tests},
                  {"conditions", diagnosis.n_conditions},
                  {"replicate_pairs", diagnosis.n_replicate_pairs},
                  {"samples", diagnosis.n_samples},
                  {"hash", diagnosis.data_hash},
                  {"outliers", diagnosis.outliers}}},
                {"start_model",
                 {{"effects", diagnosis.start_effects},
                  {"parameters", diagnosis.start_parameters}}},
                {"noise", diagnosis.noise},
                {"gap", gap_block(diagnosis)},
                {"where", diagnosis.where},
                {"verdict", verdict_block(diagnosis)},
                {"candidates", diagnosis.candidates},
                {"not_testable", not_testable_block(diagnosis)},
                {"new_model", new_model_block(diagnosis)},
                {"shrink", shrink_block(diagnosis)},
                {"next_test", next_test},
                {"fe_check", diagnosis.element_checks},
                {"budget",
                 {{"candidates", diagnosis.n_candidates},
                  {"refits", diagnosis.n_refits},
                  {"draws", diagnosis.n_draws},
                  {"cut_short", diagnosis.is_cut_short},
                  {"level", diagnosis.level},
                  {"confidence", diagnosis.confidence},
                  {"wall_s", diagnosis.wall_time},
                  {"cpu_s", diagnosis.cpu_time}}},
                {"warnings", diagnosis.warnings}});
  }
} // namespace SlipStep
