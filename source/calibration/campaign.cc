// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/calibration/campaign.h>
#include <slipstep/measured_data/odd_rows.h>
#include <slipstep/measured_data/raw_files.h>
#include <slipstep/measured_data/rounded_motion.h>
#include <slipstep/measured_data/sensor_noise.h>
#include <slipstep/measured_data/resample.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/measured_data/test_set.h>
#include <slipstep/utilities/pattern_words.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

namespace SlipStep
{
  namespace fs = std::filesystem;

  namespace
  {
    const char *const tests_key = "Calibration/Tests";
    const char *const noise_key = "Calibration/Noise";
    const char *const skip_key  = "Calibration/Skip";
  } // namespace



  void declare_calibration_parameters(Parameters &parameters)
  {
    using namespace dealii::Patterns;
    parameters.declare(
      tests_key,
      "measured",
      Anything(),
      "Measured tests that 'slipstep calibrate' fits: a folder of .csv files, "
      "or files separated by commas (measured/wet_*.csv stands for all files "
      "with such names), relative to the folder of the case. 'slipstep check' "
      "reads them.");
    parameters.declare(
      "Calibration/Parameters",
      "",
      AnythingWithWords({"from", "to", "start", "log", "linear"}),
      "Parameters to be fitted, separated by ';': '<path of a key> from "
      "<least value> to <largest value> [start <value>] [log|linear]'. The "
      "start is the case's own value unless stated. The scale is logarithmic "
      "if the bounds are positive and a factor of ten or more apart. All "
      "other keys keep the values of the case.");
    parameters.declare(
      "Calibration/Derived",
      "",
      Anything(),
      "Quantities derived from the parameters, separated by ';': '<name> = "
      "<formula>', where {path of a key} stands for its value in mm, s, N, "
      "MPa, degC, rad. A name that is itself the path of a key ties this key "
      "to the others: it follows them in the fit.");
    parameters.declare(
      noise_key,
      "estimated",
      AnythingWithWords({"estimated"}),
      "Standard deviation of the measured friction coefficient, by which "
      "differences are weighted: 'estimated' from the second differences of "
      "each record, or a number greater than 0. A comment '# noise: 0.002' in "
      "a test takes precedence.");
    parameters.declare(
      skip_key,
      "0 s",
      Quantity(Dimension::time, 0., 1e30, false, true),
      "Time at the beginning of every test that is simulated but not compared. "
      "0 or more, with its unit.");
    parameters.declare(
      "Calibration/Lead-in",
      "0 mm",
      Quantity(Dimension::length, 0., 1e30, false, true),
      "Length slid before the first row of every test, with its first speed "
      "and pressure: for records that begin while the contact slides already. "
      "0 or more, with its unit.");
    parameters.declare(
      "Calibration/Starts",
      "4",
      Integer(1, 1000),
      "Number of starts of the search: the first from the values of the case, "
      "the others spread between the bounds. 1 or more.");
    parameters.declare(
      "Calibration/Confidence",
      "0.95",
      Quantity(Dimension::number, 0.5, 0.999),
      "Confidence of the intervals. Between 0.5 and 0.999, no unit.");
    parameters.declare(
      "Calibration/Most time",
      "1 h",
      Quantity(Dimension::time, 0., 1e9, true, true),
      "Longest time of the search and of the intervals. Starts that have not "
      "begun after half of it are left out. When it is over, the best values "
      "so far are the result, and intervals that have not been followed to "
      "their ends are symmetric, from the curvature at the optimum, with a "
      "warning that says so. More than 0, with its unit.");
  }



  double Campaign::stated_noise(const Parameters &parameters)
  {
    const std::string text = parameters.text(noise_key);
    if (text == "estimated")
      return 0.;
    const Quantity noise(Dimension::number, 0., 1e30, true);
    if (!noise.match(text))
      parameters.reject(noise_key,
                        "must be 'estimated' or a number greater than 0");
    return noise.value(text);
  }



  double Campaign::noted_noise(const MeasuredTest &test)
  {
    const auto note = test.notes.find("noise");
    if (note == test.notes.end())
      return 0.;
    const Quantity noise(Dimension::number, 0., 1e30, true);
    if (!noise.match(note->second))
      throw InputError(test.file.string() + ": noise: " + note->second + ": " +
                       noise.why_not(note->second) +
                       "; it must be a number greater than 0");
    return noise.value(note->second);
  }



