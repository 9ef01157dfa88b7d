// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/parallel.h>

#include <slipstep/calibration/campaign.h>
#include <slipstep/measured_data/rounded_motion.h>
#include <slipstep/measured_data/resample.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/measured_data/test_set.h>
#include <slipstep/utilities/pattern_words.h>
#include <slipstep/utilities/process.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <numeric>
#include <set>
#include <sstream>

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
      "or files separated by commas, relative to the folder of the case. "
      "'slipstep check' reads them.");
    parameters.declare(
      "Calibration/Parameters",
      "",
      AnythingWithWords({"from", "to", "start", "log", "linear"}),
      "What is to be found, separated by ';': '<path of a key> from <least "
      "value> to <largest value> [start <value>] [log|linear]'. The start is "
      "the case's own value unless stated. The scale is logarithmic if the "
      "bounds are positive and a factor of ten or more apart. All other keys "
      "stay as the case has them.");
    parameters.declare(
      "Calibration/Derived",
      "",
      Anything(),
      "Quantities of the parameters, separated by ';': '<name> = <formula>', "
      "where {path of a key} stands for its value in mm, s, N, MPa, degC, rad. "
      "A name that is itself the path of a key ties this key to the others: it "
      "follows them in the fit.");
    parameters.declare(
      noise_key,
      "estimated",
      AnythingWithWords({"estimated"}),
      "Standard deviation of the measured friction coefficient, by which "
      "differences are weighted: 'estimated' from the second differences of "
      "each record, or a number greater than 0. A comment '# noise: 0.002' in a "
      "test goes before.");
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



  namespace
  {
    double noted_noise(const MeasuredTest &test)
    {
      const auto note = test.notes.find("noise");
      if (note == test.notes.end())
        return 0.;
      const Quantity noise(Dimension::number, 0., 1e30, true);
      if (!noise.match(note->second))
        throw InputError(test.file.string() + ": noise: " + note->second +
                         ": " + noise.why_not(note->second) +
                         "; it must be a number greater than 0");
      return noise.value(note->second);
    }



    double estimated_noise(const MeasuredTest &test)
    {
      return std::max(noise_level(test.friction),
                      test.friction_y.empty() ? 0. :
                                                noise_level(test.friction_y));
    }



    // A record without visible noise, filtered or generated, must not outweigh
    // all others: an estimate counts at least a ten-thousandth of the friction
    // and a tenth of what is usual among the tests.
    void keep_noise_visible(std::vector<CampaignTest> &tests)
    {
      std::vector<double> estimates;
      for (const CampaignTest &test : tests)
        estimates.push_back(test.noise);
      for (CampaignTest &test : tests)
        {
          double largest = 0.;
          for (const auto *values :
               {&test.rows.friction, &test.rows.friction_y})
            for (const double value : *values)
              largest = std::max(largest, std::abs(value));
          if (largest == 0.)
            throw InputError(test.rows.file.string() +
                             ": the friction is zero throughout");
          const double least =
            std::max(1e-4 * largest, 0.1 * median(estimates));
          if (test.noise_is_stated || test.noise >= least)
            continue;
          test.noise = least;
          std::ostringstream warning;
          warning << test.rows.file.string()
                  << ": hardly any noise is visible; " << std::setprecision(2)
                  << least
                  << " is taken, unless a line '# noise: ...' says more.";
          test.rows.warnings.push_back(warning.str());
        }
    }



    // By which the load point moves before the contact slides.
    double elastic_slip(const MeasuredTest &test, const Parameters &parameters)
    {
      const FrictionLaw law(parameters);
      const double traction = law.static_coefficient() * median(test.pressure);
      return traction / law.tangential_stiffness() +
             traction / Machine(parameters).stiffness();
    }



    CampaignTest prepare(const MeasuredTest &measured,
                         const Parameters   &parameters)
    {
      // Stairs of more make the contact stick and slip in each; what is less is
      // not felt.
      constexpr double stick_share = 0.1;

      MeasuredTest test = measured;
      double       step = rounding_of_motion(test);
      if (step > 0. && step > stick_share * elastic_slip(test, parameters))
        undo_rounding_of_motion(test);
      else
        step = 0.;
      const double             skip  = parameters.number(skip_key);
      const double             begin = test.time.front() + skip;
      std::vector<std::size_t> rows;
      // The first row of all is where both begin.
      for (std::size_t i = 0; i < test.time.size(); ++i)
        if (test.time[i] >= begin)
          rows.push_back(i);
      if (rows.size() < 2)
        parameters.reject(
          skip_key,
          "nothing is left of " + test.file.string() + ", which takes " +
            std::to_string(test.time.back() - test.time.front()) + " s");
      // Nearly the least, but for a few stamps that are next to each other.
      std::vector<double> distances;
      for (std::size_t i = 1; i < rows.size(); ++i)
        distances.push_back(test.time[rows[i]] - test.time[rows[i - 1]]);
      std::sort(distances.begin(), distances.end());
      const double    row_distance = distances[distances.size() / 20];
      ResampleOptions options;
      options.motion_step = step;
      CampaignTest result{test,
                          0.,
                          false,
                          Replay(resample(test, options).test,
                                 parameters.number("Calibration/Lead-in"),
                                 row_distance)};
      keep_rows(result.rows, rows);
      result.motion_step = step;
      const double noted = noted_noise(test);
      const double stated =
        noted > 0. ? noted : Campaign::stated_noise(parameters);
      result.noise_is_stated = stated > 0.;
      result.noise =
        result.noise_is_stated ? stated : estimated_noise(result.rows);
      return result;
    }
  } // namespace



  std::vector<fs::path> Campaign::test_files(const Parameters &parameters)
  {
    std::vector<fs::path> files;
    for (const std::string &name : parameters.list(tests_key))
      {
        const fs::path  file = parameters.resolve(name);
        std::error_code error;
        if (!fs::exists(file, error))
          parameters.reject(tests_key,
                            "there is no " + excerpt(file.string(), 300));
        files.push_back(file);
      }
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
    warn_of_copies(measured);
    std::vector<CampaignTest> tests;
    std::set<fs::path>        files;
    for (const MeasuredTest &test : measured)
      {
        if (!files.insert(fs::canonical(test.file)).second)
          parameters.reject(tests_key, test.file.string() + " is listed twice");
        tests.push_back(prepare(test, parameters));
      }
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



  std::vector<std::string> Campaign::warnings() const
  {
    std::vector<std::string> result;
    for (const CampaignTest &test : tests)
      result.insert(result.end(),
                    test.rows.warnings.begin(),
                    test.rows.warnings.end());
    return result;
  }



  namespace
  {
    Replay::Curve at_rows(const Replay       &replay,
                          const FrictionLaw  &law,
                          const Machine      &machine,
                          const CampaignTest &test)
    {
      Replay::Curve curve;
      replay.simulate(law, machine, curve);
      curve.friction = replay.at(curve.friction, test.rows.time);
      if (test.has_two_axes())
        curve.friction_y = replay.at(curve.friction_y, test.rows.time);
      else
        curve.friction_y.clear();
      return curve;
    }



    void plan_test(Replay             &replay,
                   const CampaignTest &test,
                   const FrictionLaw  &law,
                   const Machine      &machine,
                   const double        tolerance,
                   const std::size_t   most_steps = Replay::most_steps)
    {
      try
        {
          replay.plan(law, machine, tolerance, most_steps);
        }
      catch (const RunError &error)
        {
          throw RunError(test.rows.file.string() +
                         " cannot be simulated: " + error.what());
        }
    }



    // y = y + factor x
    void add(const double               factor,
             const std::vector<double> &x,
             std::vector<double>       &y)
    {
      for (std::size_t i = 0; i < x.size(); ++i)
        y[i] += factor * x[i];
    }



    void add(const double factor, const Replay::Curve &x, Replay::Curve &y)
    {
      add(factor, x.friction, y.friction);
      add(factor, x.friction_y, y.friction_y);
    }
  } // namespace



  void throw_if_stopped()
  {
    if (SignalGuard::caught() != 0)
      throw RunError(SignalGuard::in_words() + "; nothing was written");
  }



  void side_by_side(const std::size_t                             n,
                    const std::function<void(const std::size_t)> &work)
  {
    dealii::parallel::apply_to_subranges(
      std::size_t(0),
      n,
      [&](const std::size_t begin, const std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          {
            throw_if_stopped();
            try
              {
                work(i);
              }
            catch (const RunError &)
              {
                // A signal is no trouble of the test that it met.
                throw_if_stopped();
                throw;
              }
          }
      },
      1);
  }



  Simulator::Simulator(const Campaign &campaign)
    : campaign(campaign)
    , parameters(campaign.parameters)
  {
    for (const CampaignTest &test : campaign.tests)
      replays.push_back(test.replay);
  }



  const Parameters &Simulator::with(const std::vector<double> &scaled)
  {
    for (std::size_t i = 0; i < scaled.size(); ++i)
      {
        const FitParameter &parameter = campaign.fitted[i];
        parameters.set(parameter.path,
                       parameter.text(parameter.from_scaled(scaled[i]), 17),
                       "calibration");
      }
    apply_ties(campaign.derived, parameters);
    return parameters;
  }



  namespace
  {
    // "calibration: path = value: must not ... (1.23)" without the numbers.
    std::string condition_in(const std::string &refusal)
    {
      const std::size_t begin =
        std::min(refusal.find(": ") + 2, refusal.size());
      const std::size_t sign  = refusal.find(" = ", begin);
      const std::size_t value = refusal.find(": ", sign);
      if (sign == std::string::npos || value == std::string::npos)
        return refusal;
      std::string       why  = refusal.substr(value + 2);
      const std::size_t open = why.find(" ("), close = why.find(')');
      if (open < close && close != std::string::npos)
        why.erase(open, close + 1 - open);
      return refusal.substr(begin, sign - begin) + " " + why;
    }
  } // namespace



  std::string Simulator::condition_beside(const std::vector<double> &scaled,
                                          const std::size_t          parameter,
                                          const double               direction)
  {
    constexpr double beside = 1e-4;

    std::vector<double> other = scaled;
    other[parameter] += direction * beside;
    try
      {
        const FrictionLaw law(with(other));
      }
    catch (const InputError &error)
      {
        return condition_in(error.what());
      }
    return "";
  }



  void Simulator::plan(const std::vector<double> &scaled, const Simulator *like)
  {
    constexpr std::size_t times_more = 5, least = 500;

    const FrictionLaw law(with(scaled));
    const Machine     machine(parameters);
    corrections.clear();
    side_by_side(replays.size(), [&](const std::size_t i) {
      plan_test(replays[i],
                campaign.tests[i],
                law,
                machine,
                campaign.search_tolerance,
                like == nullptr ?
                  std::numeric_limits<std::size_t>::max() :
                  least + times_more * like->replays[i].n_steps());
    });
    ++n_done;
  }



  Replay::Curve Simulator::simulate(const std::vector<double> &scaled,
                                    const std::size_t          test)
  {
    const FrictionLaw law(with(scaled));
    Replay::Curve     curve =
      at_rows(replays[test], law, Machine(parameters), campaign.tests[test]);
    if (!corrections.empty())
      add(1., corrections[test], curve);
    return curve;
  }



  // Richardson's extrapolation from fine steps and halved fine steps.
  void Simulator::correct(const std::vector<double> &scaled, const double share)
  {
    const FrictionLaw law(with(scaled));
    const Machine     machine(parameters);
    // The steps shrink with the root of the tolerance.
    const double times_more = 10. / std::sqrt(share);
    corrections.clear();
    std::vector<Replay::Curve> found(replays.size());
    side_by_side(replays.size(), [&](const std::size_t i) {
      const CampaignTest &test = campaign.tests[i];
      Replay              fine = replays[i];
      plan_test(fine,
                test,
                law,
                machine,
                share * campaign.search_tolerance,
                static_cast<std::size_t>(times_more *
                                         (100. + replays[i].n_steps())));
      found[i] = at_rows(fine.halved(), law, machine, test);
      // Of second order: (4 halved - fine) / 3.
      add(1. / 3., found[i], found[i]);
      add(-1. / 3., at_rows(fine, law, machine, test), found[i]);
      add(-1., at_rows(replays[i], law, machine, test), found[i]);
    });
    corrections = std::move(found);
    ++n_done;
  }



  void Simulator::correct_by(Simulator                 &reference,
                             const std::vector<double> &reference_scaled)
  {
    const Parameters &parameters = reference.with(reference_scaled);
    const FrictionLaw law(parameters);
    const Machine     machine(parameters);
    corrections.resize(replays.size());
    side_by_side(replays.size(), [&](const std::size_t i) {
      const CampaignTest &test = campaign.tests[i];
      corrections[i] = at_rows(reference.replays[i], law, machine, test);
      if (!reference.corrections.empty())
        add(1., reference.corrections[i], corrections[i]);
      add(-1., at_rows(replays[i], law, machine, test), corrections[i]);
    });
    ++n_done;
  }



  void Simulator::leave_out(const std::vector<bool> &left_out)
  {
    is_left_out = left_out;
  }



  void Simulator::residuals(const std::vector<double> &scaled, double *result)
  {
    const FrictionLaw     law(with(scaled));
    const Machine         machine(parameters);
    std::vector<double *> place;
    for (const CampaignTest &test : campaign.tests)
      {
        place.push_back(result);
        result += test.n_residuals();
      }
    side_by_side(replays.size(), [&](const std::size_t i) {
      const CampaignTest &test = campaign.tests[i];
      if (!is_left_out.empty() && is_left_out[i])
        {
          std::fill_n(place[i], test.n_residuals(), 0.);
          return;
        }
      Replay::Curve curve = at_rows(replays[i], law, machine, test);
      if (!corrections.empty())
        add(1., corrections[i], curve);
      double *out = place[i];
      for (std::size_t row = 0; row < curve.friction.size(); ++row)
        *out++ = (curve.friction[row] - test.rows.friction[row]) / test.noise;
      for (std::size_t row = 0; row < curve.friction_y.size(); ++row)
        *out++ =
          (curve.friction_y[row] - test.rows.friction_y[row]) / test.noise;
    });
    ++n_done;
  }



  double Simulator::misfit(const std::vector<double> &scaled)
  {
    std::vector<double> values(campaign.n_residuals());
    residuals(scaled, values.data());
    return std::inner_product(values.begin(), values.end(), values.begin(), 0.);
  }



  // To the side where there is room and the law takes the values.
  void Simulator::derivatives(const std::vector<double>       &scaled,
                              const std::vector<unsigned int> &columns,
                              const double                    *at,
                              double                          *result)
  {
    constexpr double  difference = 1e-5;
    const std::size_t n          = campaign.n_residuals();
    shifted.resize(n);
    const auto shift = [&](const unsigned int column, const double step) {
      std::vector<double> other = scaled;
      other[column] += step;
      residuals(other, shifted.data());
    };
    for (std::size_t c = 0; c < columns.size(); ++c)
      {
        double step =
          scaled[columns[c]] + difference > 1. ? -difference : difference;
        try
          {
            shift(columns[c], step);
          }
        catch (const InputError &)
          {
            step = -step;
            shift(columns[c], step);
          }
        for (std::size_t row = 0; row < n; ++row)
          result[row * columns.size() + c] = (shifted[row] - at[row]) / step;
      }
  }



  std::size_t Simulator::n_steps() const
  {
    return std::accumulate(replays.begin(),
                           replays.end(),
                           std::size_t(0),
                           [](const std::size_t sum, const Replay &replay) {
                             return sum + replay.n_steps();
                           });
  }
} // namespace SlipStep
