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



// Tests of an earlier import of the same record would count twice.
TEST(ImportTests, TestsOfAnEarlierImportAreTold)
{
  std::string text = "t,x,mu\n";
  for (int i = 0; i <= 80; ++i)
    text += std::to_string(i) + ',' +
            std::to_string(i % 40 < 20 ? i % 20 : 20 - i % 20) + ',' +
            (i % 40 < 20 ? "0.1\n" : "-0.1\n");
  write("strokes.csv", text);
  const auto import_cut = [](const std::string &cut) {
    CommandLine line;
    line.quiet = true;
    line.files = {write("strokes.prm",
                        "set Raw file/Name = strokes.csv\n"
                        "set Columns/Time = t in s\n"
                        "set Columns/Displacement = x in mm\n"
                        "set Columns/Friction = mu\n"
                        "set Constants/Pressure = 5 MPa\n"
                        "set Selection/Cut = " +
                          cut + "\n")};
    testing::internal::CaptureStderr();
    EXPECT_EQ(import_tests(line), 0);
    return testing::internal::GetCapturedStderr();
  };
  const std::string words = "other test";
  EXPECT_EQ(import_cut("at reversals").find(words), std::string::npos);
  EXPECT_EQ(import_cut("at reversals").find(words), std::string::npos);
  EXPECT_NE(import_cut("none").find("has 4 other tests of the same records"),
            std::string::npos);
}