  namespace
  {
    // Fewer rows show no noise.
    constexpr std::size_t fewest_rows = 8;

    double largest_friction(const MeasuredTest &test)
    {
      double largest = 0.;
      for (const auto *values : {&test.friction, &test.friction_y})
        for (const double value : *values)
          largest = std::max(largest, std::abs(value));
      if (largest == 0.)
        throw InputError(test.file.string() +
                         ": the friction is zero throughout");
      return largest;
    }



    // Of few rows the scatter may be anything, and is taken to be more like
    // that of the others: the usual share of friction counts as so many rows.
    void share_noise_of_short_tests(const std::vector<CampaignTest *> &tests,
                                    const std::size_t                  axis)
    {
      constexpr std::size_t enough = 30;

      std::vector<double> shares;
      for (const CampaignTest *const test : tests)
        if (test->rows.time.size() >= fewest_rows &&
            test->axes[axis].noise > 0.)
          shares.push_back(test->axes[axis].noise /
                           largest_friction(test->rows));
      if (shares.size() < 2)
        return;
      const double usual = median(shares);
      for (CampaignTest *const test : tests)
        {
          const std::size_t n     = test->rows.time.size();
          double           &noise = test->axes[axis].noise;
          if (!test->noise_is_stated && n >= fewest_rows && n < enough &&
              noise > 0.)
            noise *= std::pow(usual * largest_friction(test->rows) / noise,
                              static_cast<double>(enough) / (n + enough));
        }
    }



    // A record without visible noise, filtered or generated, must not outweigh
    // all others: an estimate counts at least a ten-thousandth of the friction
    // and a tenth of what is usual among the tests.
    void keep_noise_visible(std::vector<CampaignTest> &all_tests)
    {
      for (std::size_t axis = 0; axis < 2; ++axis)
        {
          std::vector<CampaignTest *> tests;
          for (CampaignTest &test : all_tests)
            if (axis < test.axes.size())
              tests.push_back(&test);
          share_noise_of_short_tests(tests, axis);
          std::vector<double> estimates;
          for (const CampaignTest *const test : tests)
            estimates.push_back(test->axes[axis].noise);
          for (CampaignTest *const test : tests)
            {
              const double least = std::max(1e-4 * largest_friction(test->rows),
                                            0.1 * median(estimates));
              if (test->noise_is_stated || test->axes[axis].noise >= least)
                continue;
              test->axes[axis].noise = least;
              test->rows.warnings.push_back(
                test->rows.file.string() +
                (test->rows.time.size() < fewest_rows ?
                   ": it has too few rows to estimate its noise; " :
                 axis == 1 ?
                   ": hardly any noise is visible along its second axis; " :
                   ": hardly any noise is visible; ") +
                short_text(least, 2) +
                " is used, unless a line '# noise: ...' states more.");
            }
        }
    }



    // A record that hardly leaves a step shows neither step nor noise: it was
    // rounded like those of the campaign that do.
    void find_rounding(std::vector<CampaignTest> &tests)
    {
      constexpr double digits =
        0.01; // of a step, which is known by few of them

      std::set<double> known;
      for (const CampaignTest &test : tests)
        for (const auto *channel : {&test.rows.friction, &test.rows.friction_y})
          known.insert(coarse_step(*channel));
      known.erase(0.);
      if (known.empty())
        return;
      for (CampaignTest &test : tests)
        for (const auto *channel : {&test.rows.friction, &test.rows.friction_y})
          {
            double step = coarse_step(*channel);
            for (auto other = known.begin();
                 step == 0. && other != known.end() && !channel->empty();
                 ++other)
              if (are_multiples(*channel, *other, digits))
                step = *other;
            if (step == 0. || test.noise_is_stated)
              continue;
            for (FrictionAxis &axis : test.axes)
              axis.noise = std::max(axis.noise, step / std::sqrt(12.));
            const Rounding rounding = rounding_to(step, *channel);
            if (rounding.deviation() > test.rounding.deviation())
              test.rounding = rounding;
          }
    }



