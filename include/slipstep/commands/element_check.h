// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_commands_element_check_h
#define slipstep_commands_element_check_h

#include <slipstep/diagnosis/diagnosis.h>

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace SlipStep
{
  /// A case to be simulated with finite elements, and where to.
  struct ElementJob
  {
    std::string           label;
    std::filesystem::path case_file;
    std::filesystem::path output;
  };

  /// Simulates cases with finite elements. A job that fails leaves no
  /// history.csv.
  using ElementRunner = std::function<void(const std::vector<ElementJob> &)>;

  /// Simulate tests with the block, before and after, and compare.
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
