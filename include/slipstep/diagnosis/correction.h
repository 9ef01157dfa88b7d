// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_correction_h
#define slipstep_diagnosis_correction_h

#include <slipstep/diagnosis/verdict.h>

#include <optional>
#include <vector>

namespace SlipStep
{
  struct CorrectedModel : Correction
  {
    Model model;
  };

  /// @return none if it takes away less than half
  std::optional<CorrectedModel>
  find_correction(const Workspace                 &workspace,
                  const Model                     &base,
                  const Judgement                 &judgement,
                  const std::vector<Localisation> &where);
} // namespace SlipStep

#endif
