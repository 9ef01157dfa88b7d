// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_commands_new_case_h
#define slipstep_commands_new_case_h

#include <slipstep/diagnosis/diagnosis.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace SlipStep
{
  /// Write all of a case, with the intervals of the parameters as comments
  /// behind their values.
  /// @param head paragraphs of comment at the beginning
  void write_case(const std::filesystem::path           &file,
                  const Parameters                      &the_case,
                  const std::set<std::string>           &inactive_sections,
                  const std::vector<DiagnosedParameter> &parameters = {},
                  const std::vector<std::string>        &head       = {});

  /// Write the case that a calibration or diagnosis came to: as Output/New
  /// cases says, an "include" of the case that it began with and what has
  /// changed, or all there is. It is complete, too, if the short form would not
  /// be read back as the same.
  void write_new_case(const std::filesystem::path           &file,
                      const Parameters                      &the_case,
                      const std::set<std::string>           &inactive_sections,
                      const std::vector<DiagnosedParameter> &parameters = {},
                      const std::vector<std::string>        &head       = {});
} // namespace SlipStep

#endif
