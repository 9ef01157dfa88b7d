// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_diagnosis_parameters_h
#define slipstep_diagnosis_diagnosis_parameters_h

#include <slipstep/utilities/parameters.h>

#include <chrono>

namespace SlipStep
{
  /// Declares section "Diagnosis".
  void declare_diagnosis_parameters(Parameters &parameters);

  /// Read section "Diagnosis" without computing.
  /// @throws InputError
  void check_diagnosis_parameters(const Parameters &parameters);

  /// When a share of `Diagnosis/Most time` is over, from now on.
  std::chrono::steady_clock::time_point
  deadline_of(const Parameters &parameters, const double share = 1.);
} // namespace SlipStep

#endif
