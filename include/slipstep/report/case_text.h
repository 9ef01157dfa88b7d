// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_case_text_h
#define slipstep_report_case_text_h

#include <slipstep/diagnosis/diagnosis.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace SlipStep
{
  /// The text of a case for a file in @p folder, with the intervals of the
  /// parameters as comments behind their values.
  /// @param head lines of comment at the beginning
  std::string case_text(const Parameters            &the_case,
                        const std::filesystem::path &folder,
                        const std::set<std::string> &inactive_sections,
                        const std::vector<DiagnosedParameter> &parameters = {},
                        const std::vector<std::string>        &head       = {});

  /// The same as an "include" and what has other values than in @p begin.
  /// @param included the case file of @p begin, as to be written
  std::string changes_text(const Parameters                      &begin,
                           const Parameters                      &the_case,
                           const std::string                     &included,
                           const std::filesystem::path           &folder,
                           const std::vector<DiagnosedParameter> &parameters,
                           const std::vector<std::string>        &head);
} // namespace SlipStep

#endif
