// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/text_table.h>
#include <slipstep/utilities/text.h>

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



// With four decimals friction of 0.0001 had risen by 10 % unseen.
TEST(TextTable, SmallFrictionKeepsItsDigits)
{
  EXPECT_EQ(friction_text(0.1), "0.1000");
  EXPECT_EQ(friction_text(-0.98765), "-0.9877");
  EXPECT_EQ(friction_text(1.007e-4), "0.0001007");
  EXPECT_EQ(friction_text(1e-6), "1e-06");
  EXPECT_EQ(friction_text(-3e-17), "0.0000");
  EXPECT_EQ(friction_text(0.), "0.0000");
}
