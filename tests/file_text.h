// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_file_text_h
#define tests_file_text_h

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

/// All that a file holds.
inline std::string content(const std::filesystem::path &file)
{
  std::ifstream     in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Tells both where it is not as expected.
inline testing::AssertionResult contains(const std::string &text,
                                         const std::string &part)
{
  return text.find(part) != std::string::npos ?
           testing::AssertionSuccess() << "\"" << part << "\" is in: " << text :
           testing::AssertionFailure()
             << "\"" << part << "\" is not in: " << text;
}

/// How often a part stands in a text.
inline std::size_t count(const std::string &text, const std::string &part)
{
  std::size_t n = 0;
  for (auto at = text.find(part); at != std::string::npos;
       at      = text.find(part, at + 1))
    ++n;
  return n;
}

inline bool has_gnuplot()
{
  return std::system("gnuplot --version > /dev/null 2>&1") == 0;
}

#endif
