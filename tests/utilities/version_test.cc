// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/version.h>

#include <gtest/gtest.h>

#include <regex>
#include <string>

using namespace SlipStep;



TEST(Version, HasThreeNumbers)
{
  EXPECT_TRUE(std::regex_match(version(), std::regex("\\d+\\.\\d+\\.\\d+")));
}



TEST(Version, NamesACommitOrSaysUnknown)
{
  EXPECT_TRUE(
    std::regex_match(git_hash(), std::regex("[0-9a-f]{12}(-dirty)?|unknown")))
    << git_hash();
}
