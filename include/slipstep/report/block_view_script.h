// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_block_view_script_h
#define slipstep_report_block_view_script_h

namespace SlipStep
{
  /// JavaScript that draws the block of the element which it stands in, from
  /// the JSON in the first script element there.
  extern const char *const block_view_script;
} // namespace SlipStep

#endif
