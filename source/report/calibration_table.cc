// SPDX-License-Identifier: LGPL-2.1-or-later

// What the terminal shows at the end of a calibration.

#include <slipstep/report/calibration_report.h>
#include <slipstep/report/calibration_text.h>

#include <slipstep/report/run_results.h>
#include <slipstep/report/text_table.h>
#include <slipstep/utilities/text.h>

namespace SlipStep
{
  namespace
  {
    std::vector<TableLine> short_parameter_lines(const Calibration &calibration)
    {
      std::vector<TableLine> lines = {{"parameter",
                                       "value",
                                       "unit",
                                       interval_name(calibration.confidence),
                                       "start"}};
      for (const FittedParameter &fitted : calibration.parameters)
        lines.push_back(
          {label_of(fitted.parameter),
           (fitted.is_at_bound ? "* " : "") + digits_text(fitted, fitted.value),
           fitted.parameter.unit(),
           interval_text(fitted),
           plain_text(fitted.parameter.in_unit(fitted.parameter.start), 5)});
      return lines;
    }
  } // namespace



  std::string calibration_table(const Calibration &calibration)
  {
    std::string text =
      wrapped_text(calibration_headline(calibration), 2, terminal_width) + "\n";
    if (!calibration.parameters.empty())
      text += text_table(short_parameter_lines(calibration), terminal_width);
    if (any_of(calibration.parameters, [](const FittedParameter &fitted) {
          return fitted.is_at_bound;
        }))
      text += "  * at a bound, or at a condition of the law\n";
    if (!calibration.derived.empty())
      text +=
        "\n" + text_table(derived_lines(calibration, false), terminal_width);
    if (!calibration.tests.empty())
      text += "\n" + text_table(test_lines(calibration, false), terminal_width);
    if (!calibration.weak.empty())
      text += "\n  What these tests hardly determine:\n";
    for (const WeakDirection &direction : calibration.weak)
      {
        std::string words = wrapped_text(direction.words, 4, terminal_width);
        if (words.size() > 2)
          words[2] = '-';
        text += words;
      }
    return text;
  }
} // namespace SlipStep
