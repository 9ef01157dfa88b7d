// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/commands/commands.h>
#include <slipstep/measured_data/test_set.h>
#include <slipstep/utilities/exceptions.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/temporary_folder.h"

using namespace SlipStep;

namespace
{
  namespace fs = std::filesystem;

  fs::path write(const std::string &name, const std::string &text)
  {
    std::ofstream(test_folder() / name, std::ios::binary) << text;
    return test_folder() / name;
  }
} // namespace



TEST(ImportTests, VariantsConvertAFolderAndNothingIsWrittenIfOneFails)
{
  const std::string head = "t,x,mu\n0,0,0\n";
  write("a.csv", head + "1,1,0.1\n");
  write("b.csv", head + "1,3,0.1\n");
  const auto map_file = [](const std::string &condition_of_b) {
    return write("import.prm",
                 "set Columns/Time = t in s\nset Columns/Displacement = x in "
                 "mm\nset Columns/Friction = mu\nset Constants/Pressure = 5 "
                 "MPa\nsubsection Variants\n  subsection first\n"
                 "    set Raw file/Name = a.csv\n    set Test/Condition = dry\n"
                 "  end\n  subsection second\n    set Raw file/Name = b.csv\n"
                 "    set Test/Condition = " +
                   condition_of_b + "\n  end\nend\n");
  };
  CommandLine line;
  line.quiet = true;
  line.files = {map_file("dry")};
  EXPECT_THROW(import_tests(line), InputError);
  EXPECT_FALSE(fs::exists(test_folder() / "measured"));

  line.files = {map_file("dry, faster")};
  EXPECT_EQ(import_tests(line), 0);
  const auto tests = read_test_set(test_folder() / "measured");
  ASSERT_EQ(tests.size(), 2u);
  EXPECT_EQ(tests[0].file.filename(), "first.csv");
  EXPECT_EQ(tests[1].condition, "dry, faster");
}
