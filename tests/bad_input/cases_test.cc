// SPDX-License-Identifier: LGPL-2.1-or-later

// Every cases/*.prm is wrong in one way. Its first lines say how it is to be
// refused:
//   # expect: a regular expression found in the message (several lines);
//             {here} is file:line of the line marked "# <- here"
//   # command: the commands that refuse it

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <regex>
#include <string>
#include <vector>

#include "slipstep_process.h"

namespace
{
  struct BadCase
  {
    std::filesystem::path    file;
    std::vector<std::string> expected;
    std::vector<std::string> commands    = {"check"};
    unsigned int             marked_line = 0;
  };



  std::ostream &operator<<(std::ostream &out, const BadCase &bad_case)
  {
    return out << bad_case.file.filename();
  }



  BadCase read_case(const std::filesystem::path &file)
  {
    BadCase result;
    result.file = file;
    std::ifstream     in(file);
    const std::string expect = "# expect: ", command = "# command: ";
    unsigned int      n = 0;
    for (std::string line; std::getline(in, line);)
      {
        ++n;
        if (line.compare(0, expect.size(), expect) == 0)
          result.expected.push_back(line.substr(expect.size()));
        if (line.compare(0, command.size(), command) == 0)
          for (const char *name : {"run", "point", "refine"})
            if (line.find(name) != std::string::npos)
              result.commands.push_back(name);
        if (line.find("# <- here") != std::string::npos)
          result.marked_line = n;
      }
    const std::string here = "{here}";
    for (std::string &text : result.expected)
      if (text.find(here) != std::string::npos)
        text.replace(text.find(here),
                     here.size(),
                     file.stem().string() +
                       "\\.prm:" + std::to_string(result.marked_line));
    return result;
  }



  std::vector<BadCase> all_cases()
  {
    std::vector<BadCase> cases;
    for (const auto &entry : std::filesystem::directory_iterator(
           SLIPSTEP_SOURCE_DIR "/tests/bad_input/cases"))
      if (entry.path().extension() == ".prm")
        cases.push_back(read_case(entry.path()));
    std::sort(cases.begin(), cases.end(), [](const auto &a, const auto &b) {
      return a.file < b.file;
    });
    return cases;
  }



  class BadInput : public testing::TestWithParam<BadCase>
  {};
} // namespace



TEST_P(BadInput, IsRefusedInWords)
{
  const BadCase &bad_case = GetParam();
  ASSERT_FALSE(bad_case.expected.empty());
  for (const std::string &command : bad_case.commands)
    {
      SCOPED_TRACE("slipstep " + command);
      const SlipstepProcess process;
      const auto result = process.run({command, bad_case.file.string()});
      EXPECT_EQ(result.exit_code, 2) << result.err;
      EXPECT_EQ(result.out, "");
      EXPECT_GE(result.n_error_lines(), 1u);
      EXPECT_LE(result.n_error_lines(), 3u) << result.err;
      for (const std::string &expected : bad_case.expected)
        EXPECT_TRUE(std::regex_search(result.err, std::regex(expected)))
          << "expected: " << expected << "\n  in: " << result.err;
      EXPECT_TRUE(process.wrote_nothing());
    }
}



INSTANTIATE_TEST_SUITE_P(Case,
                         BadInput,
                         testing::ValuesIn(all_cases()),
                         [](const testing::TestParamInfo<BadCase> &info) {
                           return info.param.file.stem().string();
                         });
