// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/measured_test.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "tests/file_text.h"
#include "tests/message_of.h"
#include "tests/rows_header.h"
#include "tests/temporary_folder.h"

using namespace SlipStep;

namespace
{
  std::filesystem::path file_with(const std::string &content)
  {
    const auto file = test_folder() / "slipstep_measured.csv";
    std::ofstream(file, std::ios::binary) << content;
    return file;
  }

  /// The message without the name of the file, "" if the file is accepted.
  std::string message(const std::string &content)
  {
    const auto        file = file_with(content);
    const std::string text = message_of([&] { read_measured_test(file); });
    if (text.empty())
      return "";
    EXPECT_EQ(text.find(file.string()), 0u) << text;
    return text.substr(file.string().size());
  }
} // namespace



TEST(MeasuredTest, ValuesAndNotesAreRead)
{
  const MeasuredTest test = read_measured_test(
    file_with("# name: first\n# condition: dry\n# Source: a: b\n\n" + header +
              "0,0,5.8,0\n 0.5 , -1e-3,5.8,-0.1\n1.D0,-2.5D-03,5.8,-1d-1\n"));
  EXPECT_EQ(test.name, "first");
  EXPECT_EQ(test.condition, "dry");
  EXPECT_EQ(test.notes.at("source"), "a: b");
  ASSERT_EQ(test.time.size(), 3u);
  EXPECT_EQ(test.displacement[1], -1e-3);
  EXPECT_EQ(test.friction[1], -0.1);
  // As Fortran writes double precision.
  EXPECT_EQ(test.time[2], 1.);
  EXPECT_EQ(test.displacement[2], -2.5e-3);
  EXPECT_EQ(test.friction[2], -0.1);
  EXPECT_TRUE(test.friction_y.empty());
}



TEST(MeasuredTest, ByteOrderMarkAndWindowsLineEndsAreAccepted)
{
  const MeasuredTest test = read_measured_test(
    file_with("\xEF\xBB\xBFtime_s,displacement_mm,pressure_MPa,friction\r\n"
              "0,0,1,0\r\n1,2,1,0.25\r\n"));
  EXPECT_EQ(test.friction[1], 0.25);
  EXPECT_EQ(test.name, "slipstep_measured");
}



TEST(MeasuredTest, OtherColumnsMayHoldAnything)
{
  const MeasuredTest test = read_measured_test(
    file_with("friction,remark,temperature_C,time_s,pressure_MPa,"
              "displacement_mm\n0.1,all well,20,0,1,7\n0.2,,21,1,1,8\n"));
  EXPECT_EQ(test.friction[1], 0.2);
  EXPECT_EQ(test.temperature[1], 21.);
  EXPECT_EQ(test.displacement[0], 7.);
}



TEST(MeasuredTest, FaultsAreLocated)
{
  const std::string row = "0,0,1,0\n";
  EXPECT_EQ(message(header + row + "1,2,x1,0\n").substr(0, 6), ":3:5: ");
  EXPECT_EQ(message(header + row + "1,  2mm,1,0\n").substr(0, 6), ":3:5: ");
  EXPECT_EQ(message(header + row + "1,,x,0\n").substr(0, 6), ":3:4: ");
  EXPECT_EQ(message("# a: b\n" + header + row + "0.5,2,1\n").substr(0, 3),
            ":4:");
  EXPECT_EQ(message(header + row + "1,2,1,0,1\n").substr(0, 6), ":3:9: ");
  EXPECT_EQ(message(header + row + "1,0,1,0\n  0.5,0,1,0\n").substr(0, 6),
            ":4:3: ");
  EXPECT_EQ(message(header + row + "1,0,-1,0\n").substr(0, 6), ":3:5: ");
  EXPECT_EQ(message(header + row + "1,0,1,inf\n").substr(0, 6), ":3:7: ");
  EXPECT_TRUE(
    contains(message(header + row + "0,0,1,0\n"), "two rows of different"));
  EXPECT_NE(message(header + row), "");
  EXPECT_NE(message(""), "");
}



