// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/paths.h>

#include <gtest/gtest.h>

using SlipStep::path_from;



TEST(PathFrom, IsRelativeUnlessOnlyTheRootIsCommon)
{
  EXPECT_EQ(path_from("/nowhere/out/a", "/nowhere/cases/b.prm"),
            "../../cases/b.prm");
  EXPECT_EQ(path_from("/nowhere/out", "/nowhere/out/b.prm"), "b.prm");
  EXPECT_EQ(path_from("/nowhere/out/", "/elsewhere/../nowhere/./b.prm"),
            "../b.prm");
  EXPECT_EQ(path_from("/nowhere/out", "/elsewhere/b.prm"), "/elsewhere/b.prm");
  EXPECT_EQ(path_from("/", "/elsewhere/b.prm"), "/elsewhere/b.prm");
  // Both from the working directory.
  EXPECT_EQ(path_from("no such folder/a", "b.prm"), "../../b.prm");
}
