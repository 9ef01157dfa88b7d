// SPDX-License-Identifier: LGPL-2.1-or-later

// Which lines of a raw file are rows, and by which clock.

#include <slipstep/measured_data/import_proposal.h>

#include "imported.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace fs = std::filesystem;



// Seconds from 1970 have no digits left for microseconds.
TEST(Import, StampsOfADateAreCountedFromTheFirst)
{
  const fs::path raw      = write("stamps.csv",
                             "t [us],x [mm],mu\n1709640000000000,0,0\n"
                                  "1709640000000010,1,0.1\n"
                                  "1709640000000020,2,0.1\n"
                                  "1709640000000030,3,0.1\n"
                                  "1709640000000040,4,0.1\n");
  ImportSettings settings = simple_with("Columns/Time", "t [us]");
  settings[1].second      = "x [mm]";
  EXPECT_EQ(import_test(map_of(settings), raw).time,
            (std::vector<double>{0., 1e-5, 2e-5, 3e-5, 4e-5}));

  // The map has the clock of the file.
  settings.emplace_back("Selection/Begin", "1709640000000005 us");
  EXPECT_EQ(import_test(map_of(settings), raw).time.size(), 4u);
  settings.emplace_back("Selection/Cut", "at 1709640000000025 us");
  const auto parts = import_record(map_of(settings), {raw, {}}, "a");
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].time.size(), 2u);
  settings.emplace_back("Convention/Start from zero", "false");
  EXPECT_EQ(import_record(map_of(settings), {raw, {}}, "a")[1].time[0],
            1709640000.00003);
}



TEST(Import, WordsAreCommentsOnlyWhereALineBeginsWithThem)
{
  const std::string rows = "t,x,mu\n0,0,0\n1,1,0.1\n";
  expect_refused(simple, write("a.csv", rows + "Mean,1,0\n"), "Comment marks");
  const fs::path raw = write("b.csv", rows + "2,2,stuck\n");
  expect_refused(simple, raw, "b.csv:4:5: 'stuck' is not a number (Friction)");
  EXPECT_EQ(message(map_of(simple), raw).find("Comment marks"),
            std::string::npos);
}



TEST(Import, ABeginBehindTheEndIsRefusedWhereItStands)
{
  ImportSettings settings = simple;
  settings.emplace_back("Selection/Begin", "1 s");
  settings.emplace_back("Selection/End", "0.5 s");
  expect_refused(settings,
                 write("a.csv", "t,x,mu\n0,0,0\n1,1,0.1\n"),
                 "Selection/End = 0.5 s: this is before Selection/Begin");
}



// Over midnight, noon, the end of a month, a change of zone and long pauses.
TEST(Import, TimesOfAClockAreRead)
{
  struct Times
  {
    std::string         clock, first, second, third;
    std::vector<double> expected;
  };
  for (const Times &times : std::vector<Times>{
         {"", "23:59:59.25", "23:59:59.75", "00:00:01", {0., 0.5, 1.75}},
         {"", "06:00:00", "20:00:00,5", "02:00:00", {0., 50400.5, 72000.}},
         {"", "9:59:59:500", "10:00:00:000", "10:00:02:125", {0., 0.5, 2.625}},
         {"", "23:59:59", "24:00:00", "100:00:00", {0., 1., 273601.}},
         {"", "11:59:59 AM", "12:00:01 PM", "12:00:00 am", {0., 2., 43201.}},
         {"",
          "2026-02-28T23:59:59Z",
          "2026-03-01T00:00:01Z",
          "2026-03-03 00:00:01Z",
          {0., 2., 2. + 2. * 86400.}},
         {"",
          "2026-10-25 02:59:59.5+02:00",
          "2026-10-25 02:00:00+01:00",
          "2026-10-25 02:00:01+01:00",
          {0., 0.5, 1.5}},
         {"",
          "31.12.2026 23:59:59",
          "01.01.2027 00:00:00",
          "1.1.27 00:00:01",
          {0., 1., 2.}},
         {" d/m",
          "30/04/2026 23:59:59",
          "01/05/2026 00:00:00",
          "02/05/2026 00:00:00",
          {0., 1., 86401.}},
         {" m/d",
          "4/30/26 11:59:59 p.m.",
          "5/1/26 12:00:00 a.m.",
          "5-1-2026, 12:00:01 a.m.",
          {0., 1., 2.}}})
    {
      const fs::path raw =
        write("clock.csv",
              "t;x;mu\n" + times.first + ";0;0\n" + times.second + ";1;0\n" +
                times.third + ";2;0\n");
      EXPECT_EQ(import_test(map_of(simple_with("Columns/Time",
                                               "t in clock" + times.clock)),
                            raw)
                  .time,
                times.expected)
        << times.first;
    }
}



