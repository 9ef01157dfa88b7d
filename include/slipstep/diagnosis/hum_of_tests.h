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
  /// @param doubt what may be hum and is not taken off, in words; "" without
  std::vector<CampaignTest> without_hum(const std::vector<CampaignTest> &tests,
                                        const Model                     &model,
                                        std::string                     &doubt);

  /// The hum of some tests.
  struct HumOfTests
  {
    bool        is_mains  = false; ///< or of another frequency
    double      frequency = 0.;    ///< [Hz], nominal for the mains
    std::size_t n_told    = 0;     ///< tests in which it was told
    double      share     = 0.;    ///< of friction, the median of these
  };

  /// Frequency 0 without any.
  HumOfTests hum_of(const Comparison                &comparison,
                    const std::vector<CampaignTest> &tests);
} // namespace SlipStep

#endif
