// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/confounding.h>
#include <slipstep/diagnosis/free_factor.h>
#include <slipstep/diagnosis/diagnose.h>
#include <slipstep/diagnosis/diagnosis_parameters.h>
#include <slipstep/diagnosis/findings.h>
#include <slipstep/diagnosis/outlying_rows.h>
#include <slipstep/diagnosis/next_test.h>
#include <slipstep/diagnosis/localisation.h>
#include <slipstep/diagnosis/refits.h>
#include <slipstep/diagnosis/look_alike.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/process.h>
#include <slipstep/utilities/text.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <numeric>

namespace SlipStep
{
  namespace
  {
    // Of those that the case asks for, one at least has to be missing.
    void check_candidates(const Workspace &workspace)
    {
      std::string why;
      for (const Candidate &candidate :
           make_candidates(workspace.start, workspace.range))
        {
          if (candidate.why_not.empty())
            return;
          why += (why.empty() ? "" : "; ") + candidate.name + ": " +
                 candidate.why_not;
        }
      workspace.start.reject("Diagnosis/Candidates",
                             "none of these can be tried (" + why + ")");
    }



    // What is in the model cannot be asked for once more.
    void ask_for_others(const std::vector<Part> &parts, Parameters &parameters)
    {
      const std::string        key = "Diagnosis/Candidates";
      std::vector<std::string> left;
      for (const std::string &asked_for : parameters.list(key))
        if (!holds(effect_names(parts), asked_for))
          left.push_back(asked_for);
      if (left.size() < parameters.list(key).size())
        parameters.set(key,
                       left.empty() ? "all" :
                                      boost::algorithm::join(left, ", "),
                       "diagnosis");
    }



    // With a model's effects and fitted values, as `run` and `point` take it.
    Parameters case_of(const Parameters &start, const Model &model)
    {
      Parameters result =
        assemble(start, model.parts, model.values()).parameters;
      for (const auto &[path, value] : model.values())
        result.set(path, quantity_text(result, path, value, 8), "diagnosis");
      apply_ties(read_derived(result), result);
      result.set("Calibration/Parameters",
                 statements(model.campaign->fitted, false),
                 "diagnosis");
      ask_for_others(model.parts, result);
      return result;
    }



    /// The stages of a diagnosis on the contact point.
    class Diagnostician
    {
    public:
      Diagnostician(const Parameters &parameters, const Stage &stage)
        : parameters(parameters)
        , stage(stage)
      {}

      /// @throws InputError for what is wrong with the case and its tests
      void begin();

      void run();

      Diagnosis  result;
      Parameters before, after; ///< cases

    private:
      void judge_tests();

      void tell_all();

      void tell_limits();

      void name();

      void tell_lone_tests(const std::size_t part);

      void suspect_look_alikes();

      void suspect_condition();

      void correct();

      void prove();

      void show();

      void show_formulas();

      const Parameters parameters;
      const Stage      stage;
      Ingested         ingested;
      Judgement        judgement;
      Model            final_model;
    };



    // By the weights that the rows have in the end, which what is shown of the
    // start has, too.
    void Diagnostician::judge_tests()
    {
      judgement     = judge(*ingested.workspace, ingested.base);
      ingested.base = judgement.base;
      weigh_start(ingested);
    }



    // The strongest first.
    void Diagnostician::name()
    {
      result.was_stopped     = ingested.workspace->was_stopped;
      result.has_gap         = judgement.gap.p <= ingested.workspace->level;
      result.gap             = judgement.gap;
      result.verdict         = judgement.verdict;
      result.withdrawn       = judgement.withdrawn;
      result.explained_share = judgement.explained_share;
      result.remainder_p     = judgement.remainder.p;
      final_model            = judgement.found.model;
      const std::vector<Evidence> &evidence = judgement.found.evidence;
      std::vector<std::size_t>     order(final_model.parts.size());
      std::iota(order.begin(), order.end(), 0);
      if (evidence.size() == order.size())
        stable_sort(order, [&](const std::size_t a, const std::size_t b) {
          return evidence[a].cost > evidence[b].cost;
        });
      for (const std::size_t part : order)
        if (final_model.parts[part].corrects.empty())
          {
            result.effects.push_back(final_model.parts[part].name);
            tell_lone_tests(part);
          }
      result.is_incomplete = judgement.is_incomplete;
      for (const Outlier &outlier :
           outlying_rows_words(*ingested.workspace, judgement.outlying))
        result.outliers.push_back(outlier);
      if (judgement.verdict == Verdict::no_gap && !judgement.outlying.empty())
        result.warnings.push_back(
          "With full weight on the numbers that nothing explains there was a "
          "gap, " +
          (judgement.named_by_outliers.empty() ?
             "attributed to no effect" :
             "attributed to " + list_text(judgement.named_by_outliers)) +
          ": if these numbers were recorded correctly, this verdict is wrong.");
      for (const Rival &rival : judgement.found.rivals)
        result.rivals.push_back({rival.name, rival.instead_of});
      if (!judgement.confounded.empty())
        result.warnings.push_back(
          confounding_words(result.effects.front(), judgement.confounded));
    }



