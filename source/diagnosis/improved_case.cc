// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/improved_case.h>

namespace SlipStep
{
  Parameters case_of(const Parameters &start, const Model &model)
  {
    Parameters result = assemble(start, model.parts, model.values()).parameters;
    for (const auto &value : model.values())
      result.set(value.first,
                 quantity_text(result, value.first, value.second, 8),
                 "diagnosis");
    apply_ties(read_derived(result), result);
    result.set("Calibration/Parameters",
               statements(model.campaign->fitted, false),
               "diagnosis");
    return result;
  }
} // namespace SlipStep
