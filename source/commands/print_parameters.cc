// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/commands/commands.h>
#include <slipstep/measured_data/import_map.h>
#include <slipstep/commands/case.h>
#include <slipstep/report/parameters_page.h>

#include <iostream>

namespace SlipStep
{
  namespace
  {
    Parameters::Format format_of(const std::string &name)
    {
      return name == "json"   ? Parameters::Format::json :
             name == "schema" ? Parameters::Format::schema :
             name == "keys"   ? Parameters::Format::keys :
             name == "md"     ? Parameters::Format::markdown :
                                Parameters::Format::prm;
    }



    // That a key is one of maps, or of cases.
    std::string where_else(const std::string &name, const bool of_a_map)
    {
      Parameters others;
      if (of_a_map)
        declare_all_parameters(others);
      else
        declare_import_parameters(others);
      try
        {
          others.find(name, "");
        }
      catch (const InputError &)
        {
          return "";
        }
      return of_a_map ?
               "; it is one of cases: slipstep parameters " + name :
               "; it is one of maps: slipstep parameters import " + name;
    }
  } // namespace



  int print_parameters(const CommandLine &line)
  {
    const bool of_a_map = !line.files.empty() && line.files.front() == "import";
    Parameters parameters;
    if (of_a_map)
      declare_import_parameters(parameters);
    else
      declare_all_parameters(parameters);
    apply_settings(line, parameters);
    std::vector<std::string> only;
    for (std::size_t i = of_a_map ? 1 : 0; i < line.files.size(); ++i)
      try
        {
          for (const std::string &path :
               parameters.find(line.files[i].string(), "slipstep parameters"))
            only.push_back(path);
        }
      catch (const InputError &error)
        {
          throw InputError(error.what() +
                           where_else(line.files[i].string(), of_a_map));
        }
    if (line.format == "html")
      std::cout << parameters_page(parameters, only);
    else
      parameters.print(std::cout,
                       format_of(line.format),
                       {},
                       // What is asked for is not put behind "#".
                       of_a_map || !only.empty() ?
                         std::set<std::string>() :
                         inactive_sections(parameters),
                       only);
    return done;
  }
} // namespace SlipStep
