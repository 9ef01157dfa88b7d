#ifndef slipstep_report_report_html_h
#define slipstep_report_report_html_h

#include <slipstep/report/report_figures.h>
#include <slipstep/report/text_table.h>

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
