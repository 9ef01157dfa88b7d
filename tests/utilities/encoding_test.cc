// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/encoding.h>

#include <gtest/gtest.h>

#include <string>

using namespace SlipStep;



TEST(Encoding, Utf8IsKnown)
{
  // Of one to four bytes.
  for (const std::string text :
       {"", "mu", "\xC2\xB5", "\xE2\x80\x93", "\xF0\x9F\x98\x80"})
    {
      EXPECT_TRUE(is_utf8(text)) << text;
      EXPECT_EQ(readable_text(text), text);
    }
}



TEST(Encoding, OtherTextIsLatin1)
{
  EXPECT_EQ(to_utf8("a \xC2\xB5 b"), "a \xC2\xB5 b");
  EXPECT_EQ(to_utf8("a \xB5\xFC\xE9"), "a \xC2\xB5\xC3\xBC\xC3\xA9");
  // Beside UTF-8.
  EXPECT_EQ(to_utf8("\xC2\xB5 \xB5 \xC2\xB5"), "\xC2\xB5 \xC2\xB5 \xC2\xB5");
}



TEST(Encoding, WhatCannotBeReadIsAQuestionMark)
{
  // Latin-1, one that is cut off, the second byte alone.
  for (const std::string text : {"\xB5",
                                 "\xC2",
                                 "\xE2\x80",
                                 "\x80",
                                 "\xC0\x80",
                                 "\xED\xA0\x80",
                                 "\xF8\x88"})
    {
      EXPECT_FALSE(is_utf8(text));
      EXPECT_EQ(readable_text("a" + text), "a" + std::string(text.size(), '?'));
    }
  EXPECT_EQ(readable_text("x [\xB5m], Weg \xC2\xB5"), "x [?m], Weg \xC2\xB5");
  // Control characters.
  EXPECT_EQ(readable_text("a\tb\x7f\x1b[1m\xC2\x85"), "a?b??[1m?");
  EXPECT_EQ(readable_text(std::string(1, '\0')), "?");
}
