// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_correction_h
#define slipstep_diagnosis_correction_h

#include <slipstep/diagnosis/verdict.h>

#include <optional>
#include <string>
#include <vector>

namespace SlipStep
{
  /// The free-form correction of one covariate, cause unknown.
  struct Correction
  {
    std::string covariate, formula;
    Model       model;
    double      share = 0.; ///< of the excess that it takes away
  };

  /// @return none if it takes away less than half
  std::optional<Correction>
  find_correction(const Workspace                 &workspace,
                  const Model                     &base,
                  const Judgement                 &judgement,
                  const std::vector<Localisation> &where);
} // namespace SlipStep

#endif
