// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/element_tests.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/nearest_name.h>
#include <slipstep/utilities/text.h>

namespace SlipStep
{
  namespace fs = std::filesystem;

  namespace
  {
    const char *const tests_key = "Diagnosis/Element tests";

    // Whether a test of this name and file is meant.
    bool is_called(const std::string &name,
                   const fs::path    &file,
                   const std::string &wanted)
    {
      return name == wanted || file.filename() == wanted ||
             file.stem() == wanted;
    }
  } // namespace



  void check_element_tests(const Parameters                &parameters,
                           const std::vector<CampaignTest> &tests)
  {
    const std::vector<std::string> list = parameters.list(tests_key);
    if (list.empty())
      parameters.reject(tests_key, "name tests, or write 'worst' or 'none'");
    for (const std::string &name : list)
      {
        if (name == "worst" || name == "none")
          {
            if (list.size() == 1)
              return;
            parameters.reject(tests_key, in_quotes(name) + " stands alone");
          }
        std::vector<std::string> known = {"worst", "none"};
        bool                     found = false;
        for (const CampaignTest &test : tests)
          {
            const fs::path &file = test.rows.file;
            found = found || is_called(test.rows.name, file, name);
            known.push_back(test.rows.name);
            known.push_back(file.filename().string());
          }
        if (!found)
          parameters.reject(tests_key,
                            "there is no test '" + name + "'" +
                              did_you_mean(name, known));
      }
  }



  std::vector<std::size_t> element_tests(const Parameters &parameters,
                                         const Diagnosis  &diagnosis)
  {
    const std::vector<DiagnosedTest> &tests = diagnosis.tests;
    const std::vector<std::string>    list  = parameters.list(tests_key);
    std::vector<std::size_t>          result;
    if (list == std::vector<std::string>{"none"})
      return result;
    if (list == std::vector<std::string>{"worst"})
      {
        for (std::size_t i = 0; i < tests.size(); ++i)
          if (!tests[i].is_outlier &&
              (result.empty() ||
               tests[i].rms_before > tests[result[0]].rms_before))
            result = {i};
        return result;
      }
    for (std::size_t i = 0; i < tests.size(); ++i)
      if (any_of(list, [&](const std::string &name) {
            return is_called(tests[i].name, tests[i].file, name);
          }))
        result.push_back(i);
    return result;
  }
} // namespace SlipStep
