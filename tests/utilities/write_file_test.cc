// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/write_file.h>

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/temporary_folder.h"

using namespace SlipStep;

TEST(WriteFile, ReplacesWhatWasThereAndLeavesNothingBeside)
{
  const auto file = test_folder() / "file.txt";
  write_file(file, "a longer text");
  write_file(file, "short\n");
  std::ifstream     in(file, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(content, "short\n");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(test_folder()),
                          std::filesystem::directory_iterator()),
            1);
}



TEST(WriteFile, ARefusalNamesTheFileAndKeepsTheOldOne)
{
  const auto absent = test_folder() / "absent" / "file.txt";
  try
    {
      write_file(absent, "text");
      FAIL();
    }
  catch (const RunError &error)
    {
      EXPECT_EQ(std::string(error.what()).find(absent.string()), 0u);
    }
  // A folder cannot be replaced by a file.
  std::filesystem::create_directory(test_folder() / "folder");
  EXPECT_THROW(write_file(test_folder() / "folder", "text"), RunError);
  EXPECT_FALSE(std::filesystem::exists(test_folder() / "folder.part"));
}
