#ifndef slipstep_experiment_report_html_h
#define slipstep_experiment_report_html_h

#include <slipstep/experiment/report_figures.h>

#include <string>
#include <vector>

namespace SlipStep
{
  using TableLine = std::vector<std::string>;

  /// A table, the first line being its head.
  /// @param kind style: "numbers" or "values"
  std::string html_table(const std::vector<TableLine> &lines,
                         const std::string            &kind = "numbers");

  /// A picture with heading and caption.
  std::string figure_element(const Picture &picture);
} // namespace SlipStep

#endif
