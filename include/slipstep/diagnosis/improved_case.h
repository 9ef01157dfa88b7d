// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_improved_case_h
#define slipstep_diagnosis_improved_case_h

#include <slipstep/diagnosis/comparison.h>

namespace SlipStep
{
  /// The case with a model's effects and fitted values, which `run` and `point`
  /// take as it is.
  Parameters case_of(const Parameters &start, const Model &model);
} // namespace SlipStep

#endif
