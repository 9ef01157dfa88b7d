// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/gap.h>
#include <slipstep/diagnosis/hum_of_tests.h>
#include <slipstep/diagnosis/rounding_noise.h>
#include <slipstep/diagnosis/outlier.h>
#include <slipstep/diagnosis/refits.h>
#include <slipstep/diagnosis/diagnosis_parameters.h>
#include <slipstep/diagnosis/element_tests.h>
#include <slipstep/diagnosis/ingest.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <numeric>
#include <sstream>

namespace SlipStep
{
  namespace
  {

    const char *const list_key = "Calibration/Parameters";

    // Unless it is no positive number: a few times smaller to larger, as far as
    // is allowed.
    void add_to_fit(const Parameters          &parameters,
                    const std::string         &path,
                    std::vector<FitParameter> &listed)
    {
      const auto *quantity =
        dynamic_cast<const Quantity *>(parameters.entry(path).pattern.get());
      if (quantity == nullptr || !(parameters.number(path) > 0.))
        return;
      const bool is_coefficient = path.find("coefficient") != std::string::npos;
      const double factor       = is_coefficient ? 3. : 30.;
      FitParameter result;
      result.path      = path;
      result.dimension = quantity->dimension;
      result.start     = parameters.number(path);
      // Next to a bound that is excluded.
      result.lower =
        std::max(result.start / factor, quantity->minimum * (1. + 1e-6));
      result.upper = std::min(result.start * factor, quantity->maximum);
      result.is_logarithmic = !is_coefficient;
      if (result.lower < result.start && result.start < result.upper)
        listed.push_back(result);
    }



    // Scales of which only a product with another parameter is felt, and
    // limits.
    bool is_reference(const std::string &path)
    {
      for (const std::string end : {"Maximum ratio",
                                    "Largest coefficient",
                                    "Reference pressure",
                                    "Weakening",
                                    "Angle",
                                    "Forward angle",
                                    "From",
                                    "To"})
        if (path.size() > end.size() &&
            path.compare(path.size() - end.size(), end.size(), end) == 0)
          return true;
      return false;
    }
  } // namespace



  Parameters with_parameters_listed(const Parameters &parameters)
  {
    Parameters                result = parameters;
    std::vector<FitParameter> listed;
    if (parameters.text(list_key).empty())
      {
        add_to_fit(parameters, "Friction/Static coefficient", listed);
        for (const std::string &effect : parameters.list("Friction/Effects"))
          for (const std::string &path :
               parameters.paths("Friction/" + effect + "/"))
            if (!is_reference(path))
              add_to_fit(parameters, path, listed);
      }
    else
      listed = read_fit_parameters(parameters);
    result.set(list_key, statements(listed, true), "diagnosis");
    return result;
  }



  namespace
  {
    Noise stated_noise(const Parameters &parameters)
    {
      const auto number = [&](const std::string &name) {
        return parameters.number("Diagnosis/" + name);
      };
      Noise noise;
      noise.white      = 1.;
      noise.drift      = number("Drift");
      noise.drift_time = number("Drift time");
      noise.gain       = number("Gain");
      noise.offset     = number("Offset");
      noise.slope      = number("Slope");
      return noise;
    }



    // By what was measured, not by what the tests are called: the samples of
    // noise go to the same tests whatever their names, order and units.
    void sort_by_content(std::vector<CampaignTest> &tests)
    {
      const auto key = [](const CampaignTest &test) {
        const MeasuredTest &rows = test.rows;
        std::ostringstream  out;
        out << std::scientific << std::setprecision(6);
        for (const double value :
             {rows.time.back() - rows.time.front(),
              range_of(rows.displacement),
              rows.pressure.front(),
              rows.friction.back(),
              std::accumulate(rows.friction.begin(), rows.friction.end(), 0.)})
          out << value << ' ';
        return out.str();
      };
      sort(tests, [&](const CampaignTest &a, const CampaignTest &b) {
        return key(a) < key(b);
      });
    }



    /// The stages before anything is judged.
    class Preparer
    {
    public:
      Preparer(const Parameters &parameters, const Stage &stage)
        : stage(stage)
        , start(with_parameters_listed(parameters))
        , stated(stated_noise(parameters))
      {}

      Ingested run(const std::vector<std::string> &left_out);

    private:
      void begin(const std::vector<CampaignTest> &tests);

      void calibrate();

      void take_off_hum();

      void keep_near();

      void weigh_rounding(const Eigen::VectorXd &noise);

      double judge_rows(const Eigen::VectorXd &difference);

      void scale_rows(const Eigen::VectorXd &difference);

      void drop_copies(std::vector<CampaignTest> &tests);

      std::vector<std::pair<double, std::size_t>>
      distances(const Contradiction &found) const;

      bool drop_outlier();

      void judge_chance();

