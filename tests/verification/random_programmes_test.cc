// Laws and programmes drawn at random: whatever they are, a run ends, its rows
// make sense, and a smaller tolerance does not change what it says.
//
// SLIPSTEP_RANDOM_PROGRAMMES=1000 makes more of them, or 17:18 those of the
// seeds from 17 to below 18.

#include "random_programme.h"

#include <slipstep/experiment/stability.h>

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
  constexpr std::size_t  most_steps        = 200000;
  constexpr double       default_tolerance = 5e-5;
  constexpr unsigned int default_number    = 200;

  /// What a run says, and what is wrong with its rows.
  struct Outcome
  {
    std::vector<std::string> complaints;
    std::size_t              steps         = 0;
    bool                     is_given_up   = false; ///< with a RunError
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

    void operator()(const HistoryRow &row, Outcome &outcome)
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

  Outcome run(const Settings &settings, const double tolerance)
  {
    Parameters parameters = point_parameters(settings);
    parameters.set("Time stepping/Tolerance", exact_text(tolerance), "test");
    const FrictionLaw law(parameters);
    const Programme   programme = parse_programme(parameters);
    Outcome           outcome;
    RowCheck          check(law);
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
            if (++outcome.steps > most_steps)
              throw std::length_error("more steps than allowed");
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
        outcome.complaints.push_back("does not end");
      }
    summarise_history({outcome.last}, programme, summary);
    outcome.balance_error = summary.balance_error;
    return outcome;
  }

  /// Whether the contact cannot slide steadily at some speed up to one of the
  /// programme, all of which it goes through.
  bool is_unstable(const Settings &settings)
  {
    const Parameters  parameters = point_parameters(settings);
    const FrictionLaw law(parameters);
    const double      stiffness = Machine(parameters).stiffness();
    for (const Segment &segment : parse_programme(parameters).segments())
      if (segment.end.velocity.norm() > 0. && segment.end.pressure > 0.)
        for (double share = 1.; share > 1e-7; share /= 10.)
          {
            const SteadySliding sliding(law,
                                        share * segment.end.velocity,
                                        segment.end.pressure);
            if (sliding.exists() && !(sliding.limit(0.).stiffness < stiffness))
              return true;
          }
    return false;
  }

  struct Tally
  {
    unsigned int n = 0, given_up = 0, unstable = 0, unbalanced = 0,
                 sensitive = 0;
    std::size_t steps      = 0;
  };

  void complain(const std::uint64_t    seed,
                const RandomProgramme &programme,
                const std::string     &what)
  {
    ADD_FAILURE() << "seed " << seed << ": " << what << "\n" << programme.prm();
  }

  void check_sensitivity(const std::uint64_t    seed,
                         const RandomProgramme &programme,
                         const Outcome         &outcome,
                         Tally                 &tally)
  {
    const Outcome finer = run(programme.settings(), default_tolerance / 10.);
    if (finer.is_given_up)
      return;
    const double friction =
      std::hypot(finer.last.friction - outcome.last.friction,
                 finer.last.friction_y - outcome.last.friction_y) /
      std::max(finer.peak, 1e-300);
    const double energy =
      std::abs(finer.last.dissipated_energy - outcome.last.dissipated_energy) /
      std::max(finer.last.dissipated_energy, 1e-300);
    if (finer.complaints.empty() && friction <= 0.01 && energy <= 0.01)
      return;
    if (is_unstable(programme.settings()))
      {
        ++tally.unstable;
        return;
      }
    ++tally.sensitive;
    std::ostringstream what;
    what << "a smaller tolerance changes friction by " << friction
         << " and energy by " << energy;
    for (const std::string &complaint : finer.complaints)
      what << ", " << complaint;
    complain(seed, programme, what.str());
  }

  void check(const std::uint64_t seed, Tally &tally)
  {
    const RandomProgramme programme(seed);
    const Outcome outcome = run(programme.settings(), default_tolerance);
    ++tally.n;
    tally.steps += outcome.steps;
    for (const std::string &complaint : outcome.complaints)
      complain(seed, programme, complaint);
    if (outcome.is_given_up)
      {
        ++tally.given_up;
        return;
      }
    if (outcome.balance_error > 0.01)
      ++tally.unbalanced;
    if (outcome.complaints.empty())
      check_sensitivity(seed, programme, outcome, tally);
  }
} // namespace



TEST(RandomProgrammes, end_and_make_sense)
{
  std::uint64_t first = 0, end = default_number;
  if (const char *text = std::getenv("SLIPSTEP_RANDOM_PROGRAMMES"))
    {
      const std::string range = text;
      const std::size_t colon = range.find(':');
      first = colon == std::string::npos ? 0 : std::stoul(range);
      end   = std::stoul(colon == std::string::npos ? range :
                                                    range.substr(colon + 1));
    }
  Tally tally;
  for (std::uint64_t seed = first; seed < end; ++seed)
    check(seed, tally);
  std::printf(
    "%u programmes, %zu steps; given up: %u; energy out of balance by "
    "more than 1 %%: %u; unstable: %u; sensitive: %u\n",
    tally.n,
    tally.steps,
    tally.given_up,
    tally.unbalanced,
    tally.unstable,
    tally.sensitive);
}
