// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <slipstep/calibration/advice.h>
#include <slipstep/calibration/fit.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/measured_data/test_set.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace SlipStep
{
  namespace
  {
    // Above this standard deviation along it, a direction is weak.
    constexpr double weak_deviation = 0.3;

    // Share of a parameter's variance that makes it a member of a direction.
    constexpr double member_share = 0.5;

    // Few digits, but no exponents where people write none.
    std::string rounded(const double value, const int n_digits = 2)
    {
      const double size = std::abs(value);
      // What is rounded up to it has an exponent, too.
      if (!(size >= 0.99 * std::pow(10., n_digits) && size < 1e6))
        return short_text(value, n_digits);
      const double unit =
        std::pow(10., std::floor(std::log10(size)) + 1. - n_digits);
      return fixed_text(unit * std::round(value / unit), 0);
    }



    std::string speed_in_words(const double speed)
    {
      return rounded(60. * speed) + " mm/min";
    }



    // ------------------------------------------------------ proposed tests

    // What the campaign's tests were like.
    struct Conditions
    {
      double slowest = std::numeric_limits<double>::infinity(); ///< [mm/s]
      double fastest = 0.;
      double lowest  = std::numeric_limits<double>::infinity(); ///< [MPa]
      double highest = 0.;
      double longest = 0.; ///< path [mm]
    };



    Conditions conditions_of(const Campaign &campaign)
    {
      Conditions result;
      for (const CampaignTest &test : campaign.tests)
        {
          const MeasuredTest &rows  = test.rows;
          const double        speed = mean_speed(rows);
          if (speed > 0.)
            {
              result.slowest = std::min(result.slowest, speed);
              result.fastest = std::max(result.fastest, speed);
            }
          const double pressure = typical_pressure(rows);
          result.lowest         = std::min(result.lowest, pressure);
          result.highest        = std::max(result.highest, pressure);
          result.longest        = std::max(result.longest,
                                    std::hypot(range_of(rows.displacement),
                                               range_of(rows.displacement_y)));
        }
      return result;
    }



    constexpr int rows_of_slide = 100;



    /// A motion and the programme that says the same.
    class Motion
    {
    public:
      explicit Motion(const double pressure)
        : pressure(pressure)
      {
        add(0., 0., 0.);
        programme << "press " << pressure << " MPa in 1 s";
      }

      /// A negative length goes back.
      void
      slide(const double speed, const double length, const double angle = 0.)
      {
        // Dense at the beginning, where stick ends.
        constexpr int n = rows_of_slide;
        const double  t = test.time.back(), u = test.displacement.back();
        const double  v = test.displacement_y.back();
        const double  c = std::cos(angle * dealii::numbers::PI / 180.);
        const double  s = std::sin(angle * dealii::numbers::PI / 180.);
        for (int i = 1; i <= n; ++i)
          {
            const double share = std::pow(static_cast<double>(i) / n, 3.);
            add(t + share * std::abs(length) / speed,
                u + share * length * c,
                v + share * length * s);
          }
        programme << "; slide " << (length < 0. ? "-" : "")
                  << rounded(60. * speed, 4) << " mm/min for "
                  << rounded(std::abs(length), 4) << " mm";
        if (angle != 0.)
          programme << " at " << angle << " deg";
      }

      void rest(const double time)
      {
        add(test.time.back() + time,
            test.displacement.back(),
            test.displacement_y.back());
        programme << "; hold " << rounded(time, 6) << " s";
      }

      void press(const double new_pressure, const double time)
      {
        pressure = new_pressure;
        add(test.time.back() + time,
            test.displacement.back(),
            test.displacement_y.back());
        programme << "; press " << rounded(new_pressure, 4) << " MPa in "
                  << rounded(time) << " s";
      }

      ProposedTest called(const std::string &words)
      {
        // One axis is enough where there is nothing along the other.
        if (range_of(test.displacement_y) == 0.)
          test.displacement_y.clear();
        else
          test.friction_y.assign(test.friction.size(), 0.);
        return {words, test, programme.str(), 1.};
      }

    private:
      void add(const double time, const double x, const double y)
      {
        test.time.push_back(time);
        test.displacement.push_back(x);
        test.displacement_y.push_back(y);
        test.pressure.push_back(pressure);
        test.friction.push_back(0.);
      }

      MeasuredTest       test;
      double             pressure;
      std::ostringstream programme;
    };



    ProposedTest proposed_slide(const std::string &words,
                                const double       speed,
                                const double       pressure,
                                const double       length,
                                const double       angle = 0.)
    {
      Motion motion(pressure);
      motion.slide(speed, length, angle);
      return motion.called(words);
    }



    // More than one thing happens in these.
    void propose_changes(const Conditions          &now,
                         const double               middle,
                         std::vector<ProposedTest> &result)
    {
      const double half = now.longest / 2.;
      for (const double rest : {10., 1000., 1e5})
        {
          Motion motion(now.highest);
          motion.slide(middle, half);
          motion.rest(rest);
          motion.slide(middle, half);
          result.push_back(motion.called("a rest of " + rounded(rest, 6) +
                                         " s between two slides"));
        }
      {
        Motion motion(now.highest);
        motion.slide(middle, half);
        motion.slide(middle, -half);
        result.push_back(motion.called("a reversal"));
      }
      {
        Motion motion(now.highest);
        for (const double speed :
             {now.slowest, middle, now.fastest, middle, now.slowest})
          motion.slide(speed, now.longest / 5.);
        result.push_back(motion.called("steps of the speed, up and down"));
      }
      {
        Motion motion(now.highest);
        motion.slide(middle, now.longest / 3.);
        motion.press(now.lowest < 0.9 * now.highest ? now.lowest :
                                                      now.highest / 4.,
                     1.);
        motion.slide(middle, now.longest / 3.);
        motion.press(now.highest, 1.);
        motion.slide(middle, now.longest / 3.);
        result.push_back(motion.called("steps of the pressure within a slide"));
      }
      for (const double angle : {45., 90.})
        result.push_back(
          proposed_slide("sliding at " + rounded(angle) + " degrees",
                         middle,
                         now.highest,
                         now.longest,
                         angle));
    }
  } // namespace



  std::vector<ProposedTest> propose_tests(const Campaign &campaign)
  {
    const Conditions          now = conditions_of(campaign);
    std::vector<ProposedTest> result;
    if (!(now.fastest > 0.) || !(now.longest > 0.))
      return result;
    const double middle = std::sqrt(now.slowest * now.fastest);
    const auto   beyond = [&](ProposedTest test, const double factor) {
      test.reach = factor > 1. ? factor : 1. / factor;
      result.push_back(test);
    };
    for (const double factor : {0.1, 0.01, 0.001})
      beyond(proposed_slide("sliding at " +
                              speed_in_words(factor * now.slowest),
                            factor * now.slowest,
                            now.highest,
                            now.longest),
             factor);
    for (const double factor : {10., 100.})
      beyond(proposed_slide("sliding at " +
                              speed_in_words(factor * now.fastest),
                            factor * now.fastest,
                            now.highest,
                            now.longest),
             factor);
    for (const double factor : {3., 10.})
      beyond(proposed_slide("sliding for " + rounded(factor * now.longest) +
                              " mm",
                            middle,
                            now.highest,
                            factor * now.longest),
             factor);
    for (const double pressure : {now.lowest / 3., 3. * now.highest})
      beyond(proposed_slide("sliding under " + rounded(pressure) + " MPa",
                            middle,
                            pressure,
                            now.longest),
             3.);
    propose_changes(now, middle, result);
    return result;
  }



  namespace
  {
    // ----------------------------------------------------- weak directions

    // How far the friction changes along one unit of a direction in a proposed
    // test: sum of squares over the noise of the campaign.
    double information(Simulator             &simulator,
                       const Linearisation   &optimum,
                       const Eigen::VectorXd &direction,
                       const ProposedTest    &proposed)
    {
      const auto shifted = [&](const double step) {
        std::vector<double> scaled = optimum.scaled;
        for (std::size_t i = 0; i < scaled.size(); ++i)
          scaled[i] += step * direction(i) / optimum.size[i];
        return scaled;
      };
      // Away from a bound; all of the direction, or it is another one.
      const auto is_outside = [&](const double step) {
        const std::vector<double> scaled = shifted(step);
        return any_of(scaled, [](const double x) { return x < 0. || x > 1.; });
      };
      const CampaignTest &like = simulator.campaign.tests.front();
      Replay              replay(proposed.motion);
      constexpr double    least = 1e-3;
      const double        ahead = is_outside(least) ? 0. : least;
      const double        back  = is_outside(-least) ? 0. : least;
      if (ahead + back == 0.)
        return 0.;
      const Parameters &middle = simulator.with(optimum.scaled);
      replay.plan(FrictionLaw(middle),
                  Machine(middle),
                  simulator.campaign.search_tolerance,
                  Replay::most_steps_of_imagined_test);
      const auto friction = [&](const double step) {
        const Parameters &parameters = simulator.with(shifted(step));
        Replay::Curve     curve;
        replay.simulate(FrictionLaw(parameters), Machine(parameters), curve);
        return replay.at(curve.friction, proposed.motion.time);
      };
      const std::vector<double> a = friction(ahead), b = friction(-back);
      double                    sum = 0.;
      for (std::size_t i = 0; i < a.size(); ++i)
        sum +=
          std::pow((a[i] - b[i]) / ((ahead + back) * like.axes[0].noise), 2);
      // Of as many rows for each, or what has more of them would seem to tell
      // more.
      return sum * rows_of_slide / a.size();
    }



    bool touches_bound(const Linearisation   &optimum,
                       const Eigen::VectorXd &direction)
    {
      constexpr double near = 0.01;

      for (Eigen::Index i = 0; i < direction.size(); ++i)
        if (direction(i) != 0. &&
            std::abs(optimum.scaled[i] - 0.5) > 0.5 - near)
          return true;
      return false;
    }



    // What would tell more of a direction, in words.
    std::string best_test(Simulator                       &simulator,
                          const Linearisation             &optimum,
                          const Eigen::Index               which,
                          const std::vector<ProposedTest> &proposed)
    {
      Eigen::VectorXd direction = optimum.directions.col(which);
      for (Eigen::Index i = 0; i < direction.size(); ++i)
        if (!optimum.has_part_in(i, which))
          direction(i) = 0.;
      const double before      = optimum.bounded_deviations(which);
      double       best        = before;
      unsigned int n_simulated = 0;
      std::string  words;
      for (const ProposedTest &test : proposed)
        {
          const double gained = if_possible([&]() {
            const double found =
              information(simulator, optimum, direction, test);
            ++n_simulated;
            return found;
          });
          const double after =
            1. / std::sqrt(1. / (before * before) + gained / optimum.inflation);
          if (after < 0.9 * best)
            {
              best  = after;
              words = test.words;
            }
        }
      if (words.empty() && n_simulated > proposed.size() / 2)
        {
          // Where a parameter ends at a bound, its effect may be gone, and says
          // nothing of other speeds.
          const Conditions now           = conditions_of(simulator.campaign);
          const bool       has_one_speed = now.fastest < 1.2 * now.slowest;
          return has_one_speed && touches_bound(optimum, direction) ?
                   "; all tests have about the same speed: tests at other "
                   "speeds may help" :
                   "; no other speed, pressure, path, rest or direction would "
                   "help";
        }
      if (best > 0.5 * before)
        return "";
      return "; " + words +
             " would bring the standard deviation down by a factor of " +
             rounded(before / best);
    }



    // Parameters that fit nearly as well, as far along a direction as there
    // are any: one is moved, the others follow.
    // @return the changes, in natural terms; 0 if none was found
    Eigen::VectorXd
    companion(Simulator                                  &simulator,
              const Linearisation                        &optimum,
              const Eigen::Index                          which,
              const std::chrono::steady_clock::time_point deadline)
    {
      constexpr double          nearly    = 4.; // two standard deviations
      constexpr unsigned int    most      = 8;
      const Eigen::VectorXd     direction = optimum.directions.col(which);
      std::vector<unsigned int> others;
      Eigen::Index              moved = 0;
      direction.cwiseAbs().maxCoeff(&moved);
      for (unsigned int i = 0; i < optimum.scaled.size(); ++i)
        if (i != moved)
          others.push_back(i);
      double step = optimum.bounded_deviations(which);
      for (unsigned int trial = 0; trial < most; ++trial, step *= 0.5)
        for (const int sign : {1, -1})
          {
            std::vector<double> scaled = optimum.scaled;
            for (std::size_t i = 0; i < scaled.size(); ++i)
              scaled[i] += sign * step * direction(i) / optimum.size[i];
            if (scaled[moved] < 0. || scaled[moved] > 1. ||
                std::chrono::steady_clock::now() > deadline)
              continue;
            for (double &value : scaled)
              value = std::clamp(value, 0., 1.);
            const auto found = if_possible([&]() -> std::optional<FitResult> {
              return fit(simulator, scaled, others, 0, deadline);
            });
            if (!found.has_value() ||
                found->misfit > optimum.misfit + nearly * optimum.inflation)
              continue;
            Eigen::VectorXd change(scaled.size());
            for (std::size_t i = 0; i < scaled.size(); ++i)
              change(i) =
                (found->scaled[i] - optimum.scaled[i]) * optimum.size[i];
            return change;
          }
      return Eigen::VectorXd::Zero(direction.size());
    }



    std::string change_in_words(const FitParameter &parameter,
                                const double        change)
    {
      if (parameter.is_logarithmic)
        {
          const double factor = std::exp(std::abs(change));
          return parameter.name + (change > 0. ? " times " : " divided by ") +
                 (factor > 1e6 ? "any factor" :
                                 rounded(factor, factor < 1.2 ? 3 : 2));
        }
      return parameter.name + (change > 0. ? " plus " : " minus ") +
             parameter.text(std::abs(change), 2);
    }



    std::string words_of(const WeakDirection &weak, const Campaign &campaign)
    {
      std::vector<std::string> names, changes;
      for (const std::size_t i : weak.members)
        {
          names.push_back(campaign.fitted[i].path);
          changes.push_back(
            change_in_words(campaign.fitted[i], weak.change[i]));
        }
      // Where nothing was found to fit, no values are told.
      const bool has_values =
        any_of(weak.change, [](const double x) { return x != 0.; });
      if (weak.members.size() == 1)
        return names[0] + " is hardly determined by these tests" +
               (has_values ? ": " + changes[0] + " fits nearly as well" : "") +
               ". Fix it";
      return list_text(names) + " cannot " +
             (names.size() == 2 ? "both" : "all") +
             " be found from these tests" +
             (has_values ? ": " + list_text(changes) + " fit nearly as well" :
                           "") +
             ". Fix one of them";
    }
  } // namespace



  std::vector<WeakDirection>
  find_weak_directions(Simulator                                  &simulator,
                       const Linearisation                        &optimum,
                       const std::chrono::steady_clock::time_point deadline)
  {
    const Campaign                 &campaign = simulator.campaign;
    const std::vector<ProposedTest> proposed = propose_tests(campaign);
    std::vector<WeakDirection>      result;
    for (Eigen::Index k = 0; k < optimum.direction_deviations.size(); ++k)
      {
        const double deviation = optimum.direction_deviations(k);
        if (deviation < weak_deviation)
          continue;
        const Eigen::VectorXd change =
          companion(simulator, optimum, k, deadline);
        WeakDirection weak;
        for (std::size_t i = 0; i < campaign.fitted.size(); ++i)
          {
            // x is the logarithm, or the value over its size.
            weak.change.push_back(
              campaign.fitted[i].is_logarithmic ?
                change(i) :
                change(i) / optimum.size[i] *
                  (campaign.fitted[i].upper - campaign.fitted[i].lower));
            const double natural =
              optimum.bounded_deviations(k) * optimum.directions(i, k);
            const double all = optimum.directions.row(i)
                                 .transpose()
                                 .cwiseProduct(optimum.bounded_deviations)
                                 .squaredNorm();
            if (optimum.has_part_in(i, k) &&
                natural * natural > member_share * all)
              weak.members.push_back(i);
          }
        // One of them has to be what is weak, and not only in company.
        if (none_of(weak.members, [&](const std::size_t i) {
              return std::abs(deviation * optimum.directions(i, k)) >
                     0.5 * weak_deviation;
            }))
          continue;
        weak.words = words_of(weak, campaign) +
                     best_test(simulator, optimum, k, proposed) + ".";
        result.push_back(weak);
      }
    return result;
  }



  void check_influence(const Campaign &campaign)
  {
    // In units of the noise.
    constexpr double  least = 0.01;
    Simulator         simulator(campaign);
    const auto        start = campaign.scaled_start();
    const std::size_t n     = campaign.n_residuals();
    simulator.plan(start);
    std::vector<double> at(n), other(n);
    simulator.residuals(start, at.data());
    for (std::size_t i = 0; i < campaign.fitted.size(); ++i)
      {
        double change = 0.;
        for (const double value : {1., 0., 0.75, 0.25, 0.5})
          {
            std::vector<double> scaled = start;
            scaled[i]                  = value;
            try
              {
                simulator.residuals(scaled, other.data());
              }
            catch (const InputError &)
              {
                continue;
              }
            for (std::size_t row = 0; row < n; ++row)
              change = std::max(change, std::abs(other[row] - at[row]));
            if (change > least)
              break;
          }
        if (change <= least)
          campaign.parameters.reject(
            "Calibration/Parameters",
            campaign.fitted[i].path +
              " has no influence on these tests: between its bounds, with the "
              "start values of all others, the friction changes by less than a "
              "hundredth of the noise");
      }
  }
} // namespace SlipStep