    // By one test alone it may be that test that went wrong.
    void Diagnostician::tell_lone_tests(const std::size_t part)
    {
      if (part >= judgement.found.evidence.size())
        return;
      const Comparison &comparison = ingested.workspace->comparison;
      for (const std::size_t condition : judgement.found.evidence[part].told_by)
        {
          std::vector<std::string> tests;
          for (std::size_t t = 0; t < comparison.tests.size(); ++t)
            if (comparison.tests[t].condition == condition)
              tests.push_back(ingested.workspace->tests[t].rows.name);
          if (tests.size() == 1 && comparison.conditions.size() > 1)
            result.lone_tests.emplace_back(final_model.parts[part].name,
                                           tests[0]);
        }
    }



    // What looks like an effect may be something else.
    void Diagnostician::suspect_look_alikes()
    {
      if (!result.has_gap || ingested.workspace->is_late())
        return;
      stage("whether a zero or a held parameter explains as much");
      result.look_alike = find_look_alike(*ingested.workspace,
                                          ingested.base,
                                          final_model,
                                          judgement.gap.excess);
    }



    // What has no name may be one condition that went wrong: the verdict
    // without it, if it makes most of the gap.
    void Diagnostician::suspect_condition()
    {
      constexpr double      most             = 0.5;
      constexpr std::size_t least_conditions = 4;

      const Comparison         &comparison = ingested.workspace->comparison;
      const std::vector<double> squares =
        comparison.squares_by_test(judgement.gap.explained);
      std::vector<double> of_condition(comparison.conditions.size(), 0.);
      for (std::size_t t = 0; t < squares.size(); ++t)
        of_condition[comparison.tests[t].condition] += squares[t];
      const auto worst =
        std::max_element(of_condition.begin(), of_condition.end());
      const double share =
        *worst / std::accumulate(squares.begin(), squares.end(), 0.);
      if (!(share > most) || of_condition.size() < least_conditions)
        return;
      stage("without the condition that contributes most to the gap");
      std::vector<std::string> left_out;
      for (std::size_t t = 0; t < squares.size(); ++t)
        if (comparison.tests[t].condition ==
            static_cast<std::size_t>(worst - of_condition.begin()))
          left_out.push_back(ingested.workspace->tests[t].rows.name);
      Judgement without;
      try
        {
          const Ingested others = ingest(parameters, {}, left_out);
          without               = judge(*others.workspace, others.base);
        }
      catch (const RunError &)
        {
          // Too little is left, or it cannot be simulated.
          throw_if_stopped();
          return;
        }
      if (without.verdict == Verdict::unnamed)
        return;
      const std::vector<std::string> names =
        effect_names(without.found.model.parts);
      for (const std::string &test : left_out)
        result.outliers.push_back(
          {test,
           "its condition alone contributes " + percent_text(share) +
             " of the difference that noise does not explain; without it " +
             (names.empty() ? "nothing is found to be missing" :
                              list_text(names) + " would be named") +
             ". All results shown here include it"});
    }



    // What has no name may still be described along one covariate.
    void Diagnostician::correct()
    {
      stage("describing the gap that has no name");
      ingested.workspace->range.track_wave =
        clear_track_wave(*ingested.workspace, ingested.base).wavelength;
      const std::optional<FreeFactor> correction = find_correction(
        *ingested.workspace, ingested.base, judgement, result.where);
      if (!correction.has_value())
        return;
      result.correction = *correction;
      final_model       = correction->model;
    }



    // What the formula of a name alone leaves along its covariate.
    void Diagnostician::show_formulas()
    {
      Workspace &workspace = *ingested.workspace;
      for (std::size_t i = 0; i < final_model.parts.size(); ++i)
        {
          const Part &part = final_model.parts[i];
          if (part.corrects.empty())
            continue;
          const std::optional<Model> bare =
            refit_without(workspace, final_model, i);
          if (!bare.has_value())
            continue;
          const Comparison     &comparison = workspace.comparison;
          const Eigen::VectorXd left       = comparison.difference(*bare);
          const std::string     section    = "Friction/expression/";
          const std::string     covariate =
            part.formula.texts.at(section + "Covariate");
          result.completed.push_back(
            {part.corrects,
             covariate,
             part.formula.texts.at(section + "Formula"),
             bare->objective - final_model.objective,
             covariate_panel(workspace,
                             left,
                             {{part.name,
                               comparison.difference(final_model) - left}},
                             covariate_in_expression(covariate))});
        }
    }



