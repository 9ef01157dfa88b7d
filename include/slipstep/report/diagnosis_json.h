// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_diagnosis_json_h
#define slipstep_report_diagnosis_json_h

#include <slipstep/diagnosis/diagnosis.h>

#include <filesystem>

namespace SlipStep
{
  /// Write diagnosis.json.
  /// @throws RunError if the disk refuses
  void write_diagnosis_json(const std::filesystem::path &file,
                            const Parameters            &parameters,
                            const Diagnosis             &diagnosis);
} // namespace SlipStep

#endif