TEST(MeasuredTest, AMissingColumnIsNamed)
{
  const std::string text =
    message("time_s,displacement_mm,presure_MPa\n0,0,1\n1,0,1\n");
  EXPECT_EQ(text.substr(0, 6), ":1:1: ");
  EXPECT_TRUE(contains(text, "'pressure_MPa'"));
  EXPECT_TRUE(contains(text, "mean presure_MPa?"));
  EXPECT_TRUE(contains(message("time_s," + header + "0,0,0,1,1\n"), "twice"));
  EXPECT_TRUE(contains(message("time_s,displacement_y_um,pressure_MPa,"
                               "friction_y\n0,0,1,0\n1,1,1,0\n"),
                       "column 'displacement_mm' is missing"));
}



TEST(MeasuredTest, UnitsOfTheHeaderAreConverted)
{
  const MeasuredTest test = read_measured_test(
    file_with("Time [ms],displacement_um,Pressure (kPa),"
              "friction [-],temperature_K\n"
              "0,0,5800,0,273.15\n500,20,5800,0.1,274.15\n"));
  EXPECT_EQ(test.time[1], 0.5);
  EXPECT_EQ(test.displacement[1], 0.02);
  EXPECT_EQ(test.pressure[1], 5.8);
  EXPECT_EQ(test.temperature[1], 1.);
}



TEST(MeasuredTest, AMissingOrWrongUnitIsAsked)
{
  const std::string rows = "0,0,1,0\n1,1,1,0.1\n";
  std::string       text =
    message("time_s,displacement_mm, pressure,friction\n" + rows);
  EXPECT_EQ(text.substr(0, 7), ":1:25: ");
  EXPECT_TRUE(contains(text, "'pressure_MPa'"));
  text = message("time_s,displacement_furlong,pressure_MPa,friction\n" + rows);
  EXPECT_EQ(text.substr(0, 6), ":1:8: ");
  EXPECT_TRUE(contains(text, "not a unit of a length"));
  text = message("time_s,displacement_mm,pressure_MPas,friction\n" + rows);
  EXPECT_TRUE(contains(text, "nearest is MPa"));
}



TEST(MeasuredTest, SpreadsheetsOfManyCountriesAreRead)
{
  for (const char *content :
       {"time_s;displacement_mm;pressure_MPa;friction\n"
        "0;0;5,8;0\n0,5;1;5,8;0,125\n",
        "time_s\tdisplacement_mm\tpressure_MPa\tfriction\r\n"
        "0\t0\t5,8\t0\t\r\n0,5\t1,\t5,8\t0,125\t\r\n",
        "time_s;displacement_mm;pressure_MPa;friction\n"
        "0;0;5.8;0\n0.5;1;5.8;0.125",
        "time_s  displacement_mm  pressure_MPa  friction\n"
        "  0  0 5.8  0\n 0.5 1\t5.8  1.25e-1 \n",
        "\"time_s\",\"displacement_mm\",\"pressure_MPa\",\"friction\"\n"
        "\"0\",0,5.8,0,\n0.5,1,5.8,\"0.125\"\n"})
    {
      SCOPED_TRACE(content);
      const MeasuredTest test = read_measured_test(file_with(content));
      ASSERT_EQ(test.time.size(), 2u);
      EXPECT_EQ(test.time[1], 0.5);
      EXPECT_EQ(test.displacement[1], 1.);
      EXPECT_EQ(test.pressure[0], 5.8);
      EXPECT_EQ(test.friction[1], 0.125);
    }
}



