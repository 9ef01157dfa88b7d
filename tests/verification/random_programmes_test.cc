// SPDX-License-Identifier: LGPL-2.1-or-later

// Laws and programmes drawn at random: whatever they are, a run ends, its rows
// make sense, and a smaller tolerance does not change what it says.
//
// SLIPSTEP_RANDOM_PROGRAMMES=1000 makes more of them, or 17:18 those of the
// seeds from 17 to below 18.

#include "random_programme.h"

#include <slipstep/experiment/stability.h>
#include <slipstep/utilities/text.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <stdexcept>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  constexpr std::size_t  most_steps      = 200000;
  constexpr double       usual_tolerance = 5e-4;
  constexpr unsigned int default_number  = 200;

  /// What a run says, and what is wrong with its rows.
  struct OutcomeOfProgramme
  {
    std::vector<std::string> complaints;
    std::size_t              steps         = 0;
    bool                     is_given_up   = false; ///< with a RunError
    bool                     is_endless    = false; ///< too many steps
    double                   peak          = 0.;
    double                   balance_error = 0.;
    HistoryRow               last;
  };

  class RowCheck
  {
  public:
    explicit RowCheck(const FrictionLaw &law)
      : largest_ratio(law.maximum_ratio())
      , coefficients(law.coefficient_range())
    {}

    void operator()(const HistoryRow &row, OutcomeOfProgramme &outcome)
    {
      const double r = row.loading_ratio.mean, r_s = row.normal_ratio.mean,
                   mu   = row.coefficient.mean;
      const auto expect = [&](const bool is_right, const std::string &what) {
        if (is_right || complained[what]++ > 0)
          return;
        std::ostringstream text;
        text.precision(10);
        text << what << " at t = " << row.time << " s (r " << r << ", r_s "
             << r_s << ", mu " << mu << ")";
        outcome.complaints.push_back(text.str());
      };
      expect(std::isfinite(row.friction) && std::isfinite(row.friction_y) &&
               std::isfinite(row.dissipated_energy),
             "not a number");
      expect(r <= largest_ratio * (1. + 1e-12), "r > r_m");
      if (row.pressure > 0.)
        expect(r_s <= std::min(r, 1.) + 1e-12 || !has_subloading, "r_s > r");
      expect(mu >= coefficients[0] * (1. - 1e-9) &&
               mu <= coefficients[1] * (1. + 1e-9),
             "mu out of its range");
      expect(row.dissipated_energy >= dissipated, "dissipated energy falls");
      dissipated = row.dissipated_energy;
    }

    bool has_subloading = false;

  private:
    const double                        largest_ratio;
    const std::array<double, 2>         coefficients;
    double                              dissipated = 0.;
    std::map<std::string, unsigned int> complained;
  };

  OutcomeOfProgramme run(const Settings   &settings,
                         const double      tolerance,
                         const std::size_t steps_allowed)
  {
    Parameters parameters = point_parameters(settings);
    parameters.set("Time stepping/Tolerance", exact_text(tolerance), "test");
    parameters.set("Time stepping/Most steps per statement",
                   std::to_string(steps_allowed),
                   "test");
    const FrictionLaw  law(parameters);
    const Programme    programme = parse_programme(parameters);
    OutcomeOfProgramme outcome;
    RowCheck           check(law);
    for (const std::string &effect : law.effects())
      check.has_subloading = check.has_subloading || effect == "subloading";
    Summary summary;
    try
      {
        drive_point(
          law,
          programme,
          StepControl(parameters, programme, law),
          [&](const HistoryRow &row) {
            if (++outcome.steps > steps_allowed)
              throw std::length_error("does not end");
            check(row, outcome);
            outcome.peak =
              std::max(outcome.peak, std::hypot(row.friction, row.friction_y));
            outcome.last = row;
          },
          Machine(parameters));
      }
    catch (const RunError &)
      {
        outcome.is_given_up = true;
      }
    catch (const std::length_error &)
      {
        outcome.is_endless = true;
      }
    summarise_history({outcome.last}, programme, summary);
    outcome.balance_error = summary.balance_error;
    return outcome;
  }

  /// Whether the contact cannot slide steadily at some speed up to one of the
  /// programme, all of which it goes through. (No law drawn here lacks a steady
  /// state but for an instability.)
  bool is_unstable(const Settings &settings)
  {
    const Parameters     parameters = point_parameters(settings);
    const FrictionLaw    law(parameters);
    const double         stiffness = Machine(parameters).stiffness();
    std::vector<Loading> seen;
    const Programme      programme = parse_programme(parameters);
    for (const Segment &segment : programme.segments())
      {
        const Loading &now = segment.end;
        if (now.velocity.norm() == 0. || now.pressure == 0. ||
            std::any_of(seen.begin(), seen.end(), [&](const Loading &other) {
              return other.pressure == now.pressure &&
                     (other.velocity - now.velocity).norm() <
                       1e-9 * now.velocity.norm();
            }))
          continue;
        seen.push_back(now);
        for (double share = 1.; share > 1e-4; share /= 30.)
          {
            const SteadySliding sliding(law,
                                        share * now.velocity,
                                        now.pressure);
            if (!sliding.exists() || !(sliding.limit(0.).stiffness < stiffness))
              return true;
          }
      }
    return false;
  }

  struct Tally
  {
    unsigned int n = 0, given_up = 0, not_refined = 0, unstable = 0,
                 unbalanced   = 0;
    std::size_t steps         = 0;
    double      worst_balance = 0.;
  };

  void complain(const std::uint64_t    seed,
                const RandomProgramme &programme,
                const std::string     &what)
  {
    ADD_FAILURE() << "seed " << seed << ": " << what << "\n" << programme.prm();
  }

  /// What a run with a smaller tolerance says otherwise; nothing if that is
  /// little.
  std::string sensitivity(const RandomProgramme    &programme,
                          const OutcomeOfProgramme &outcome)
  {
    const OutcomeOfProgramme finer =
      run(programme.settings(), usual_tolerance / 10., 4 * most_steps);
    if (finer.is_given_up)
      return "";
    const double friction =
      std::hypot(finer.last.friction - outcome.last.friction,
                 finer.last.friction_y - outcome.last.friction_y) /
      std::max(finer.peak, 1e-300);
    // A point that hardly slips has little to dissipate.
    const double energy =
      std::abs(finer.last.dissipated_energy - outcome.last.dissipated_energy) /
      std::max(finer.last.dissipated_energy + finer.last.stored_energy, 1e-300);
    std::ostringstream what;
    if (finer.is_endless)
      what << "a smaller tolerance makes it endless";
    else if (!(friction <= 0.01 && energy <= 0.01))
      what << "a smaller tolerance changes friction by " << friction
           << " and energy by " << energy;
    for (const std::string &complaint : finer.complaints)
      what << (what.str().empty() ? "" : ", ") << complaint
           << " with a smaller tolerance";
    return what.str();
  }

  // Sticking and slipping on the nanometres that the contact is elastic for can
  // take any number of steps, and what it ends with is an instant.
  void check(const std::uint64_t seed,
             const std::size_t   steps_refined,
             const std::size_t   steps_allowed,
             Tally              &tally)
  {
    const RandomProgramme    programme(seed);
    const OutcomeOfProgramme outcome =
      run(programme.settings(), usual_tolerance, steps_allowed);
    ++tally.n;
    tally.steps += outcome.steps;
    for (const std::string &complaint : outcome.complaints)
      complain(seed, programme, complaint);
    if (outcome.is_given_up)
      {
        ++tally.given_up;
        return;
      }
    if (outcome.steps > steps_refined && !outcome.is_endless)
      {
        ++tally.not_refined;
        return;
      }
    const std::string what =
      outcome.is_endless ? "does not end" : sensitivity(programme, outcome);
    if (!what.empty() && is_unstable(programme.settings()))
      ++tally.unstable;
    else if (!what.empty())
      complain(seed, programme, what);
    else if (outcome.balance_error > 0.01)
      {
        ++tally.unbalanced;
        tally.worst_balance =
          std::max(tally.worst_balance, outcome.balance_error);
      }
  }
} // namespace



TEST(RandomProgrammes, end_and_make_sense)
{
  std::uint64_t first = 0, end = default_number;
  // A run of more steps is not made again with a smaller tolerance.
  std::size_t steps_refined = 5000, steps_allowed = 20000;
  if (const char *text = std::getenv("SLIPSTEP_RANDOM_PROGRAMMES"))
    {
      steps_refined           = most_steps;
      steps_allowed           = most_steps;
      const std::string range = text;
      const std::size_t colon = range.find(':');
      first = colon == std::string::npos ? 0 : std::stoul(range);
      end   = std::stoul(colon == std::string::npos ? range :
                                                    range.substr(colon + 1));
    }
  Tally tally;
  for (std::uint64_t seed = first; seed < end; ++seed)
    check(seed, steps_refined, steps_allowed, tally);
  std::printf(
    "%u programmes, %zu steps; given up: %u; not refined: %u; "
    "unstable: %u; energy out of balance by more than 1 %%: %u, at most "
    "by %.1f %%\n",
    tally.n,
    tally.steps,
    tally.given_up,
    tally.not_refined,
    tally.unstable,
    tally.unbalanced,
    100. * tally.worst_balance);
}
