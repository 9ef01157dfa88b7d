// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_commands_run_point_h
#define slipstep_commands_run_point_h

#include <slipstep/experiment/run_options.h>
#include <slipstep/experiment/summary.h>

namespace SlipStep
{
  /// `slipstep point`: the case on one contact point, with all its files.
  Summary run_point(const Parameters &parameters, const RunOptions &options);
} // namespace SlipStep

#endif