      const Stage      stage;
      const Parameters start;
      const Noise      stated;
      Ingested         result;
      /// By which the noise of every number is multiplied for what rounding
      /// does to it.
      Eigen::VectorXd rounding_factors;
      /// Whether the base has time steps for its own parameters.
      bool has_own_steps = true;
    };



    // A copy is no repetition: it would tell of less noise than there is.
    void Preparer::drop_copies(std::vector<CampaignTest> &tests)
    {
      std::vector<CampaignTest> kept;
      for (const CampaignTest &test : tests)
        {
          const auto original =
            std::find_if(kept.begin(),
                         kept.end(),
                         [&](const CampaignTest &other) {
                           return other.rows.friction == test.rows.friction &&
                                  other.rows.time == test.rows.time &&
                                  other.rows.friction_y == test.rows.friction_y;
                         });
          if (original == kept.end())
            {
              kept.push_back(test);
              continue;
            }
          result.outliers.push_back({test.rows.name,
                                     "it has the same rows as " +
                                       original->rows.name +
                                       ": it is left out as a copy",
                                     false,
                                     true});
          result.outlier_tests.push_back(test);
        }
      tests = kept;
    }



    void Preparer::begin(const std::vector<CampaignTest> &tests)
    {
      const unsigned int most_effects = start.integer("Diagnosis/Most effects");
      result.workspace.reset(new Workspace{start,
                                           tests,
                                           Comparison(tests),
                                           {},
                                           {},
                                           {},
                                           {},
                                           start.number("Diagnosis/Level"),
                                           most_effects,
                                           0,
                                           deadline_of(start),
                                           stage});
      Workspace &workspace          = *result.workspace;
      workspace.comparison.deadline = workspace.deadline;
      workspace.comparison.set_noise(stated, workspace.comparison.measured);
      rounding_factors.setOnes(workspace.comparison.n_rows());
      result.base        = make_coarse_model(start, {}, {}, tests);
      result.base.scaled = result.base.campaign->scaled_start();
      result.base.simulator->plan(result.base.scaled);
      const Eigen::VectorXd difference =
        workspace.comparison.difference(result.base);
      if (difference.size() == 0)
        throw RunError("the starting model cannot be simulated");
      result.start_rms = relative_rms(workspace.comparison, difference);
    }



    // What the rows of every test scatter by on several scales. Returns how
    // well that is known, 0 if they do not hang together.
    double Preparer::judge_rows(const Eigen::VectorXd &difference)
    {
      Comparison &comparison = result.workspace->comparison;
      RowNoiseFit fit(stated.drift, stated.drift_time);
      std::vector<std::pair<std::size_t, std::size_t>> which;
      for (std::size_t t = 0; t < comparison.tests.size(); ++t)
        {
          const CampaignTest &test     = result.workspace->tests[t];
          const ComparedTest &compared = comparison.tests[t];
          if (test.noise_is_stated || test.rounding.kept > 0.)
            continue;
          const double *begin = difference.data() + compared.begin;
          for (std::size_t s = 0; s < test.axes.size(); ++s)
            {
              fit.add({begin, begin + compared.n_bins()},
                      compared.series[s].time,
                      static_cast<double>(compared.borders.back()) /
                        compared.n_bins(),
                      test.axes[s].noise,
                      compared.level);
              which.emplace_back(t, s);
              begin += compared.n_bins();
            }
        }
      const RowNoiseFit::Result found = fit.solve();
      if (!found.is_correlated)
        return 0.;
      for (std::size_t i = 0; i < which.size(); ++i)
        comparison.set_row_noise(which[i].first,
                                 which[i].second,
                                 found.records[i]);
      return found.freedom;
    }



    // Where rows hang together, their scatter is hardly told from a drift in
    // one record: how far they are from what those before them predict tells
    // it. Neighbours are subtracted, so that what the model lacks is not
    // counted.
    void Preparer::scale_rows(const Eigen::VectorXd &difference)
    {
      Comparison &comparison  = result.workspace->comparison;
      RowMatrix   innovations = difference;
      comparison.whiten(innovations);
      for (std::size_t t = 0; t < comparison.tests.size(); ++t)
        {
          ComparedTest &test = comparison.tests[t];
          if (result.workspace->tests[t].noise_is_stated ||
              test.rounding.kept > 0.)
            continue;
          Eigen::Index row = test.begin;
          for (Series &series : test.series)
            {
              std::vector<double> sizes;
              for (++row; sizes.size() + 1 < test.n_bins(); ++row)
                sizes.push_back(
                  std::abs(innovations(row, 0) - innovations(row - 1, 0)));
              const double factor =
                median(std::move(sizes)) / (0.6745 * std::sqrt(2.));
              for (double &own : series.row_noise)
                own *= factor;
            }
        }
    }



