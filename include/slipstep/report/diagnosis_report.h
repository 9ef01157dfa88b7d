// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_diagnosis_report_h
#define slipstep_report_diagnosis_report_h

#include <slipstep/diagnosis/diagnosis.h>

#include <filesystem>
#include <string>
#include <vector>

namespace SlipStep
{
  /// Write diagnosis.json.
  /// @throws RunError if the disk refuses
  void write_diagnosis_json(const std::filesystem::path &file,
                            const Parameters            &parameters,
                            const Diagnosis             &diagnosis);

  /// Write report.html with the pictures inside, and their data and scripts
  /// into `<folder>/report/`. What a reader sees first is what was wrong, what
  /// was missing and how far the gap shrank; then the evidence. Without gnuplot
  /// the curves are missing and the numbers still come.
  /// @return warnings for the user
  std::vector<std::string>
  write_diagnosis_report(const std::filesystem::path &folder,
                         const Parameters            &parameters,
                         const Diagnosis             &diagnosis);
} // namespace SlipStep

#endif
