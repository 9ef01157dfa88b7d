// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/confounding.h>
#include <slipstep/diagnosis/findings.h>
#include <slipstep/diagnosis/hum_of_tests.h>
#include <slipstep/diagnosis/left_out.h>
#include <slipstep/diagnosis/refits.h>
#include <slipstep/experiment/stability.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

#include <boost/crc.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <tuple>

namespace SlipStep
{
  namespace
  {
    // The same for the same numbers, whatever the tests are called.
    std::string hash_of(const std::vector<CampaignTest> &tests)
    {
      std::uint32_t sum = 0;
      for (const CampaignTest &test : tests)
        {
          boost::crc_32_type crc;
          for (const std::vector<double> *values : {&test.rows.time,
                                                    &test.rows.displacement,
                                                    &test.rows.pressure,
                                                    &test.rows.friction,
                                                    &test.rows.friction_y})
            crc.process_bytes(values->data(), values->size() * sizeof(double));
          sum += crc.checksum();
        }
      std::ostringstream out;
      out << std::hex << std::setw(8) << std::setfill('0') << sum;
      return out.str();
    }



    // Of one axis along that.
    std::pair<std::vector<double>, std::vector<double>>
    along_x_and_y(const Eigen::VectorXd           &values,
                  const ComparedTest              &test,
                  const std::vector<FrictionAxis> &axes)
    {
      const double       *begin = values.data() + test.begin;
      std::vector<double> x(begin, begin + test.n_bins()), y;
      if (axes.size() == 2)
        for (std::size_t i = 0; i < x.size(); ++i)
          {
            const double along = x[i], across = begin[test.n_bins() + i];
            x[i] = axes[0].cosine * along + axes[1].cosine * across;
            y.push_back(axes[0].sine * along + axes[1].sine * across);
          }
      return {x, y};
    }



    // How many rows of a test count, of each axis.
    double n_counted(const Comparison &comparison, const ComparedTest &test)
    {
      return std::max(1.,
                      comparison.counts.segment(test.begin, test.size).sum() /
                        test.series.size());
    }



    double root_mean_square(const Comparison      &comparison,
                            const Eigen::VectorXd &values,
                            const ComparedTest    &test)
    {
      return values.segment(test.begin, test.size)
               .cwiseProduct(comparison.counts.segment(test.begin, test.size))
               .norm() /
             std::sqrt(n_counted(comparison, test)) / test.level;
    }



    // Variance of the rows of a test by the noise, as a share of its friction:
    // of rows by themselves, and of what they share. A single record cannot
    // show what whole tests differ by: it is not in what noise leaves of it.
    std::pair<double, double> noise_variances(const Comparison   &comparison,
                                              const ComparedTest &test)
    {
      Noise noise = comparison.noise();
      if (comparison.tests.size() == 1)
        noise.gain = noise.offset = noise.slope = 0.;
      double        own = 0., gain = 0.;
      const double *counts = comparison.counts.data() + test.begin;
      for (const Series &series : test.series)
        for (std::size_t i = 0; i < series.row_noise.size(); ++i, ++counts)
          {
            own += *counts *
                   std::pow(noise.white * series.row_noise[i] / test.level, 2);
            gain += *counts *
                    std::pow(noise.gain * series.friction[i] / test.level, 2);
          }
      // A test with two axes has the noise of both.
      const double n_rows = n_counted(comparison, test);
      double       axes   = 0.;
      for (const Series &series : test.series)
        axes += std::pow(series.level(1., noise), 2);
      return {own / n_rows,
              gain / n_rows + axes * (noise.drift * noise.drift +
                                      noise.offset * noise.offset +
                                      noise.slope * noise.slope / 12.)};
    }
  } // namespace



