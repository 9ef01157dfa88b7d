// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/formula.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "tests/file_text.h"

using namespace SlipStep;

namespace
{
  std::string refusal(const std::string &text)
  {
    try
      {
        ParsedFormula(text, "x");
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }

  const std::string decimals = "decimals begin with a point";
} // namespace



TEST(Formula, IsEvaluated)
{
  for (const auto &pair :
       {std::make_pair("1 + 2*x^2", 19.),
        std::make_pair("0.0042*log(x) + 0.1", 0.0042 * std::log(3.) + 0.1),
        std::make_pair("ln(x)", std::log(3.)),
        std::make_pair("log10(x)", std::log10(3.)),
        std::make_pair("min(1, 2, x)", 1.),
        std::make_pair("max(1,(x+1),pow(x, 2))", 9.),
        std::make_pair("if(x > 2, 5, 6)", 5.),
        std::make_pair("x == 3 ? 1 : 2", 1.),
        std::make_pair("x != 3 ? 1 : 2", 2.),
        std::make_pair("(x <= 3) + (x >= 3)", 2.),
        std::make_pair("cot(x) + sec(x) + csc(x)",
                       1. / std::tan(3.) + 1. / std::cos(3.) +
                         1. / std::sin(3.)),
        std::make_pair("sin(pi/2)", 1.)})
    EXPECT_NEAR(ParsedFormula(pair.first, "x")(3.), pair.second, 1e-14)
      << pair.first;
  EXPECT_EQ(ParsedFormula("2*3")(), 6.);
}



TEST(Formula, ADecimalCommaIsMarked)
{
  EXPECT_EQ(refusal("1,2"),
            "this comma separates nothing; " + decimals + "\n  1,2\n   ^");
  for (const char *text : {"1,5*x + 2", "2*(0,5 + x)", "exp(x) + 0,5", "0,5"})
    {
      const std::string message = refusal(text);
      EXPECT_TRUE(contains(message, decimals)) << text;
      const std::size_t comma = std::string(text).find(',');
      EXPECT_EQ(message.substr(message.rfind('\n') + 1),
                std::string(comma + 2, ' ') + "^");
    }
  // Too many arguments are most likely decimals, too.
  EXPECT_TRUE(contains(refusal("exp(0,5)"), decimals));
  // An inner comma belongs to the function, an outer one does not.
  EXPECT_TRUE(contains(refusal("min(1, 2), 3"), "\n           ^"));
}



TEST(Formula, ASingleEqualsSignIsMarked)
{
  for (const char *text : {"x=5", "x = 5", "1 + (x = 5)", "min(x=1, 2)", "=1"})
    {
      const std::string message = refusal(text);
      EXPECT_TRUE(contains(message, "to compare, write =="))
        << text << ": " << message;
      const std::size_t sign = std::string(text).find('=');
      EXPECT_EQ(message.substr(message.rfind('\n') + 1),
                std::string(sign + 2, ' ') + "^");
    }
}



TEST(Formula, WhatTheParserSaysIsPassedOn)
{
  EXPECT_TRUE(contains(refusal("1 + v"), "\"v\""));
  EXPECT_TRUE(contains(refusal("1 +"), "end of expression"));
  EXPECT_TRUE(contains(refusal(""), "empty"));
}
