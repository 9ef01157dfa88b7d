// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_hum_of_tests_h
#define slipstep_diagnosis_hum_of_tests_h

#include <slipstep/diagnosis/comparison.h>

#include <string>
#include <vector>

namespace SlipStep
{
  /// The tests with the hum of the mains taken off their friction, and the
  /// noise of what is left; empty if there is no hum in them. See
  /// find_mains_hum().
  /// @param model fitted to the tests
  std::vector<CampaignTest> without_hum(const std::vector<CampaignTest> &tests,
                                        const Model                     &model);

  /// Frequency [Hz] of the hum of some tests, and how many tests it was told in
  /// and as what share of their friction: least, median, most.
  struct HumOfTests
  {
    double      frequency = 0.;
    std::size_t n_told    = 0;
    double      least = 0., share = 0., most = 0.;
  };

  /// Frequency 0 without a hum.
  HumOfTests hum_of(const Comparison                &comparison,
                    const std::vector<CampaignTest> &tests);
} // namespace SlipStep

#endif