  void describe_data(const Ingested &ingested, Diagnosis &diagnosis)
  {
    const Workspace &workspace  = *ingested.workspace;
    diagnosis.n_conditions      = workspace.comparison.conditions.size();
    diagnosis.n_replicate_pairs = workspace.noise.n_contrasts;
    diagnosis.n_samples         = workspace.comparison.n_rows();
    diagnosis.data_hash         = hash_of(workspace.tests);
    diagnosis.outliers          = ingested.outliers;
    diagnosis.warnings          = ingested.warnings;
    diagnosis.start_effects     = workspace.start.list("Friction/Effects");
    diagnosis.start_parameters =
      find_intervals(workspace, ingested.base, diagnosis.confidence);
    for (std::size_t i = 0; i < ingested.base.scaled.size(); ++i)
      {
        const FitParameter &parameter = ingested.base.campaign->fitted[i];
        const double        scaled    = ingested.base.scaled[i];
        if (is_on_bound(scaled))
          diagnosis.warnings.push_back(
            parameter.path + " of the starting model is at its bound " +
            parameter.text(parameter.from_scaled(scaled), 6) +
            ": if this bound in Calibration/Parameters is only a guess, a "
            "wider range may be all that is needed.");
      }
  }



  void describe_noise(const Workspace &workspace, Diagnosis &diagnosis)
  {
    static const std::vector<std::pair<std::string, std::string>> names = {
      {"white", "of the scatter between neighbouring rows"},
      {"drift", "of friction"},
      {"drift time", "of the duration of a usual test"},
      {"gain", "of friction"},
      {"offset", "of friction"},
      {"slope", "of friction"},
      {"row memory", "of the memory estimated from the scatter of rows"},
      {"drift by seconds",
       "0: proportional to the duration, 1: the same in seconds"},
      {"drift by sensor",
       "0: the same for both sensors, 1: in proportion to the scatter of "
       "their rows"}};
    const Noise::Logarithms logarithms = workspace.noise.noise.logarithms();
    for (std::size_t i = 0; i < names.size(); ++i)
      {
        const double deviation = std::sqrt(workspace.noise.covariance(i, i));
        if (deviation == 0.)
          continue; // not felt
        NoiseComponent component;
        component.name         = names[i].first;
        component.unit         = names[i].second;
        const auto in_its_unit = [&](const double value) {
          return i + 2 < names.size() ? std::exp(value) : value;
        };
        component.value = in_its_unit(logarithms(i));
        component.lower = in_its_unit(logarithms(i) - 1.96 * deviation);
        component.upper = in_its_unit(logarithms(i) + 1.96 * deviation);
        component.source =
          workspace.noise.n_contrasts > 0 ? "replicates" : "stated";
        diagnosis.noise.push_back(component);
      }
    const HumOfTests hum = hum_of(workspace.comparison, workspace.tests);
    if (hum.n_told > 0)
      diagnosis.noise.push_back(
        {hum.is_mains ? "hum of the mains" : "wave in time",
         hum.share,
         "of friction, the median of tests",
         "spectra",
         hum.share,
         hum.share});
  }



  namespace
  {
    /// Simulated minus measured friction.
    struct Differences
    {
      Eigen::VectorXd before, after, left_out_before, left_out_after;
    };



    DiagnosedTest described_test(const Workspace   &workspace,
                                 const Differences &differences,
                                 const std::size_t  number)
    {
      const Comparison   &comparison = workspace.comparison;
      const ComparedTest &compared   = comparison.tests[number];
      const MeasuredTest &rows       = workspace.tests[number].rows;
      DiagnosedTest       test;
      test.name       = rows.name;
      test.condition  = rows.condition;
      test.file       = rows.file.string();
      test.level      = compared.level;
      test.start_time = rows.time.front();
      for (std::size_t i = 0; i < compared.n_bins(); ++i)
        {
          const std::size_t row = compared.middle_row(i);
          test.time.push_back(rows.time[row] - rows.time.front());
          test.displacement.push_back(
            rows.displacement_y.empty() ?
              rows.displacement[row] :
              std::hypot(rows.displacement[row], rows.displacement_y[row]));
          test.phase.push_back(workspace.covariates.phase[compared.begin + i]);
        }
      const std::vector<FrictionAxis> &axes = workspace.tests[number].axes;
      const auto curve_of = [&](const Eigen::VectorXd &values) {
        return along_x_and_y(values, compared, axes);
      };
      test.cosine                              = axes[0].cosine;
      test.sine                                = axes[0].sine;
      std::tie(test.measured, test.measured_y) = curve_of(comparison.measured);
      std::tie(test.before, test.before_y) =
        curve_of(comparison.measured + differences.before);
      std::tie(test.after, test.after_y) =
        curve_of(comparison.measured + differences.after);
      const auto variances = noise_variances(comparison, compared);
      test.noise =
        compared.level * std::sqrt(variances.first + variances.second);
      const auto rms = [&](const Eigen::VectorXd &values) {
        return root_mean_square(comparison, values, compared);
      };
      test.rms_before      = rms(differences.before);
      test.rms_after       = rms(differences.after);
      test.left_out_before = rms(differences.left_out_before);
      test.left_out_after  = rms(differences.left_out_after);
      return test;
    }