    // Add what rounding does to the noise of the rows, in the place of what was
    // added before.
    void Preparer::weigh_rounding(const Eigen::VectorXd &noise)
    {
      double      *factor = rounding_factors.data();
      Eigen::Index row    = 0;
      for (ComparedTest &test : result.workspace->comparison.tests)
        for (Series &series : test.series)
          for (double &own : series.row_noise)
            {
              own /= *factor;
              *factor = std::hypot(1., noise(row++) / own);
              own *= *factor++;
            }
    }



    // Fit, noise, and again: what replicates differ by hardly depends on the
    // model, unless the first fit is far off.
    void Preparer::calibrate()
    {
      Workspace  &workspace  = *result.workspace;
      Comparison &comparison = workspace.comparison;
      for (unsigned int pass = 0; pass < 3; ++pass)
        {
          if (!comparison.fit(result.base, pass < 2 ? 1. : 0.01))
            throw RunError("the starting model cannot be simulated");
          has_own_steps = replan(result.base);
          if (pass == 2)
            break;
          const Eigen::VectorXd difference = comparison.difference(result.base);
          weigh_rounding(Eigen::VectorXd::Zero(comparison.n_rows()));
          const double row_freedom = judge_rows(difference);
          weigh_rounding(rounding_noise(comparison,
                                        workspace.tests,
                                        comparison.measured + difference));
          const auto estimate = [&]() {
            workspace.noise =
              estimate_noise(comparison.contrasts(difference), stated);
            workspace.noise.row_freedom = row_freedom;
            comparison.set_noise(workspace.noise.noise,
                                 comparison.measured + difference);
          };
          estimate();
          if (row_freedom > 0.)
            for (unsigned int n = 0; n < 2; ++n)
              {
                scale_rows(difference);
                estimate();
              }
        }
      comparison.fit(result.base, 0.01);
      keep_near();
    }



    void Preparer::take_off_hum()
    {
      std::string                     doubt;
      const std::vector<CampaignTest> tests =
        without_hum(result.workspace->tests, result.base, doubt);
      if (!doubt.empty())
        result.warnings.push_back(doubt);
      if (tests.empty())
        return;
      std::vector<double> scaled = result.base.scaled;
      begin(tests);
      result.base.scaled.swap(scaled);
      replan(result.base);
      calibrate();
    }



    // Where the law is far off and rows hang together, noise that lets whole
    // tests be off lets the fit give up their level for the sake of few rows.
    void Preparer::keep_near()
    {
      constexpr double far = 4.;

      Workspace &workspace = *result.workspace;
      Model     &base      = result.base;
      const auto rms       = [&](const Model &model) {
        return relative_rms(workspace.comparison, model);
      };
      result.is_kept_near = false;
      if (base.objective < far * workspace.comparison.n_rows())
        return;
      const std::optional<Model> plain = fit_plainly(workspace, base);
      if (!plain.has_value() || rms(base) < lost_fit * rms(*plain))
        return;
      const std::vector<double> scaled = base.scaled;
      base.scaled                      = plain->scaled;
      if (!replan(base))
        {
          base.scaled = scaled;
          return;
        }
      workspace.comparison.fit(base,
                               0.01,
                               {},
                               std::vector<bool>(base.scaled.size(), true));
      result.is_kept_near = true;
    }



    // How far the replicates of a contradiction are from what the other
    // conditions tell of them, by the noise of the others; farthest first. The
    // noise and the fit of all would know too much of the contradiction.
    std::vector<std::pair<double, std::size_t>>
    Preparer::distances(const Contradiction &found) const
    {
      Comparison        comparison = result.workspace->comparison;
      const std::size_t condition  = comparison.tests[found.tests[0]].condition;
      std::vector<bool> left_out;
      for (const ComparedTest &test : comparison.tests)
        left_out.push_back(test.condition == condition &&
                           comparison.conditions.size() > 1);
      Model model = result.base.copy();
      comparison.set_noise(found.noise,
                           comparison.measured + comparison.difference(model));
      comparison.fit(model, 1., left_out);
      const Eigen::VectorXd difference = comparison.difference(model);
      std::vector<std::pair<double, std::size_t>> distances;
      for (std::size_t i = 0; i < comparison.tests.size(); ++i)
        {
          const ComparedTest &test = comparison.tests[i];
          if (test.condition != condition)
            continue;
          const Contrast own{test.series,
                             test.level,
                             -difference.segment(test.begin, test.size),
                             {i}};
          distances.emplace_back(slow_squares(own, found.noise), i);
        }
      std::sort(distances.rbegin(), distances.rend());
      return distances;
    }



