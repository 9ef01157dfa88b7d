// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_diagnosis_hidden_trial_h
#define tests_diagnosis_hidden_trial_h

#include <slipstep/calibration/advice.h>
#include <slipstep/diagnosis/findings.h>
#include <slipstep/diagnosis/refits.h>
#include <slipstep/diagnosis/diagnosis_parameters.h>
#include <slipstep/diagnosis/next_test.h>
#include <slipstep/diagnosis/verdict.h>
#include <slipstep/diagnosis/ingest.h>
#include <slipstep/experiment/point_driver.h>
#include <slipstep/friction/effect.h>
#include <slipstep/synthetic_tests/planted_campaign.h>

#include <tests/temporary_folder.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace SlipStep
{
  namespace Testing
  {
    /// Names in order, other formulas of a candidate by the name of that.
    inline std::vector<std::string>
    candidates_of(std::vector<std::string> names)
    {
      for (std::string &name : names)
        {
          const auto found = effect_registry().find(name);
          if (found != effect_registry().end() &&
              !found->second.search.candidate.empty())
            name = found->second.search.candidate;
        }
      std::sort(names.begin(), names.end());
      return names;
    }



    /// A planted campaign, diagnosed, and how that compares with the truth.
    struct Trial
    {
      std::vector<std::string> truth; ///< sorted
      std::vector<std::string> named; ///< sorted
      std::vector<std::string> rivals;
      Verdict                  verdict = Verdict::no_gap;
      /// The objective that noise-free tests leave after the starting model is
      /// fitted to them, over what noise has along it; 25 are five standard
      /// deviations. Of two hidden effects the lesser one, with the other in
      /// the model.
      double detectability = 0.;
      double excess = 0., remainder = 0.; ///< see GapTest
      /// Root mean square of model minus truth, shares of friction.
      double error_before = 0., error_after = 0.;
      double explained_share = 0., remainder_p = 1., gap_p = 1.;
      /// Names with a formula that is not quite right.
      std::vector<std::string> completed;
      bool                     is_incomplete = false;
      double                   cpu_time      = 0.; ///< [s]

      /// @name With evidence only.
      ///@{
      /// Planted strengths of named effects, and those inside their 95 %
      /// intervals.
      unsigned int n_intervals = 0, n_inside = 0;
      /// Of left-out conditions, over the noise floor.
      double left_out_ratio = std::numeric_limits<double>::quiet_NaN();
      /// Whether the proposed next test, made and added, led to the truth; to
      /// a name that is wrong.
      bool has_next_test = false, is_resolved = false, is_misled = false;
      ///@}

      bool is_alarm() const
      {
        return verdict != Verdict::no_gap && verdict != Verdict::not_testable;
      }

      bool is_exact() const
      {
        return !named.empty() && named == truth;
      }

      /// Any name that is not in the truth.
      bool is_false() const
      {
        return std::any_of(
          named.begin(), named.end(), [&](const std::string &name) {
            return std::find(truth.begin(), truth.end(), name) == truth.end();
          });
      }

      /// Everything in the truth is a name or a rival of one.
      bool holds_truth() const
      {
        return std::all_of(
          truth.begin(), truth.end(), [&](const std::string &name) {
            return std::find(named.begin(), named.end(), name) != named.end() ||
                   std::find(rivals.begin(), rivals.end(), name) !=
                     rivals.end();
          });
      }
    };



    /// The starting model of a planted campaign, its files in a folder.
    inline Parameters planted_case(const Planting::PlantedCampaign &campaign,
                                   const std::filesystem::path     &folder)
    {
      Planting::write_campaign(folder, campaign);
      Parameters parameters;
      declare_loading_parameters(parameters);
      FrictionLaw::declare_parameters(parameters);
      declare_calibration_parameters(parameters);
      declare_diagnosis_parameters(parameters);
      parameters.read(folder / "case.prm");
      return parameters;
    }



    /// The friction without noise at the numbers compared.
    inline Eigen::VectorXd noise_free(const Planting::PlantedCampaign &campaign,
                                      const Comparison          &comparison,
                                      std::vector<CampaignTest> &tests)
    {
      for (CampaignTest &test : tests)
        for (const Planting::PlantedTest &planted : campaign.tests)
          if (planted.measured.name == test.rows.name)
            {
              test.rows.friction = planted.truth.along_x;
              if (!test.rows.friction_y.empty())
                test.rows.friction_y = planted.truth.along_y;
            }
      return comparison.means_of(tests);
    }



    /// What a model of tests without noise leaves, in units of the variance
    /// that noise, as uncertain as it is known, has along it.
    inline double visible(const Workspace &clean, const Model &model)
    {
      const Eigen::VectorXd left =
        model.residual.head(clean.comparison.n_rows());
      const Eigen::RowVectorXd chance =
        left.normalized().transpose() * clean.null_draws;
      return model.objective /
             std::max(1., chance.squaredNorm() / chance.size());
    }



    /// The least of these where a hidden effect is not in the model.
    inline double detectability(Workspace                      &clean,
                                const Model                    &base,
                                const std::vector<std::string> &hidden)
    {
      Model model =
        make_model(clean.start, {}, base.values(), clean.tests, base);
      clean.comparison.fit(model, 0.1);
      double least = visible(clean, model);
      if (hidden.size() < 2)
        return least;
      const View view = score_candidates(clean, model);
      for (const CandidateView &seen : view.candidates)
        if (!seen.ways.empty() &&
            std::find(hidden.begin(), hidden.end(), seen.candidate.name) !=
              hidden.end())
          {
            std::optional<Model> with_one = refit_with(clean, model, seen);
            if (!with_one.has_value())
              continue;
            settle(clean, *with_one);
            least = std::min(least, visible(clean, *with_one));
          }
      return least;
    }



    /// The planted strength of an effect in terms of the parameter that is
    /// fitted for it; NaN if there is none.
    inline double planted_strength(const Planting::PlantedEffect &effect,
                                   const double                   stiffness,
                                   std::string                   &path)
    {
      static const std::map<std::string, std::string> names = {
        {"overstress", "Friction/overstress/Exponent"},
        {"softening", "Friction/softening/Kinetic coefficient"},
        {"healing", "Friction/healing/Rate"},
        {"pressure", "Friction/pressure/Exponent"},
        {"shear_cap", "Friction/shear_cap/Shear limit"},
        {"adhesion", "Friction/adhesion/Strength"},
        {"heating", "Friction/heating/Heating"},
        {"run_in", "Friction/run_in/Change"},
        {"anisotropy", "Friction/anisotropy/Ratio"},
        {"direction", "Friction/direction/Change"},
        {"stribeck", "Friction/stribeck/Rise"},
        {"viscous", "Friction/viscous/Drag"},
        {"compliance", "Friction/Tangential stiffness"}};
      const auto value = [&](const std::string &name) {
        for (const Planting::TruthParameter &parameter : effect.parameters)
          if (parameter.name == name)
            return parameter.value;
        return std::numeric_limits<double>::quiet_NaN();
      };
      if (names.count(effect.name) == 0)
        return std::numeric_limits<double>::quiet_NaN();
      path = names.at(effect.name);
      if (effect.name == "compliance")
        return 1. / (1. / stiffness + 1. / value("Loading/Machine stiffness"));
      // Only the product with the weakening is felt, which is fixed.
      if (effect.name == "heating")
        return value(path) * value("Friction/heating/Weakening") / 1e-3;
      return value(path);
    }



    inline void count_intervals(const Planting::PlantedCampaign &campaign,
                                const Workspace                 &workspace,
                                const Model                     &model,
                                Trial                           &trial)
    {
      const std::vector<DiagnosedParameter> found =
        find_intervals(workspace, model, 0.95);
      for (const Planting::PlantedEffect &effect : campaign.hidden)
        {
          std::string path;
          double      planted =
            planted_strength(effect, campaign.contact.stiffness, path);
          for (const DiagnosedParameter &parameter : found)
            if (parameter.path == path && parameter.effect == effect.name)
              {
                // The same ellipse, with its axes exchanged.
                if (effect.name == "anisotropy" &&
                    (planted > 1.) != (parameter.value > 1.))
                  planted = 1. / planted;
                ++trial.n_intervals;
                trial.n_inside +=
                  (parameter.is_lower_open || planted >= parameter.lower) &&
                  (parameter.is_upper_open || planted <= parameter.upper);
              }
        }
    }



    /// Make the proposed test, as noisy as the others, and diagnose again.
    inline void make_next_test(const Planting::PlantedCampaign &campaign,
                               const std::filesystem::path     &folder,
                               const Workspace                 &workspace,
                               const Judgement                 &judgement,
                               const Parameters                &parameters,
                               Trial                           &trial)
    {
      const NextTest next = propose_next_test(workspace,
                                              judgement.found.model,
                                              judgement.found.rivals);
      if (next.words.empty())
        return;
      trial.has_next_test = true;
      Planting::Random random(campaign.options.seed + 77);
      for (const ProposedTest &proposed :
           propose_tests(*judgement.found.model.campaign))
        if (proposed.words == next.words)
          {
            MeasuredTest                 test = proposed.motion;
            const Planting::TrueFriction truth =
              Planting::simulate(campaign.contact, test);
            double mean = 0.;
            for (std::size_t i = 0; i < truth.along_x.size(); ++i)
              mean +=
                std::hypot(truth.along_x[i],
                           truth.along_y.empty() ? 0. : truth.along_y[i]) /
                truth.along_x.size();
            const Planting::RecordNoise record = Planting::draw_record_noise(
              campaign.noise,
              campaign.contact.coefficient.static_coefficient,
              random);
            test.friction = Planting::noisy_record(test.time,
                                                   truth.along_x,
                                                   mean,
                                                   record.gain,
                                                   record.offset_x,
                                                   campaign.noise,
                                                   random);
            if (!test.friction_y.empty())
              test.friction_y = Planting::noisy_record(test.time,
                                                       truth.along_y,
                                                       mean,
                                                       record.gain,
                                                       record.offset_y,
                                                       campaign.noise,
                                                       random);
            test.name = test.condition = "next test";
            write_measured_test(folder / "measured" / "next.csv", test);
          }
      Ingested        ingested = ingest(parameters, {});
      const Judgement again    = judge(*ingested.workspace, ingested.base);
      const std::vector<std::string> named =
        candidates_of(effect_names(again.found.model.parts));
      trial.is_resolved =
        again.verdict == Verdict::named && named == trial.truth;
      trial.is_misled = again.verdict == Verdict::named && named != trial.truth;
    }



    /// @param with_evidence also intervals, left-out conditions, next test
    inline Trial run_trial(const Planting::CampaignOptions &options,
                           const bool with_evidence = false)
    {
      const Planting::PlantedCampaign campaign =
        Planting::plant_campaign(options);
      const TemporaryFolder folder;
      const Parameters      parameters =
        planted_case(campaign, folder.path() / "campaign");
      const std::clock_t begin     = std::clock();
      Ingested           ingested  = ingest(parameters, {});
      Workspace         &workspace = *ingested.workspace;
      const Judgement    judgement = judge(workspace, ingested.base);
      ingested.base                = judgement.base;
      Trial trial;
      trial.cpu_time =
        static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
      // What the workshop calls by other names: its memory of speed is the slip
      // law of rate and state in other letters.
      for (const Planting::PlantedEffect &effect : campaign.hidden)
        trial.truth.push_back(effect.name == "memory_length" ? "slip_law" :
                              effect.name == "load_memory" ? "pressure_memory" :
                                                             effect.name);
      trial.truth = candidates_of(trial.truth);
      trial.named = candidates_of(effect_names(judgement.found.model.parts));
      for (const Rival &rival : judgement.found.rivals)
        trial.rivals.push_back(candidates_of({rival.name}).front());
      trial.is_incomplete = judgement.is_incomplete;
      for (const Part &part : judgement.found.model.parts)
        if (!part.corrects.empty())
          trial.completed.push_back(part.corrects);
      trial.verdict         = judgement.verdict;
      trial.explained_share = judgement.explained_share;
      trial.remainder_p     = judgement.remainder.p;
      trial.gap_p           = judgement.gap.p;
      trial.excess          = judgement.gap.excess;
      trial.remainder       = judgement.remainder.excess;

      std::vector<CampaignTest> tests      = workspace.tests;
      const Comparison         &comparison = workspace.comparison;
      const Eigen::VectorXd     truth = noise_free(campaign, comparison, tests);
      const auto                error = [&](const Model &model) {
        return relative_rms(comparison,
                            comparison.difference(*model.simulator,
                                                  model.scaled) +
                              comparison.measured - truth);
      };
      trial.error_before = error(ingested.base);
      trial.error_after  = error(judgement.found.model);
      if (!trial.truth.empty())
        {
          Workspace clean           = workspace;
          clean.tests               = tests;
          clean.comparison.measured = truth;
          clean.comparison.set_noise(workspace.noise.noise, truth);
          trial.detectability =
            detectability(clean, ingested.base, trial.truth);
        }
      if (with_evidence && !trial.named.empty())
        {
          const Model &model = judgement.found.model;
          if (options.campaign_class != Planting::CampaignClass::other_formula)
            count_intervals(campaign, workspace, model, trial);
          Diagnosis diagnosis;
          describe_tests(ingested, model, diagnosis);
          describe_shrink(ingested, model, diagnosis);
          trial.left_out_ratio =
            diagnosis.shrink.left_out_after / diagnosis.shrink.noise_floor;
          if (trial.verdict == Verdict::ambiguous)
            make_next_test(campaign,
                           folder.path() / "campaign",
                           workspace,
                           judgement,
                           parameters,
                           trial);
        }
      return trial;
    }
  } // namespace Testing
} // namespace SlipStep

#endif
