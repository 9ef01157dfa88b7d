// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_parameter_printer_h
#define slipstep_utilities_parameter_printer_h

#include <slipstep/utilities/parameters.h>

#include <ostream>
#include <string>
#include <vector>

namespace SlipStep
{
  /// A parameter and its present value.
  struct PrintedParameter
  {
    Parameters::Entry entry;
    std::string       value;
  };

  /// Write parameters, sections in the order in which they are first met. A
  /// .prm file is what Parameters::read() reads back, with some sections
  /// disabled by a
  /// "#" before each of their lines. In JSON, objects are nested, and a
  /// parameter is {value, default, documentation, allowed}; a JSON schema
  /// (draft-07) is of such objects with values alone, for forms and programs
  /// that write cases. Markdown has a heading and a table per section.
  void print_parameters(std::ostream                        &out,
                        const Parameters::Format             format,
                        const std::vector<PrintedParameter> &parameters,
                        const std::vector<Variant>          &variants,
                        const std::set<std::string>         &disabled_sections);

  /// As a .prm file without explanations.
  void print_settings(std::ostream                        &out,
                      const std::vector<PrintedParameter> &parameters);
} // namespace SlipStep

#endif
