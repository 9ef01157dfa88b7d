// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <slipstep/experiment/run_options.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/paths.h>

namespace SlipStep
{
  void declare_output_parameters(Parameters &parameters)
  {
    parameters.declare(
      "Output/Directory",
      "output/{case}",
      dealii::Patterns::Anything(),
      "Folder of the results, relative to the working directory; {case} is the "
      "name of the .prm file. In it each variant of a sweep has a folder of "
      "its own, and so has each command other than 'slipstep run', such as "
      "output/case/point. It is created; an existing one must be empty or hold "
      "earlier results of the same command, which are overwritten. The option "
      "--output takes precedence over this key and names the folder itself.");
    parameters.declare(
      "Output/New cases",
      "changes",
      dealii::Patterns::Selection("changes|complete"),
      "What 'slipstep calibrate' and 'slipstep diagnose' write into fitted.prm "
      "and improved.prm: 'changes', an include of this case and the values "
      "that differ, or 'complete', all values, so that the file can be moved "
      "anywhere.");
  }



  std::filesystem::path output_folder(const Parameters &parameters)
  {
    const std::string name =
      dealii::Utilities::replace_in_string(parameters.text("Output/Directory"),
                                           "{case}",
                                           parameters.case_file().stem());
    if (name.find_first_of("{}") != std::string::npos)
      parameters.reject("Output/Directory",
                        "in braces there can only be {case}");
    if (name.empty())
      parameters.reject("Output/Directory", "the name of a folder is needed");
    return with_home(name).lexically_normal();
  }
} // namespace SlipStep