    DiagnosedTest described_outlier(const CampaignTest &outlier)
    {
      DiagnosedTest test;
      test.name         = outlier.rows.name;
      test.condition    = outlier.rows.condition;
      test.file         = outlier.rows.file.string();
      test.is_outlier   = true;
      test.time         = outlier.rows.time;
      test.displacement = outlier.rows.displacement;
      test.measured     = outlier.rows.friction;
      return test;
    }



    // The starting model, and with one effect after the other.
    std::vector<GapStep> steps_down(const Ingested &ingested,
                                    const Model    &after)
    {
      const Workspace  &workspace  = *ingested.workspace;
      const Comparison &comparison = workspace.comparison;
      const auto step = [&](const std::string &label, const Model &model) {
        return GapStep{label, relative_rms(comparison, model), model.objective};
      };
      std::vector<GapStep> steps = {{"starting model as it is",
                                     ingested.start_rms,
                                     ingested.start_objective},
                                    step("calibrated", ingested.base)};
      for (std::size_t part = 0; part + 1 < after.parts.size(); ++part)
        {
          const std::optional<Model> so_far =
            fitted_model(workspace,
                         {after.parts.begin(), after.parts.begin() + part + 1},
                         after.values(),
                         after,
                         0.1);
          if (so_far.has_value())
            steps.push_back(step("with " + after.parts[part].name, *so_far));
        }
      if (!after.parts.empty())
        steps.push_back(step("with " + after.parts.back().name, after));
      return steps;
    }
  } // namespace



  void describe_tests(const Ingested &ingested,
                      const Model    &after,
                      Diagnosis      &diagnosis)
  {
    const Workspace  &workspace  = *ingested.workspace;
    const Comparison &comparison = workspace.comparison;
    Differences       differences;
    differences.before = comparison.difference(ingested.base);
    differences.after  = comparison.difference(after);
    left_out(workspace, ingested.base, &differences.left_out_before);
    left_out(workspace, after, &differences.left_out_after);
    for (std::size_t t = 0; t < workspace.tests.size(); ++t)
      diagnosis.tests.push_back(described_test(workspace, differences, t));
    for (const CampaignTest &outlier : ingested.outlier_tests)
      diagnosis.tests.push_back(described_outlier(outlier));
    stable_sort(diagnosis.tests,
                [](const DiagnosedTest &a, const DiagnosedTest &b) {
                  return a.name < b.name;
                });
    diagnosis.shrink.left_out_before =
      relative_rms(comparison, differences.left_out_before);
    diagnosis.shrink.left_out_after =
      relative_rms(comparison, differences.left_out_after);
  }



  void describe_shrink(const Ingested &ingested,
                       const Model    &after,
                       Diagnosis      &diagnosis)
  {
    const Comparison &comparison = ingested.workspace->comparison;
    Shrink           &shrink     = diagnosis.shrink;
    double            sum        = 0.;
    std::size_t       n          = 0;
    for (const ComparedTest &test : comparison.tests)
      {
        const auto variances = noise_variances(comparison, test);
        sum += test.n_bins() * (variances.first + variances.second);
        n += test.n_bins();
      }
    shrink.noise_floor     = std::sqrt(sum / n);
    diagnosis.steps        = steps_down(ingested, after);
    shrink.fitted_before   = diagnosis.steps[1].rms;
    shrink.fitted_after    = diagnosis.steps.back().rms;
    const auto above_floor = [&](const double value) {
      return std::sqrt(
        std::max(0., value * value - shrink.noise_floor * shrink.noise_floor));
    };
    shrink.systematic_before = above_floor(shrink.fitted_before);
    shrink.systematic_after  = above_floor(shrink.fitted_after);
    diagnosis.steps.push_back({"noise alone",
                               shrink.noise_floor,
                               static_cast<double>(comparison.n_rows())});
  }