    // A test that its own replicate contradicts: the one farther from the
    // model, or both if that does not tell.
    bool Preparer::drop_outlier()
    {
      constexpr double clearly = 4.;

      const Workspace      &workspace  = *result.workspace;
      const Comparison     &comparison = workspace.comparison;
      const Eigen::VectorXd difference = comparison.difference(result.base);
      const std::optional<Contradiction> found =
        find_contradiction(comparison.contrasts(difference),
                           workspace.noise.noise,
                           stated,
                           start.integer("Diagnosis/Seed"));
      if (!found.has_value())
        return false;
      const auto far     = distances(*found);
      const bool is_told = far[0].first > clearly * far[1].first;
      const auto leave   = [&](const std::size_t outlier,
                             const std::size_t twin) {
        result.outliers.push_back(
          {workspace.tests[outlier].rows.name,
           "it and its replicate " + workspace.tests[twin].rows.name +
             " contradict each other (chance under the noise of other tests: " +
             short_text(found->chance, 2) + ")" +
             (is_told ? ", and it is farther from the model: it is" :
                          ", and the model does not tell which is wrong: both "
                          "are") +
             " left out"});
        result.outlier_tests.push_back(workspace.tests[outlier]);
      };
      leave(far[0].second, far[1].second);
      if (!is_told)
        leave(far[1].second, far[0].second);
      std::vector<CampaignTest> kept;
      for (std::size_t i = 0; i < workspace.tests.size(); ++i)
        if (i != far[0].second && (is_told || i != far[1].second))
          kept.push_back(workspace.tests[i]);
      begin(kept);
      return true;
    }



    void Preparer::judge_chance()
    {
      Workspace            &workspace  = *result.workspace;
      Comparison           &comparison = workspace.comparison;
      const Eigen::VectorXd friction =
        comparison.measured + comparison.difference(result.base);
      const FrictionLaw law(result.base.simulator->with(result.base.scaled));
      workspace.covariates =
        find_covariates(comparison,
                        workspace.tests,
                        friction,
                        law.static_coefficient() / law.tangential_stiffness());
      workspace.range =
        tested_range(comparison, workspace.tests, workspace.covariates);
      workspace.null_draws = draw_null(comparison,
                                       workspace.noise,
                                       start.integer("Diagnosis/Draws"),
                                       start.integer("Diagnosis/Seed"));
      prepare_gap_test(workspace);
      workspace.range.track_wave =
        clear_track_wave(workspace, result.base).wavelength;
      weigh_start(result);
    }



    // Results are told by names.
    void make_names_unique(std::vector<CampaignTest> &tests)
    {
      std::map<std::string, unsigned int> n_called;
      for (const CampaignTest &test : tests)
        ++n_called[test.rows.name];
      for (CampaignTest &test : tests)
        if (n_called[test.rows.name] > 1)
          test.rows.name += " (" +
                            (test.rows.file.parent_path().filename() /
                             test.rows.file.filename())
                              .string() +
                            ")";
    }



    Ingested Preparer::run(const std::vector<std::string> &left_out)
    {
      const auto tell = [&](const std::string &text) {
        if (stage)
          stage(text);
      };
      tell("reading the tests");
      const Campaign campaign(start);
      result.warnings                 = campaign.warnings();
      std::vector<CampaignTest> tests = campaign.tests;
      make_names_unique(tests);
      check_element_tests(start, tests);
      remove_erase_if(tests, [&](const CampaignTest &test) {
        return holds(left_out, test.rows.name);
      });
      sort_by_content(tests);
      drop_copies(tests);
      begin(tests);
      tell("calibrating the starting model");
      calibrate();
      take_off_hum();
      for (unsigned int n = 0; n < 2 && drop_outlier(); ++n)
        calibrate();
      // A fit that was cut short tells of a gap that may be none.
      if (result.workspace->is_late())
        throw RunError(
          "Diagnosis/Most time = " + start.text("Diagnosis/Most time") +
          " was over before the starting model was fitted to the tests, so "
          "that nothing can be concluded from them: allow more time");
      tell("noise");
      judge_chance();
      warn_of_records(result);
      if (!has_own_steps)
        result.warnings.push_back(
          "No time steps could be found for the calibrated parameters, as "
          "happens with stick-slip: those of earlier parameters are used, "
          "with an error that is not known.");
      return std::move(result);
    }
  } // namespace



  void weigh_start(Ingested &ingested)
  {
    const Comparison     &comparison = ingested.workspace->comparison;
    const Eigen::VectorXd difference =
      comparison.difference(*ingested.base.simulator,
                            ingested.base.campaign->scaled_start());
    if (difference.size() == 0)
      return;
    ingested.start_rms = relative_rms(comparison, difference);
    RowMatrix whitened = difference;
    comparison.whiten(whitened);
    ingested.start_objective = whitened.squaredNorm();
  }



  Ingested ingest(const Parameters               &parameters,
                  const Stage                    &stage,
                  const std::vector<std::string> &left_out)
  {
    return Preparer(parameters, stage).run(left_out);
  }
} // namespace SlipStep
