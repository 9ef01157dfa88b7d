// SPDX-License-Identifier: LGPL-2.1-or-later

// Maps that say something else than was meant: refused or told.

#include <slipstep/measured_data/import_proposal.h>
#include <slipstep/measured_data/import_record.h>
#include <slipstep/measured_data/odd_rows.h>
#include <slipstep/measured_data/test_set.h>
#include <slipstep/utilities/lists.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "tests/file_text.h"
#include "tests/temporary_folder.h"
#include "imported.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  bool warns(const MeasuredTest &test, const std::string &words)
  {
    return any_of(test.warnings, [&](const std::string &warning) {
      return warning.find(words) != std::string::npos;
    });
  }

  const ImportSettings of_forces = {{"Columns/Time", "t in s"},
                                    {"Columns/Displacement", "x in mm"},
                                    {"Columns/Tangential load", "F in N"}};

  Parameters with(ImportSettings settings, const ImportSettings &more)
  {
    settings.insert(settings.end(), more.begin(), more.end());
    return map_of(settings);
  }
} // namespace



TEST(ImportDoubts, ASecondAxisNeedsItsMotion)
{
  const auto raw = write("y.csv", "t,x,mu,muy\n0,0,0,0\n1,1,0.1,0.2\n");
  expect_refused(simple_with("Columns/Friction y", "muy"),
                 raw,
                 "a second axis needs Columns/Displacement y");
}



// The first row is no line of names.
TEST(ImportDoubts, NumbersAreNoNames)
{
  const ImportSettings by_number = {{"Columns/Time", "column 1 in s"},
                                    {"Columns/Displacement", "column 2 in mm"},
                                    {"Columns/Friction", "column 3"},
                                    {"Constants/Pressure", "5 MPa"}};
  const std::string    rows      = "0,1,0\n1,2,0.1\n2,3,0.1\n";
  const std::string    words = "the names of its columns are numbers (0, 1, 0)";
  const auto           raw   = write("bare.csv", rows);
  EXPECT_TRUE(warns(import_test(map_of(by_number), raw), words));
  const auto whole =
    import_test(with(by_number, {{"Raw file/Has header", "false"}}), raw);
  EXPECT_EQ(whole.time.size(), 3u);
  EXPECT_FALSE(warns(whole, "numbers"));
  for (const std::string names : {"1,2,3\n", "t,x,mu\n", "0,x,0\n"})
    EXPECT_FALSE(
      warns(import_test(map_of(by_number), write("names.csv", names + rows)),
            "numbers"))
      << names;
}



TEST(ImportDoubts, AConstantLoadUnderAnotherPressureIsTold)
{
  const auto read = [&](const std::string &pressures) {
    return import_test(with(of_forces,
                            {{"Columns/Pressure", "p in MPa"},
                             {"Constants/Normal load", "10 N"}}),
                       write("loads.csv", "t,x,F,p\n" + pressures));
  };
  EXPECT_TRUE(warns(read("0,0,0,1\n1,1,1,2\n2,2,1,3\n"),
                    "divided by a normal load of 10 N throughout"));
  EXPECT_FALSE(warns(read("0,0,0,1\n1,1,1,1.1\n2,2,1,1\n"), "throughout"));
}



// The sign of the motion is that of the motion as it is converted.
TEST(ImportDoubts, SignsOfMotionAndFrictionAgree)
{
  std::string text = "t,x,mu\n";
  for (int i = 0; i <= 200; ++i)
    text += std::to_string(i) + ',' +
            std::to_string(i <= 100 ? std::min(i, 80) : std::max(180 - i, 0)) +
            ",0.1\n";
  auto settings = simple_with("Convention/Friction sign", "of the motion");
  settings.emplace_back("Convention/Displacement sign", "reversed");
  const auto test =
    import_test(map_of(settings), write("magnitudes.csv", text));
  EXPECT_DOUBLE_EQ(test.displacement[50], -50.);
  EXPECT_DOUBLE_EQ(test.friction[50], -0.1);
  EXPECT_DOUBLE_EQ(test.friction[150], 0.1);
  EXPECT_EQ(test.notes.at("signs"),
            "displacement reversed, friction of the motion");
}