    void Diagnostician::prove()
    {
      Workspace &workspace = *ingested.workspace;
      stage("intervals");
      if (!workspace.was_stopped)
        workspace.comparison.deadline = deadline_of(parameters, 0.5);
      result.parameters =
        find_intervals(workspace, final_model, result.confidence);
      stage("what these tests can tell");
      result.candidates = candidate_results(workspace,
                                            judgement,
                                            result.parameters,
                                            ingested.base);
      stage("the next test");
      result.next_test =
        propose_next_test(workspace, final_model, judgement.found.rivals);
      result.n_candidates =
        count_if(result.candidates, [](const CandidateResult &candidate) {
          return candidate.standing != Standing::in_the_model;
        });
      result.n_refits = workspace.n_refits;
    }



    void Diagnostician::show()
    {
      const Workspace  &workspace  = *ingested.workspace;
      const Comparison &comparison = workspace.comparison;
      stage("before and after");
      // A few fits, whose ends are compared.
      ingested.workspace->comparison.deadline =
        std::chrono::steady_clock::time_point::max();
      show_formulas();
      describe_tests(ingested, final_model, result);
      describe_shrink(ingested, final_model, result);
      describe_doubts(workspace, result);
      describe_few_levels(workspace, final_model, result);
      describe_short_lengths(workspace, final_model, result);
      describe_what_nothing_holds(workspace,
                                  judgement.view,
                                  final_model,
                                  result);
      const Eigen::VectorXd base_difference =
        comparison.difference(ingested.base);
      Changes    changes;
      const auto add = [&](const std::string &label, const Model &model) {
        changes.emplace_back(label,
                             comparison.difference(model) - base_difference);
      };
      if (!result.effects.empty())
        add(list_text(result.effects), final_model);
      else if (!final_model.parts.empty())
        add("correction", final_model);
      for (const Rival &rival : judgement.found.rivals)
        if (changes.size() < 4)
          add(rival.name, rival.model);
      result.panels =
        covariate_panels(workspace, base_difference, changes, result.where);
      before = case_of(parameters, ingested.base);
      after  = case_of(parameters, final_model);
    }



    void Diagnostician::begin()
    {
      result.seed          = parameters.integer("Diagnosis/Seed");
      result.level         = parameters.number("Diagnosis/Level");
      result.n_draws       = parameters.integer("Diagnosis/Draws");
      result.is_restricted = parameters.text("Diagnosis/Candidates") != "all";
      ingested             = ingest(parameters, stage);
      if (result.is_restricted)
        check_candidates(*ingested.workspace);
    }



    // What follows from the judgement.
    void Diagnostician::tell_all()
    {
      describe_data(ingested, result);
      describe_noise(*ingested.workspace, result);
      name();
      if (result.has_gap)
        {
          stage("where the gap is");
          result.where =
            localise(*ingested.workspace, ingested.base, judgement.gap);
        }
      if (result.is_incomplete)
        {
          stage("where the rest is");
          result.remains = localise(*ingested.workspace,
                                    judgement.found.model,
                                    judgement.remainder);
        }
      suspect_look_alikes();
      if (result.verdict == Verdict::unnamed && !ingested.workspace->is_late())
        {
          suspect_condition();
          correct();
        }
      prove();
      show();
      tell_limits();
    }



    void Diagnostician::tell_limits()
    {
      result.is_cut_short = ingested.workspace->was_late;
      const bool has_wave = any_of(result.where,
                                   [](const Localisation &place) {
                                     return place.covariate == "position";
                                   }) ||
                            final_model.has("texture");
      const std::string positions =
        has_wave ? warning_of_positions(ingested.workspace->tests) : "";
      if (!positions.empty())
        result.warnings.push_back(positions);
      for (const DiagnosedParameter &parameter : result.parameters)
        if (!parameter.effect.empty() && parameter.profile.empty())
          {
            result.warnings.push_back(
              (result.was_stopped ? "Ctrl-C came" :
                                    "Half of Diagnosis/Most time was over") +
              std::string(" before the interval of ") + parameter.name +
              " was followed: this one, and all others without a profile, are "
              "estimated from the curvature at the optimum");
            break;
          }
      if (result.is_cut_short)
        result.warnings.push_back(
          (result.was_stopped ?
             std::string("Ctrl-C came") :
             "Diagnosis/Most time = " + parameters.text("Diagnosis/Most time") +
               " was over") +
          " before all effects were tried: this is the best answer so far, "
          "not yet compared with all others; with more time the answer may "
          "change");
    }



    void Diagnostician::run()
    {
      const ResourceUsage begin = ResourceUsage::now();
      judge_tests();
      const Diagnosis judged = result;
      try
        {
          tell_all();
        }
      catch (const RunError &)
        {
          ingested.workspace->end_by_signal();
          result = judged;
          tell_all();
        }
      const ResourceUsage end = ResourceUsage::now();
      result.wall_time        = end.wall_time - begin.wall_time;
      result.cpu_time         = end.cpu_time - begin.cpu_time;
    }
  } // namespace



  DiagnosedCase diagnose(const Parameters &parameters, const Stage &stage)
  {
    Diagnostician diagnostician(with_parameters_listed(parameters), stage);
    diagnostician.begin();
    diagnostician.run();
    return {diagnostician.result, diagnostician.before, diagnostician.after};
  }
} // namespace SlipStep
