// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/text_table.h>

#include <gtest/gtest.h>

using namespace SlipStep;

TEST(TextTable, ColumnsAreAlignedByCharactersNotBytes)
{
  EXPECT_EQ(text_table({{"name", "µ"}, {"größer", "1.25"}, {"a", ""}}),
            "  name        µ\n"
            "  -------------\n"
            "  größer   1.25\n"
            "  a\n");
}



TEST(TextTable, NamesThatAreTooLongLoseTheirBeginning)
{
  EXPECT_EQ(text_table({{"name", "x"}, {"sehr/größer/Rate", "12"}}, 20),
            "  name             x\n"
            "  ------------------\n"
            "  …/größer/Rate   12\n");
  // Numbers are never cut.
  EXPECT_EQ(text_table({{"name", "x"}, {"abcdefghijkl", "1234567890"}}, 10),
            "  name                x\n"
            "  ---------------------\n"
            "  …fghijkl   1234567890\n");
}



TEST(TextTable, TextIsCutBetweenCharacters)
{
  EXPECT_EQ(cut_text("µµµµ", 4), "µµµµ");
  EXPECT_EQ(cut_text("µµµµ", 3), "µµ…");
}



TEST(TextTable, TextIsBrokenBetweenWords)
{
  EXPECT_EQ(wrapped_text("one two µµµµ four", 2, 10),
            "  one two\n  µµµµ\n  four\n");
  EXPECT_EQ(wrapped_text("unbreakable", 2, 5), "  unbreakable\n");
  EXPECT_EQ(wrapped_text("", 2, 5), "");
}
