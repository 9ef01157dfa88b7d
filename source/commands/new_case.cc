// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <slipstep/commands/case.h>
#include <slipstep/commands/new_case.h>
#include <slipstep/experiment/point_driver.h>
#include <slipstep/friction/law.h>
#include <slipstep/report/diagnosis_report.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/paths.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/write_file.h>

#include <sstream>

namespace SlipStep
{
  namespace fs = std::filesystem;

  namespace
  {
    // Behind "set Key = value" of the paths named.
    std::string
    with_intervals(const std::string                     &text,
                   const std::vector<DiagnosedParameter> &parameters)
    {
      std::istringstream       in(text);
      std::ostringstream       out;
      std::vector<std::string> sections;
      std::string              line;
      while (std::getline(in, line))
        {
          const std::string words = dealii::Utilities::trim(line);
          if (words.compare(0, 11, "subsection ") == 0)
            sections.push_back(words.substr(11));
          else if (words == "end" && !sections.empty())
            sections.pop_back();
          else if (words.compare(0, 4, "set ") == 0)
            {
              std::string path;
              for (const std::string &section : sections)
                path += section + "/";
              path +=
                dealii::Utilities::trim(words.substr(4, words.find('=') - 4));
              for (const DiagnosedParameter &parameter : parameters)
                if (parameter.path == path)
                  line += "   # 95 % interval: " + interval_text(parameter) +
                          (parameter.unit.empty() ? "" : " ") + parameter.unit;
            }
          out << line << '\n';
        }
      return out.str();
    }



    std::string as_comments(const std::vector<std::string> &paragraphs)
    {
      std::string result;
      for (const std::string &paragraph : paragraphs)
        result += commented(paragraph);
      return result + (paragraphs.empty() ? "" : "\n");
    }



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



  void write_case(const fs::path                        &file,
                  const Parameters                      &the_case,
                  const std::set<std::string>           &inactive_sections,
                  const std::vector<DiagnosedParameter> &parameters,
                  const std::vector<std::string>        &head)
  {
    // What is off in the starting model may be on here.
    std::set<std::string> inactive = FrictionLaw(the_case).inactive_sections();
    for (const std::string &section : inactive_sections)
      if (section.compare(0, 9, "Friction/") != 0)
        inactive.insert(section);
    std::ostringstream text;
    relocated_case(the_case, file.parent_path())
      .print(text, Parameters::Format::prm, inactive);
    write_file(file,
               as_comments(head) + with_intervals(text.str(), parameters));
  }



  void write_new_case(const fs::path                        &file,
                      const Parameters                      &the_case,
                      const std::set<std::string>           &inactive_sections,
                      const std::vector<DiagnosedParameter> &parameters,
                      const std::vector<std::string>        &head)
  {
    if (the_case.text("Output/New cases") == "changes")
      {
        const fs::path   folder    = file.parent_path();
        const Parameters relocated = relocated_case(the_case, folder);
        Parameters       begin     = declared_parameters();
        begin.read(the_case.case_file());
        std::ostringstream text;
        relocated.print_changes(text, begin);
        write_file(file,
                   as_comments(head) + "include " +
                     path_from(folder, the_case.case_file()) + "\n\n" +
                     with_intervals(text.str(), parameters));
        if (is_read_as(file, relocated))
          return;
      }
    write_case(file, the_case, inactive_sections, parameters, head);
  }
} // namespace SlipStep
