// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_element_tests_h
#define slipstep_diagnosis_element_tests_h

#include <slipstep/diagnosis/diagnosis.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace SlipStep
{
  /// The name and the file of a test.
  using NamedTest = std::pair<std::string, std::filesystem::path>;

  /// Whether "Diagnosis/Element tests" names tests that there are.
  /// @throws InputError otherwise
  void check_element_tests(const Parameters             &parameters,
                           const std::vector<NamedTest> &tests);

  /// Which tests it names, as numbers of Diagnosis::tests, each once.
  std::vector<std::size_t> element_tests(const Parameters &parameters,
                                         const Diagnosis  &diagnosis);
} // namespace SlipStep

#endif
