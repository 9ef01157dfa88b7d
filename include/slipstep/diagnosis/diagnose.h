// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_diagnose_h
#define slipstep_diagnosis_diagnose_h

#include <slipstep/diagnosis/diagnosis.h>
#include <slipstep/diagnosis/ingest.h>

namespace SlipStep
{
  /// What was found, and the cases to go on with.
  struct DiagnosedCase
  {
    Diagnosis  diagnosis;
    Parameters before; ///< the calibrated case
    Parameters after;  ///< with what was missing
  };

  /// Find where a case and its measured tests disagree, name what is missing,
  /// add it, and see the gap shrink; all on the contact point.
  /// @throws InputError for anything wrong with case or tests, RunError if the
  /// starting model cannot be simulated
  DiagnosedCase diagnose(const Parameters &parameters, const Stage &stage);
} // namespace SlipStep

#endif