    // Replicates measured by two sensors are compared along the same axes,
    // those of the most rows.
    void share_axes_of_conditions(std::vector<CampaignTest> &tests)
    {
      const auto key = [](const CampaignTest &test) {
        return std::make_pair(test.rows.time.size(), test.axes[0].sine);
      };
      std::map<std::string, CampaignTest *> leaders;
      for (CampaignTest &test : tests)
        if (test.axes.size() == 2 && !test.rows.condition.empty())
          {
            CampaignTest *&leader = leaders[test.rows.condition];
            if (leader == nullptr || key(*leader) < key(test))
              leader = &test;
          }
      for (CampaignTest &test : tests)
        {
          const auto found = leaders.find(test.rows.condition);
          if (test.axes.size() < 2 || found == leaders.end())
            continue;
          for (std::size_t i = 0; i < 2; ++i)
            {
              FrictionAxis &axis  = test.axes[i];
              const double  noise = axis.noise, sine = axis.sine;
              axis       = found->second->axes[i];
              axis.noise = test.noise_is_stated || axis.sine == sine ?
                             noise :
                             noise_of_friction(test.friction(axis), test.rows);
            }
        }
    }



    // Of the tests that were led in the same way, as replicates on a good
    // machine are, one that does not depend on their names and order.
    std::size_t leader_of_motion(const std::vector<MeasuredTest> &tests,
                                 const std::size_t                number)
    {
      const auto motion = [](const MeasuredTest &test) {
        return std::tie(test.time,
                        test.displacement,
                        test.displacement_y,
                        test.pressure);
      };
      const auto friction = [](const MeasuredTest &test) {
        return std::tie(test.friction, test.friction_y);
      };
      std::size_t leader = number;
      for (std::size_t i = 0; i < tests.size(); ++i)
        if (motion(tests[i]) == motion(tests[number]) &&
            friction(tests[i]) < friction(tests[leader]))
          leader = i;
      return leader;
    }



    // The first row of all is where both begin.
    std::vector<std::size_t> rows_to_compare(const MeasuredTest &measured,
                                             const MeasuredTest &test,
                                             const Parameters   &parameters)
    {
      const double begin = test.time.front() + parameters.number(skip_key);
      const std::vector<std::size_t> unloaded = rows_without_load(measured);
      std::vector<std::size_t>       rows;
      for (std::size_t i = 0; i < test.time.size(); ++i)
        if (test.time[i] >= begin &&
            !std::binary_search(unloaded.begin(), unloaded.end(), i))
          rows.push_back(i);
      if (rows.size() < 2)
        parameters.reject(
          skip_key,
          std::string(rows.empty() ? "nothing" : "a single row") +
            " is left of " + test.file.string() + ", which lasts " +
            short_text(test.time.back() - test.time.front()) + " s");
      return rows;
    }



    // Nearly the least, but for a few stamps that are next to each other.
    double distance_of_rows(const MeasuredTest             &test,
                            const std::vector<std::size_t> &rows)
    {
      std::vector<double> distances;
      for (std::size_t i = 1; i < rows.size(); ++i)
        distances.push_back(test.time[rows[i]] - test.time[rows[i - 1]]);
      std::sort(distances.begin(), distances.end());
      return distances[distances.size() / 20];
    }



    // A replay of the same motion is taken as it is.
    CampaignTest prepare(const MeasuredTest &measured,
                         const Parameters   &parameters,
                         const double        rounding,
                         const Replay       *of_same_motion)
    {
      // Of the elastic slip. Stairs of more make the contact stick and slip in
      // each row; noise of more is felt where it has not slipped yet.
      constexpr double stick_share = 0.1, noise_share = 0.05;

      MeasuredTest test = measured;
      undo_rounding_of_time(test);
      double            step = rounding_of_motion(test, rounding);
      const FrictionLaw law(parameters);
      const double      slip =
        elastic_slip(law.static_coefficient() * median(test.pressure),
                     law,
                     Machine(parameters));
      if (step > 0. && step > stick_share * slip)
        undo_rounding_of_motion(test, rounding);
      else
        {
          step = 0.;
          take_off_noise_of_motion(test, noise_share * slip);
        }
      const std::vector<std::size_t> rows =
        rows_to_compare(measured, test, parameters);
      ResampleOptions options;
      // Rows farther from each other tell when rests begin.
      options.motion_step = step > 0. ? rounding_of_motion(measured) : 0.;
      CampaignTest result{test,
                          {},
                          false,
                          of_same_motion != nullptr ?
                            *of_same_motion :
                            Replay(resample(test, options).test,
                                   parameters.number("Calibration/Lead-in"),
                                   distance_of_rows(test, rows)),
                          0.,
                          {}};
      result.replay.order = test.order();
      keep_rows(result.rows, rows);
      result.motion_step = step;
      const double noted = Campaign::noted_noise(test);
      const double stated =
        noted > 0. ? noted : Campaign::stated_noise(parameters);
      result.axes            = friction_axes(result.rows);
      result.noise_is_stated = stated > 0.;
      if (result.noise_is_stated)
        for (FrictionAxis &axis : result.axes)
          axis.noise = stated;
      return result;
    }
  } // namespace



