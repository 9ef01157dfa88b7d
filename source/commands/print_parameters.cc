// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/commands/print_parameters.h>
#include <slipstep/measured_data/import_map.h>
#include <slipstep/commands/case.h>
#include <slipstep/utilities/exceptions.h>

#include <iostream>

namespace SlipStep
{
  int print_parameters(const CommandLine &line)
  {
    const bool of_a_map = !line.files.empty();
    if (of_a_map && line.files.front() != "import")
      throw InputError("slipstep parameters: \"" + line.files.front().string() +
                       "\" is not known; allowed is: import");
    Parameters parameters;
    if (of_a_map)
      declare_import_parameters(parameters);
    else
      declare_all_parameters(parameters);
    apply_settings(line, parameters);
    parameters.print(std::cout,
                     line.format == "json" ? Parameters::Format::json :
                     line.format == "md"   ? Parameters::Format::markdown :
                                             Parameters::Format::prm,
                     {},
                     of_a_map ? std::set<std::string>() :
                                inactive_sections(parameters));
    return done;
  }
} // namespace SlipStep
