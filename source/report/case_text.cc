// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <slipstep/experiment/point_driver.h>
#include <slipstep/report/diagnosis_text.h>
#include <slipstep/report/case_text.h>

#include <sstream>

namespace SlipStep
{
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
        for (const std::string &line :
             dealii::Utilities::break_text_into_lines(paragraph, 76))
          result += "# " + line + '\n';
      return result + (paragraphs.empty() ? "" : "\n");
    }
  } // namespace



  std::string case_text(const Parameters            &the_case,
                        const std::filesystem::path &folder,
                        const std::set<std::string> &inactive_sections,
                        const std::vector<DiagnosedParameter> &parameters,
                        const std::vector<std::string>        &head)
  {
    // What is off in the starting model may be on here.
    std::set<std::string> inactive = FrictionLaw(the_case).inactive_sections();
    for (const std::string &section : inactive_sections)
      if (section.compare(0, 9, "Friction/") != 0)
        inactive.insert(section);
    std::ostringstream text;
    relocated_case(the_case, folder)
      .print(text, Parameters::Format::prm, inactive);
    return as_comments(head) + with_intervals(text.str(), parameters);
  }



  std::string changes_text(const Parameters                      &begin,
                           const Parameters                      &the_case,
                           const std::string                     &included,
                           const std::filesystem::path           &folder,
                           const std::vector<DiagnosedParameter> &parameters,
                           const std::vector<std::string>        &head)
  {
    std::ostringstream text;
    relocated_case(the_case, folder).print_changes(text, begin);
    return as_comments(head) + "include " + included + "\n\n" +
           with_intervals(text.str(), parameters);
  }
} // namespace SlipStep
