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

  /// The tree of sections that a list of paths spans; sections in the order in
  /// which they were first met.
  struct ParameterSection
  {
    std::string                   name; ///< "" for the whole
    std::string                   path;
    std::vector<PrintedParameter> parameters;
    std::vector<ParameterSection> subsections;
  };

  ParameterSection
  parameter_tree(const std::vector<PrintedParameter> &parameters);

  /// A .prm file which Parameters::read() reads back, with some sections
  /// disabled by a "#" before each of their lines.
  void print_prm(std::ostream                &out,
                 const ParameterSection      &root,
                 const std::vector<Variant>  &variants,
                 const std::set<std::string> &disabled_sections);

  /// The same without explanations.
  void print_settings(std::ostream &out, const ParameterSection &root);

  /// Nested objects; a parameter is {value, default, documentation, allowed}.
  void print_json(std::ostream &out, const ParameterSection &root);

  /// A JSON schema (draft-07) of such objects with values alone, for forms and
  /// programs that write cases.
  void print_schema(std::ostream &out, const ParameterSection &root);

  /// A heading and a table (key, default, allowed, meaning) per section.
  void print_markdown(std::ostream &out, const ParameterSection &root);
} // namespace SlipStep

#endif
