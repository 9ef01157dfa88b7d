// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_commands_run_block_h
#define slipstep_commands_run_block_h

#include <slipstep/experiment/run_options.h>
#include <slipstep/experiment/summary.h>

namespace SlipStep
{
  /// `slipstep run`: the block through its programme, with all its files.
  /// Called by all ranks; rank 0 writes.
  /// @return the summary, with status "failed" and the reason if the programme
  ///   could not be finished; what was computed is kept
  Summary run_block(const Parameters &parameters, const RunOptions &options);
} // namespace SlipStep

#endif
