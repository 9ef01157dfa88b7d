// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_run_law_h
#define slipstep_report_run_law_h

#include <slipstep/report/run_figures.h>
#include <slipstep/report/text_table.h>

namespace SlipStep
{
  /// The law at work, as HTML: friction, the variables of the law and what its
  /// effects remember, one below the other over the path of the drive. What
  /// stays the same all along is said in words.
  std::string law_at_work(const RunFigures &figures);

  /// The active effects of all runs with formulas, and their parameters with
  /// symbols, values in base units, and units. Where variants differ, all their
  /// values are named.
  std::vector<TableLine> effect_table(const RunFigures &figures);
} // namespace SlipStep

#endif
