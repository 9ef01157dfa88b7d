// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_element_tests_h
#define slipstep_diagnosis_element_tests_h

#include <slipstep/calibration/campaign.h>
#include <slipstep/diagnosis/diagnosis.h>

#include <vector>

namespace SlipStep
{
  /// Whether "Diagnosis/Element tests" names tests that there are.
  /// @throws InputError otherwise
  void check_element_tests(const Parameters                &parameters,
                           const std::vector<CampaignTest> &tests);

  /// Which tests it names, as numbers of Diagnosis::tests, each once.
  std::vector<std::size_t> element_tests(const Parameters &parameters,
                                         const Diagnosis  &diagnosis);
} // namespace SlipStep

#endif