TEST(MeasuredTest, DecimalMarksAreNotGuessed)
{
  const std::string semicolons =
    "time_s;displacement_mm;pressure_MPa;friction\n";
  std::string text = message(semicolons + "0;0;5,8;0\n1;1;5.8;0,1\n");
  EXPECT_EQ(text.substr(0, 6), ":3:5: ");
  EXPECT_TRUE(contains(text, "decimal comma and decimal point"));
  text = message(semicolons + "0;0;5,8;0\n1;1;1.005,8;0,1\n");
  EXPECT_EQ(text.substr(0, 6), ":3:5: ");
  text = message(header + "0,0,1,0\n0,5,0,1,0\n");
  EXPECT_TRUE(contains(text, "decimal comma need ';' or tabs"));
  text = message("\xFF\xFEt");
  EXPECT_TRUE(contains(text, "UTF-16"));
}



TEST(MeasuredTest, WritingAndReadingGivesTheSame)
{
  MeasuredTest test;
  test.name         = "a test";
  test.condition    = "dry";
  test.notes        = {{"source", "a: b"}, {"licence", "MIT"}};
  test.time         = {0.1, 0.1 + 1. / 3., 1e4};
  test.displacement = {0., 1e-3, 2.};
  test.pressure     = {5.8, 5.8, 1. / 3.};
  test.friction     = {0., 0.1 / 3., 0.1};
  test.temperature  = {20., 21., 22.};
  const auto file   = test_folder() / "written.csv";
  write_measured_test(file, test);
  const MeasuredTest read = read_measured_test(file);
  for (const Channel &channel : channels())
    EXPECT_EQ(read.*channel.values, test.*channel.values) << channel.name;
  EXPECT_EQ(read.name, test.name);
  EXPECT_EQ(read.condition, test.condition);
  EXPECT_EQ(read.notes.at("source"), "a: b");
  EXPECT_EQ(read.notes.at("licence"), "MIT");
  EXPECT_TRUE(read.warnings.empty());

  // The file is replaced in one go, and nothing else is left in the folder.
  write_measured_test(file, test, 3);
  EXPECT_EQ(read_measured_test(file).pressure[2], 0.333);
  EXPECT_EQ(read_measured_test(file).time[1], 0.433333);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(test_folder()),
                          std::filesystem::directory_iterator()),
            1);
}



// The format is a contract: other programs write and read it.
TEST(MeasuredTest, TheFormatStays)
{
  MeasuredTest test;
  test.name             = "n";
  test.condition        = "c";
  test.notes["licence"] = "MIT";
  test.time             = {0., 0.5};
  test.displacement     = {0., 1.};
  test.pressure         = {2., 2.};
  test.friction         = {0., 0.25};
  test.displacement_y   = {0., 0.};
  test.friction_y       = {0., 0.};
  test.temperature      = {20., 20.5};
  const auto file       = test_folder() / "format.csv";
  write_measured_test(file, test);
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  EXPECT_EQ(text.str(),
            "# name: n\n# condition: c\n# licence: MIT\n"
            "time_s,displacement_mm,pressure_MPa,friction,displacement_y_mm,"
            "friction_y,temperature_C\n"
            "0,0,2,0,0,0,20\n0.5,1,2,0.25,0,0,20.5\n");
}



// Columns of zeros were not measured.
TEST(MeasuredTest, AnAxisThatIdlesIsLeftOut)
{
  const auto file = test_folder() / "idle.csv";
  const auto read = [&](const std::string &y) {
    std::ofstream(file) << "time_s,displacement_mm,pressure_MPa,friction,"
                           "displacement_y_mm,friction_y\n"
                           "0,0,2,0,0,0\n1,1,2,0.2,"
                        << y << "\n2,2,2,0.2,0,0\n";
    return read_measured_test(file);
  };
  EXPECT_TRUE(read("0,0").friction_y.empty());
  EXPECT_FALSE(read("0,1e-6").friction_y.empty());
  EXPECT_FALSE(read("0.1,0").friction_y.empty());
}



TEST(MeasuredTest, AMissingFileIsNamed)
{
  EXPECT_THROW(read_measured_test("no_such_file.csv"), InputError);
  EXPECT_THROW(read_measured_test("."), InputError);
}
