#ifndef slipstep_diagnosis_element_check_h
#define slipstep_diagnosis_element_check_h

#include <slipstep/diagnosis/diagnose.h>
#include <slipstep/diagnosis/diagnosis.h>

#include <filesystem>
#include <set>
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

  /// Simulate these tests with the block, before and after, and compare.
  /// @param folder for its cases and results
  std::vector<ElementCheck>
  check_with_elements(const Parameters               &before,
                      const Parameters               &after,
                      const Diagnosis                &diagnosis,
                      const std::vector<std::size_t> &tests,
                      const std::filesystem::path    &folder,
                      const std::set<std::string>    &inactive_sections,
                      const ElementRunner            &runner);
} // namespace SlipStep

#endif
