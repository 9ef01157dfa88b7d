// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_page_h
#define slipstep_report_page_h

#include <slipstep/report/figure.h>
#include <slipstep/report/text_table.h>
#include <slipstep/utilities/parameters.h>

#include <string>
#include <vector>

namespace SlipStep
{
  /// A page complete in itself: style, heading, content, and the program's
  /// version at its end.
  /// @param title,headline plain text
  /// @param content HTML
  std::string html_page(const std::string &title,
                        const std::string &headline,
                        const std::string &content);

  /// What "Report/Title" says, or else the name of the case.
  std::string title_of(const Parameters &parameters);

  std::string heading(const std::string &text);

  /// Small grey text; of none nothing.
  std::string note(const std::string &text);

  /// How to come to the same page again, by a command that reads one case.
  std::string repeat_section(const std::string &command,
                             const Parameters  &parameters);

  /// Something that the reader has to know first.
  std::string problem_box(const std::string &text);

  /// A table, the first line being its head.
  /// @param kind style: "numbers", with "unbroken" also of long cells, or "values"
  std::string html_table(const std::vector<TableLine> &lines,
                         const std::string            &kind = "numbers");

  /// A picture with heading and caption.
  std::string figure_element(const Picture &picture);
} // namespace SlipStep

#endif
