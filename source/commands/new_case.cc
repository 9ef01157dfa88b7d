// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/commands/case.h>
#include <slipstep/commands/new_case.h>
#include <slipstep/experiment/point_driver.h>
#include <slipstep/report/case_text.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/paths.h>
#include <slipstep/utilities/write_file.h>

namespace SlipStep
{
  namespace fs = std::filesystem;

  namespace
  {
    bool is_read_as(const fs::path &file, const Parameters &the_case)
    {
      try
        {
          Parameters written = declared_parameters();
          written.read(file);
          return written.variants().empty() && written.has_values_of(the_case);
        }
      catch (const InputError &)
        {
          return false;
        }
    }
  } // namespace



  void write_new_case(const fs::path                        &file,
                      const Parameters                      &the_case,
                      const std::set<std::string>           &inactive_sections,
                      const std::vector<DiagnosedParameter> &parameters,
                      const std::vector<std::string>        &head)
  {
    const fs::path folder = file.parent_path();
    if (the_case.text("Output/New cases") == "changes")
      {
        Parameters begin = declared_parameters();
        begin.read(the_case.case_file());
        write_file(file,
                   changes_text(begin,
                                the_case,
                                path_from(folder, the_case.case_file()),
                                folder,
                                parameters,
                                head));
        if (is_read_as(file, relocated_case(the_case, folder)))
          return;
      }
    write_file(
      file, case_text(the_case, folder, inactive_sections, parameters, head));
  }
} // namespace SlipStep
