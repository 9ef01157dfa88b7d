// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_temporary_folder_h
#define tests_temporary_folder_h

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

/// A new folder, gone with its owner.
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::string pattern =
      (std::filesystem::temp_directory_path() / "slipstep_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
      throw std::runtime_error("no temporary folder");
    folder = pattern;
  }

  ~TemporaryFolder()
  {
    std::error_code error;
    std::filesystem::remove_all(folder, error);
  }

  TemporaryFolder(const TemporaryFolder &)            = delete;
  TemporaryFolder &operator=(const TemporaryFolder &) = delete;

  const std::filesystem::path &path() const
  {
    return folder;
  }

private:
  std::filesystem::path folder;
};



/// The folder of the test that is running. No other test has it: ctest runs
/// several at a time, each in a process of its own.
inline std::filesystem::path test_folder()
{
  static const TemporaryFolder root;
  const testing::TestInfo     *test =
    testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(test->test_suite_name()) + "." + test->name();
  for (char &c : name)
    if (c == '/')
      c = '_';
  std::filesystem::create_directories(root.path() / name);
  return root.path() / name;
}

#endif