  double scatter_over_stated(const std::vector<CampaignTest> &tests)
  {
    std::vector<double> ratios;
    for (const CampaignTest &test : tests)
      if (test.noise_is_stated && test.rows.notes.count("resampled") == 0)
        ratios.push_back(mean_noise(friction_axes(test.rows)) /
                         mean_noise(test.axes));
    return ratios.empty() ? 1. : median(ratios);
  }



  double CampaignTest::root_mean_square(const double *weighted) const
  {
    double sum = 0.;
    for (const FrictionAxis &axis : axes)
      for (std::size_t i = 0; i < rows.time.size(); ++i)
        sum += std::pow(axis.noise * *weighted++, 2);
    return std::sqrt(sum / n_residuals());
  }



  std::vector<fs::path> Campaign::test_files(const Parameters &parameters)
  {
    const std::vector<fs::path> files = named_files(parameters, tests_key);
    if (files.empty())
      parameters.reject(tests_key, "name a folder or files");
    return files;
  }



  std::vector<CampaignTest> Campaign::read_tests(const Parameters &parameters)
  {
    std::vector<MeasuredTest> measured;
    for (const fs::path &file : Campaign::test_files(parameters))
      if (fs::is_directory(file))
        for (MeasuredTest &test : read_test_set(file))
          measured.push_back(std::move(test));
      else
        measured.push_back(read_measured_test(file));
    check_conditions(measured);
    warn_of_oddities(measured);
    double rounding = 0.;
    for (const MeasuredTest &test : measured)
      rounding = std::max(rounding, rounding_of_motion(test));
    std::vector<CampaignTest>           tests;
    std::map<std::size_t, CampaignTest> leaders;
    std::set<fs::path>                  files;
    for (const MeasuredTest &test : measured)
      {
        if (!files.insert(fs::canonical(test.file)).second)
          parameters.reject(tests_key, test.file.string() + " is listed twice");
        const std::size_t leader = leader_of_motion(measured, tests.size());
        if (leaders.count(leader) == 0)
          leaders.emplace(
            leader, prepare(measured[leader], parameters, rounding, nullptr));
        tests.push_back(
          leader == tests.size() ?
            leaders.at(leader) :
            prepare(test, parameters, rounding, &leaders.at(leader).replay));
      }
    share_axes_of_conditions(tests);
    find_rounding(tests);
    keep_noise_visible(tests);
    return tests;
  }



  Campaign::Campaign(const Parameters &parameters)
    : Campaign(parameters, read_tests(parameters))
  {}



  Campaign::Campaign(const Parameters                &parameters,
                     const std::vector<CampaignTest> &tests)
    : Campaign(parameters, read_fit_parameters(parameters), tests)
  {}



  Campaign::Campaign(const Parameters                &parameters,
                     const std::vector<FitParameter> &fitted,
                     const std::vector<CampaignTest> &tests)
    : parameters(parameters)
    , fitted(fitted)
    , derived(read_derived(parameters))
    , tests(tests)
    , search_tolerance(4. * parameters.number("Time stepping/Tolerance"))
  {
    for (const FitParameter &parameter : fitted)
      for (const Derived &tie : derived)
        if (tie.name == parameter.path)
          parameters.reject("Calibration/Derived",
                            tie.name + " is fitted already");
    if (n_residuals() <= fitted.size())
      parameters.reject("Calibration/Parameters",
                        std::to_string(fitted.size()) +
                          " parameters cannot be found from " +
                          std::to_string(n_residuals()) + " rows");
  }



  std::size_t Campaign::n_residuals() const
  {
    return std::accumulate(tests.begin(),
                           tests.end(),
                           std::size_t(0),
                           [](const std::size_t sum, const CampaignTest &test) {
                             return sum + test.n_residuals();
                           });
  }



  std::vector<double> Campaign::scaled_start() const
  {
    std::vector<double> scaled;
    for (const FitParameter &parameter : fitted)
      scaled.push_back(parameter.to_scaled(parameter.start));
    return scaled;
  }
} // namespace SlipStep