TEST(ImportDoubts, WhatWasDoneToRowsStandsInTheComments)
{
  const auto note = [](const std::string &rows, const std::string &key) {
    auto settings = simple_with("Selection/Begin", "1 s");
    if (key == "rows")
      settings = simple;
    return import_test(map_of(settings), write("rows.csv", "t,x,mu\n" + rows))
      .notes.at(key);
  };
  EXPECT_EQ(note("0,0,0\n1,,0.1\n2,2,0.1\n", "rows"),
            "rows without a value, left out: 1");
  EXPECT_EQ(note("2,2,0\n1,1,0.1\n0,0,0.1\n", "rows"),
            "rows that stand newest first, turned round: all");
  EXPECT_EQ(note("0,0,0\n1,1,0.1\n2,2,0.1\n", "selection"),
            "2 of 3 rows, by their times");
}



TEST(ImportDoubts, ATestNeedsTwoRows)
{
  for (const std::string rows : {"", "0,0,0\n"})
    expect_refused(simple,
                   write("few.csv", "t,x,mu\n" + rows),
                   "and a test needs two");
}



// The path counts, not how far apart the ends are.
TEST(ImportDoubts, SpeedsAreThoseOfStrokes)
{
  const auto moving = [](const double stroke, const double seconds) {
    MeasuredTest test;
    for (unsigned int i = 0; i <= 4000; ++i)
      {
        test.time.push_back(i * seconds);
        test.displacement.push_back(stroke * std::sin(0.1 * i));
        test.pressure.push_back(5.);
        test.friction.push_back(0.1 * std::cos(0.1 * i));
      }
    std::string words;
    warn_of_odd_rows(test, [&](const std::string &text, const std::size_t) {
      words += text;
    });
    return words.find("it moves at") != std::string::npos;
  };
  EXPECT_FALSE(moving(1e-5, 25.)); // 2.5e-8 mm/s, of a range of 2e-5 mm
  EXPECT_TRUE(moving(1e-6, 25.));
  EXPECT_FALSE(moving(1., 1e-6));
  EXPECT_TRUE(moving(5., 1e-6)); // 3e5 mm/s
}



TEST(ImportDoubts, TinyPressuresAreTold)
{
  const auto read = [&](const std::string &area) {
    MeasuredTest test =
      import_test(with(of_forces,
                       {{"Constants/Normal load", "50 N"},
                        {"Constants/Area", area}}),
                  write("areas.csv", "t,x,F\n0,0,0\n1,1,5\n2,2,5\n"));
    return warns(test, "is its unit right, and that of the area?");
  };
  EXPECT_TRUE(read("10 m^2"));
  EXPECT_FALSE(read("10 mm2"));
  EXPECT_FALSE(read("10 mm\xC2\xB2"));
}



TEST(ImportDoubts, UnitsThatAreUnknownAreStillUnits)
{
  for (const std::string force : {"kg", "lb", "cN"})
    {
      const auto guesses =
        propose_import(write("units.txt",
                             "Time\tStroke\tFt\tFn\nmin\tmm\t" + force + "\t" +
                               force +
                               "\n0\t0\t0\t10\n1\t1\t1\t10\n2\t2\t1\t10\n"))
          .guesses;
      const auto value = [&](const std::string &path) {
        for (const auto &guess : guesses)
          if (guess.path == path)
            return guess.value;
        return std::string();
      };
      EXPECT_EQ(value("Raw file/Units line"), "2") << force;
      EXPECT_EQ(value("Columns/Displacement"), "Stroke in mm") << force;
    }
}



// By friction alone tests of other pressures are no copies.
TEST(ImportDoubts, CopiesHaveThePressureOfTheOriginal)
{
  const auto test = [](const double pressure, const double noise) {
    MeasuredTest result;
    result.file = std::to_string(pressure) + ".csv";
    for (unsigned int i = 0; i < 200; ++i)
      {
        result.time.push_back(i);
        result.displacement.push_back(i);
        result.pressure.push_back(pressure);
        result.friction.push_back(i < 20 ? 0.01 * i :
                                           0.2 + noise * ((i * i * 7) % 11));
      }
    return result;
  };
  const auto second_warning = [](std::vector<MeasuredTest> tests) {
    warn_of_oddities(tests);
    return tests[1].warnings;
  };
  const auto has = [](const std::vector<std::string> &warnings,
                      const std::string              &words) {
    return any_of(warnings, [&](const std::string &text) {
      return text.find(words) != std::string::npos;
    });
  };
  EXPECT_TRUE(has(second_warning({test(5., 1e-3), test(5., 1e-3)}),
                  "its rows are identical with those of"));
  EXPECT_TRUE(has(second_warning({test(5., 1e-3), test(2., 1e-3)}),
                  "under another pressure: is it a copy?"));
  EXPECT_FALSE(has(second_warning({test(5., 0.), test(2., 0.)}), "copy"));
}
