// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_text_table_h
#define slipstep_report_text_table_h

#include <string>
#include <vector>

namespace SlipStep
{
  using TableLine = std::vector<std::string>;

  /// Length in characters, not bytes.
  std::size_t text_width(const std::string &text);

  /// Text that ends with an ellipsis if it is wider than that.
  std::string cut_text(const std::string &text, const std::size_t widest);

  /// Characters in a line of what the terminal shows.
  constexpr std::size_t terminal_width = 100;

  /// A table for the terminal, the first line being its head. The first column
  /// holds names; the others are aligned to the right.
  /// @param widest number of characters in a line beyond which names are cut
  std::string text_table(const std::vector<TableLine> &lines,
                         const std::size_t             widest = -1);

  /// Text broken between words into indented lines.
  std::string wrapped_text(const std::string &text,
                           const std::size_t  indent,
                           const std::size_t  widest);
} // namespace SlipStep

#endif
