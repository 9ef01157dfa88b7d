// SPDX-License-Identifier: LGPL-2.1-or-later

// How often a diagnosis is right: many planted campaigns of a class.
//
//   diagnosis_benchmark CLASS FIRST_SEED LAST_SEED [NOISE [FACTOR [TESTS
//   [REPLICATES [EVIDENCE [EFFECT AMPLITUDE | EDITION]]]]]]
//
// prints a line for each campaign; rates.awk makes the table of them. Without
// EVIDENCE (0) intervals, left-out conditions and the next test are not looked
// at, which takes a third of the time. EFFECT is hidden with that AMPLITUDE
// instead of drawn ones; in its place may stand the EDITION of the campaigns.

#include <tests/diagnosis/hidden/trial.h>

#include <cstdlib>
#include <iostream>
#include <string>

namespace
{
  std::string joined(const std::vector<std::string> &names)
  {
    std::string result;
    for (const std::string &name : names)
      result += (result.empty() ? "" : "+") + name;
    return result.empty() ? "-" : result;
  }
} // namespace



int main(int argc, char **argv)
{
  using namespace SlipStep;
  if (argc < 4)
    {
      std::cerr << "usage: " << argv[0]
                << " CLASS FIRST_SEED LAST_SEED [NOISE [FACTOR [TESTS "
                   "[REPLICATES [EVIDENCE [EFFECT AMPLITUDE | EDITION]]]]]]"
                << std::endl;
      return 2;
    }
  Planting::CampaignOptions options;
  options.campaign_class = Planting::campaign_class(argv[1]);
  if (argc > 4)
    options.noise = Planting::noise_kind(argv[4]);
  if (argc > 5)
    options.noise_factor = std::atof(argv[5]);
  if (argc > 6)
    options.n_tests = std::atoi(argv[6]);
  if (argc > 7)
    options.with_replicates = std::atoi(argv[7]) != 0;
  if (argc == 10)
    options.edition = std::atoi(argv[9]);
  if (argc > 10)
    {
      options.effects   = {argv[9]};
      options.amplitude = std::atof(argv[10]);
    }
  const bool with_evidence = argc <= 8 || std::atoi(argv[8]) != 0;
  for (int seed = std::atoi(argv[2]); seed <= std::atoi(argv[3]); ++seed)
    {
      options.seed = seed;
      try
        {
          const Testing::Trial trial =
            Testing::run_trial(options, with_evidence);
          std::cout << argv[1] << ' ' << seed << ' ' << joined(trial.truth)
                    << ' ' << name_of(trial.verdict) << ' '
                    << joined(trial.named) << ' ' << joined(trial.rivals) << ' '
                    << trial.is_alarm() << ' ' << trial.is_exact() << ' '
                    << trial.is_false() << ' ' << trial.holds_truth() << ' '
                    << trial.detectability << ' ' << trial.error_before << ' '
                    << trial.error_after << ' ' << trial.gap_p << ' '
                    << trial.explained_share << ' ' << trial.remainder_p << ' '
                    << trial.cpu_time << ' ' << trial.excess << ' '
                    << trial.remainder << ' ' << trial.n_intervals << ' '
                    << trial.n_inside << ' '
                    << (std::isfinite(trial.left_out_ratio) ?
                          std::to_string(trial.left_out_ratio) :
                          "-")
                    << ' ' << trial.has_next_test << ' ' << trial.is_resolved
                    << ' ' << trial.is_misled << ' ' << joined(trial.completed)
                    << ' ' << trial.is_incomplete << std::endl;
        }
      catch (const std::exception &error)
        {
          std::cout << argv[1] << ' ' << seed << " FAILED " << error.what()
                    << std::endl;
        }
    }
}