  void describe_few_levels(const Workspace &workspace,
                           const Model     &model,
                           Diagnosis       &diagnosis)
  {
    for (const EffectsAlong &along : effects_along_conditions(workspace, model))
      if (along.names.size() > 1 && along.n_levels <= along.n_numbers)
        diagnosis.warnings.push_back(
          "The tests have " + std::to_string(along.n_levels) + " levels of " +
          along.covariate + ", and " + list_text(along.names) +
          " together with the coefficient have " +
          std::to_string(along.n_numbers) +
          " parameters: these would fit any friction at these levels. Another "
          "formula of " +
          along.covariate + " would fit as well; a test at another " +
          along.covariate + " would tell them apart.");
  }



  namespace
  {
    // Typical of the test with the closest rows; infinite if none moves.
    double path_between_rows(const Workspace &workspace)
    {
      double closest = std::numeric_limits<double>::infinity();
      for (const ComparedTest &test : workspace.comparison.tests)
        {
          std::vector<double> steps;
          for (std::size_t i = 1; i < test.n_bins(); ++i)
            if (const double step =
                  workspace.covariates.path[test.begin + i] -
                  workspace.covariates.path[test.begin + i - 1];
                step > 0.)
              steps.push_back(step);
          if (!steps.empty())
            closest = std::min(closest, median(std::move(steps)));
        }
      return closest;
    }
  } // namespace



  void describe_short_lengths(const Workspace &workspace,
                              const Model     &model,
                              Diagnosis       &diagnosis)
  {
    const double between = path_between_rows(workspace);
    const Values values  = model.values();
    for (const Part &part : model.parts)
      for (const CandidateParameter &parameter : part.formula.parameters)
        {
          const auto *quantity = dynamic_cast<const Quantity *>(
            workspace.start.entry(parameter.path).pattern.get());
          const double length = values.at(parameter.path);
          if (quantity != nullptr && quantity->dimension == Dimension::length &&
              length < between)
            diagnosis.warnings.push_back(
              parameter.path.substr(parameter.path.find('/') + 1) + " = " +
              rounded_text(length, 2) +
              " mm is less than the path between rows, " +
              rounded_text(between, 2) +
              " mm: these tests show only that it is as short as this. The "
              "contact loses its memory with any slip, but keeps it at rest.");
        }
  }



  namespace
  {
    // By which share steady friction falls from the slowest to the fastest
    // speed of the tests, with some of what a model has added.
    double fall_with_speed(const Workspace         &workspace,
                           const Model             &model,
                           const std::vector<Part> &parts)
    {
      const TestedRange &range = workspace.range;
      const FrictionLaw  law(
        assemble(workspace.start, parts, model.values()).parameters);
      const auto at = [&](const double speed) {
        return SteadySliding(law,
                             dealii::Tensor<1, 2>({speed, 0.}),
                             range.highest);
      };
      const SteadySliding slow = at(range.slowest), fast = at(range.fastest);
      return slow.exists() && fast.exists() ?
               1. - fast.friction() / slow.friction() :
               0.;
    }



    std::vector<Part> without(std::vector<Part> parts, const std::string &name)
    {
      remove_erase_if(parts, [&](const Part &part) {
        return part.name == name || part.corrects == name;
      });
      return parts;
    }
  } // namespace



  void describe_what_nothing_holds(const Workspace &workspace,
                                   const View      &view,
                                   const Model     &model,
                                   Diagnosis       &diagnosis)
  {
    constexpr double much = 0.02;

    std::vector<std::string> untried, standing;
    std::string              holder;
    for (const CandidateView &seen : view.candidates)
      if (seen.is_unstable && seen.p <= workspace.level &&
          !model.has(seen.candidate.name) && !model.has(seen.candidate.held_by))
        {
          untried.push_back(seen.candidate.name);
          holder = seen.candidate.held_by;
        }
    if (untried.empty() || diagnosis.effects.empty())
      return;
    const double fall = fall_with_speed(workspace, model, model.parts);
    for (const std::string &name : diagnosis.effects)
      if (fall_with_speed(workspace, model, without(model.parts, name)) <
          fall - much)
        standing.push_back(name);
    if (!standing.empty())
      diagnosis.warnings.push_back(
        list_text(standing) + " may stand for " + list_text(untried, "or") +
        ": friction falls with speed by " + rounded_text(100. * fall, 2) +
        " % in these tests, and effects that follow speed instantaneously "
        "could not be tried, since nothing in the model keeps such sliding "
        "stable; with " +
        holder +
        " in Friction/Effects and its parameters fitted they can be tried.");
  }



