// SPDX-License-Identifier: LGPL-2.1-or-later

// Which lines of a raw file are rows, and by which clock.

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