TEST(Import, WhatIsNoTimeOfAClockIsRefused)
{
  for (const std::string text : {"5",
                                 "10:00",
                                 "10:60:00",
                                 "13:00:00 AM",
                                 "30.02.2026 10:00:00",
                                 "27.11.2026 24:00:00",
                                 "3/4/2026 10:00:00",
                                 "2026-11/27 10:00:00"})
    EXPECT_TRUE(
      contains(message(map_of(simple_with("Columns/Time", "t in clock")),
                       write("a.csv", "t;x;mu\n" + text + ";0;0\n")),
               "a.csv:2:1: '" + text + "' is no time of a clock"))
      << text;
  EXPECT_TRUE(
    contains(message(map_of(simple_with("Columns/Displacement", "x in clock")),
                     write("a.csv", "t;x;mu\n0;0;0\n")),
             "unit"));
}



TEST(Import, ClocksAndHeadersOfSeveralWordsAreProposed)
{
  const auto proposal = [](const std::string &text) {
    return propose_import(write("raw.txt", text)).text();
  };
  const auto clock = [&](const std::string &one, const std::string &other) {
    return proposal("Uhrzeit;Weg [mm];Reibkraft [N];Last [N]\n" + one +
                    ";0;0;5\n" + other + ";1;1;5\n" + other + ";2;1;5\n");
  };
  EXPECT_TRUE(contains(clock("10:00:00,5", "10:00:01,0"),
                       "\n  set Time = Uhrzeit in clock\n"));
  EXPECT_TRUE(contains(clock("11/27/2026 10:00:00", "11/27/2026 10:00:01"),
                       "\n  set Time = Uhrzeit in clock m/d\n"));
  EXPECT_TRUE(contains(clock("3/4/2026 10:00:00", "3/4/2026 10:00:01"),
                       "\n  # set Time = Uhrzeit in clock d/m\n"));

  const std::string tribometer =
    proposal("Tribometer\n\nTime [s]   Sliding distance [mm]   Friction force "
             "[N]   Load [N]\n 0.0  0.0  0.0  5\n 0.1  1.0  1.0  5\n");
  EXPECT_TRUE(contains(tribometer, "\n  set Time = column 1 in s\n"));
  EXPECT_TRUE(contains(tribometer, "\n  set Displacement = column 2 in mm\n"));
  EXPECT_TRUE(
    contains(tribometer, "\n  set Tangential load = column 3 in N\n"));
  EXPECT_TRUE(contains(tribometer, "\n  set Normal load = column 4 in N\n"));

  const std::string cycles =
    proposal("t [s];x [mm];mu [-]\nCycle 1\n0;0;0\n1;1;0.1\nCycle 2\n"
             "2;0;-0.1\n3;1;>0.2\n4;2;OVER\n5;3;0.1\n");
  EXPECT_TRUE(contains(cycles, "\n  set Comment marks = Cycle\n"));
  EXPECT_TRUE(contains(cycles, "\n  set Friction = mu [-]\n"));
}



// A test rig that records before it loads: what its cell shows then is noise,
// which divided by no load is nothing.
TEST(Import, RowsBeforeTheLoadIsOnHaveNoFriction)
{
  const auto imported = [](const std::string &first) {
    return import_test(map_of({{"Columns/Time", "t in s"},
                               {"Columns/Displacement", "x in mm"},
                               {"Columns/Tangential load", "F in N"},
                               {"Columns/Normal load", "N in N"},
                               {"Constants/Area", "10 mm^2"}}),
                       write("early.csv",
                             "t,x,F,N\n0,0," + first +
                               ",0\n1,0,0.1,50\n2,0.1,10,50\n3,0.2,10,50\n"));
  };
  EXPECT_EQ(imported("0").friction, imported("-0.1").friction);
  EXPECT_EQ(imported("-0.1").friction[0], 0.);
  EXPECT_EQ(imported("-0.1").friction[2], 0.2);
  EXPECT_THROW(imported("5"), InputError);
}
