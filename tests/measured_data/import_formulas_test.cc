// SPDX-License-Identifier: LGPL-2.1-or-later

// Columns of a record by formulas of columns.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/file_text.h"
#include "imported.h"

using namespace SlipStep;
using namespace SlipStep::Testing;



// A seal takes its part of the force: F - 20 mm^2 p, with 10 bar = 1 MPa.
TEST(ImportFormulas, ColumnsCanBeFormulas)
{
  const auto raw = write("raw.csv",
                         "t,x (um),F [kN],p,N,U\n"
                         "0,0,0.02,10,100,1\n1,500,0.03,10,100,2\n"
                         "2,1000,0.04,20,,3\n3,1500,0.04,20,100,3\n");
  const auto test =
    import_test(map_of(
                  {{"Columns/Time", "60*{t in min} in s"},
                   {"Columns/Displacement", "{x (um)}"},
                   {"Columns/Friction", "({F [kN]} - 20*{p in bar})/{N in N}"},
                   {"Columns/Pressure", "{p in bar} + 0.5 in MPa"},
                   {"Columns/Temperature", "20 + 10*{U as recorded} in degC"}}),
                raw);
  EXPECT_EQ(test.time, std::vector<double>({0., 3600., 10800.}));
  EXPECT_EQ(test.displacement, std::vector<double>({0., 0.5, 1.5}));
  EXPECT_EQ(test.pressure, std::vector<double>({1.5, 1.5, 2.5}));
  ASSERT_EQ(test.friction.size(), 3u);
  EXPECT_NEAR(test.friction[0], 0., 1e-15);
  EXPECT_NEAR(test.friction[1], 0.1, 1e-15);
  EXPECT_NEAR(test.friction[2], 0., 1e-15);
  EXPECT_EQ(test.temperature, std::vector<double>({30., 40., 50.}));
}



TEST(ImportFormulas, MistakesInFormulasAreNamed)
{
  const auto raw  = write("raw.csv", "t,x,F,N\n0,0,0,1\n1,1,0.1,1\n");
  const auto with = [](const std::string &formula) {
    return simple_with("Columns/Friction", formula);
  };
  EXPECT_EQ(message(map_of(with("{F in N}/{N in N}")), raw), "");
  expect_refused(with("{F}/{N in N}"), raw, "the unit is missing");
  expect_refused(with("{F in V}/{N in N}"), raw, "as recorded");
  expect_refused(with("{G in N}/{N in N}"), raw, "has no column 'G'");
  expect_refused(with("{F in N}/{N in N"), raw, "a } is missing");
  expect_refused(with("{F in N}/N"), raw, "columns stand in braces");
  expect_refused(with("0,5*{F in N}"), raw, "separates nothing");
  expect_refused(with("{F in N}*({N in N}"), raw, "columns stand in braces");
  expect_refused(with("{F in N} in N"), raw, "a plain number has no unit");
  expect_refused(with("{F in N}/0"), raw, "not finite");

  // Units of other kinds, unless a number may stand for what lacks.
  for (const char *const wrong : {"{F in N}/{N in MPa}",
                                  "({F in N} - {x in um})/{N in N}",
                                  "{F in N}/{N in N}*{x in mm}/{t in s}",
                                  "sqrt({F in N})/{N in N}"})
    expect_refused(with(wrong), raw, "the units do not make a plain number");
  for (const char *const right : {"{F in N}/(12*{N in MPa})",
                                  "({F in N} - 0.01*{x in um})/{N in N}",
                                  "abs({F in N})/sqrt({N in N}*{N in N})",
                                  "{F in kN}/{N in N}",
                                  "{F as recorded}/{N in N}"})
    EXPECT_EQ(message(map_of(with(right)), raw), "") << right;
  const auto position = [&](const std::string &formula) {
    auto settings = with("{F in N}/{N in N}");
    settings[1]   = {"Columns/Displacement", formula};
    return message(map_of(settings), raw);
  };
  EXPECT_EQ(position("{x in um} + {t in s}*{N in mm/s}"), "");
  EXPECT_TRUE(
    contains(position("{x in um} + {t in s}*{N in mm}"), "do not make mm"));
  // It would be a thousandth of a thousandth.
  EXPECT_TRUE(contains(position("{x in um} - 3 in um"), "leave out 'in um'"));
}