  namespace
  {
    std::string in_percent(const double share)
    {
      return short_text(100. * share, 2) + " %";
    }



    void doubt_noise(const Workspace          &workspace,
                     const Diagnosis          &diagnosis,
                     std::vector<std::string> &doubts)
    {
      if (diagnosis.n_replicate_pairs == 0)
        doubts.push_back(
          "There are no replicates: the noise is the one stated in section "
          "Diagnosis. If repeated tests differed by more than " +
          in_percent(std::hypot(workspace.noise.noise.gain,
                                workspace.noise.noise.offset)) +
          " of friction, the verdict could be overturned.");
      if (diagnosis.n_replicate_pairs == 0 &&
          diagnosis.shrink.fitted_after < 0.95 * diagnosis.shrink.noise_floor)
        doubts.push_back("The remaining difference (" +
                         in_percent(diagnosis.shrink.fitted_after) +
                         ") is less than the stated noise (" +
                         in_percent(diagnosis.shrink.noise_floor) +
                         "), which seems too large: with less noise, smaller "
                         "gaps would be detected.");
      else if (diagnosis.n_replicate_pairs > 0 &&
               diagnosis.n_replicate_pairs < 4)
        doubts.push_back("The noise between tests is known from " +
                         std::to_string(diagnosis.n_replicate_pairs) +
                         " repetition(s) only; a further one that differs more "
                         "would make the gap less certain.");
    }



    void doubt_names(const Diagnosis          &diagnosis,
                     std::vector<std::string> &doubts)
    {
      if (diagnosis.is_incomplete)
        doubts.push_back("What remains is more than noise: the formula of " +
                         diagnosis.effects.front() +
                         " is not quite right, or something weaker is "
                         "missing beside it.");
      if (diagnosis.shrink.hardly_predicts())
        doubts.push_back(
          "Conditions left out of the fit are predicted " +
          std::string(diagnosis.shrink.left_out_after >
                          diagnosis.shrink.left_out_before ?
                        "worse" :
                        "hardly better") +
          " with " + list_text(diagnosis.effects) +
          ": between and beyond the conditions tested the formula may not "
          "hold, and another effect may be what is missing.");
      doubts.push_back(
        "An effect that is not in the catalogue but changes friction in "
        "the same way under the conditions tested would be taken for " +
        diagnosis.effects.front() +
        "; conditions that were not tested could tell.");
      if (!diagnosis.next_test.words.empty())
        doubts.push_back("The next test (" + diagnosis.next_test.words +
                         ") may speak for a rival.");
    }
  } // namespace



  void describe_doubts(const Workspace &workspace, Diagnosis &diagnosis)
  {
    std::vector<std::string> &doubts = diagnosis.would_overturn;
    doubt_noise(workspace, diagnosis, doubts);
    switch (diagnosis.verdict)
      {
        case Verdict::named:
        case Verdict::ambiguous:
          doubt_names(diagnosis, doubts);
          break;
        case Verdict::unnamed:
          doubts.push_back("A larger catalogue could contain the missing "
                           "effect; tests that vary one condition at a time "
                           "could also lead to a name.");
          break;
        case Verdict::no_gap:
        case Verdict::not_testable:
          doubts.push_back(
            "Effects that change friction by less than the smallest "
            "detectable change (see the catalogue) may be present; tests "
            "under other conditions, or more tests, could show them.");
          break;
      }
    if (diagnosis.n_conditions == 1)
      doubts.push_back("All tests have one and the same condition: none can "
                       "be left out and predicted.");
  }
} // namespace SlipStep
