#include <slipstep/experiment/history.h>
#include <slipstep/experiment/measured_test.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/temporary_folder.h"

using namespace SlipStep;

namespace
{
  const std::string header = "time_s,displacement_mm,pressure_MPa,friction\n";

  std::filesystem::path file_with(const std::string &content)
  {
    const auto file = test_folder() / "slipstep_measured.csv";
    std::ofstream(file, std::ios::binary) << content;
    return file;
  }

  /// The message without the name of the file, "" if the file is accepted.
  std::string message(const std::string &content)
  {
    const auto file = file_with(content);
    try
      {
        read_measured_test(file);
      }
    catch (const InputError &error)
      {
        const std::string text = error.what();
        EXPECT_EQ(text.find(file.string()), 0u) << text;
        return text.substr(file.string().size());
      }
    return "";
  }
} // namespace



TEST(MeasuredTest, ValuesAndNotesAreRead)
{
  const MeasuredTest test = read_measured_test(
    file_with("# name: first\n# condition: dry\n# Source: a: b\n\n" + header +
              "0,0,5.8,0\n 0.5 , +1e-3,5.8,-0.1\n"));
  EXPECT_EQ(test.name, "first");
  EXPECT_EQ(test.condition, "dry");
  EXPECT_EQ(test.notes.at("source"), "a: b");
  ASSERT_EQ(test.time.size(), 2u);
  EXPECT_EQ(test.displacement[1], 1e-3);
  EXPECT_EQ(test.friction[1], -0.1);
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
  EXPECT_EQ(message(header + row + "1,,1,0\n").substr(0, 6), ":3:3: ");
  EXPECT_EQ(message("# a: b\n" + header + row + "0.5,2,1\n").substr(0, 3),
            ":4:");
  EXPECT_EQ(message(header + row + "1,2,1,0,1\n").substr(0, 6), ":3:9: ");
  EXPECT_EQ(message(header + row + "1,0,1,0\n  0.5,0,1,0\n").substr(0, 6),
            ":4:3: ");
  EXPECT_EQ(message(header + row + "0,0,1,0\n").substr(0, 6), ":3:1: ");
  EXPECT_EQ(message(header + row + "1,0,-1,0\n").substr(0, 6), ":3:5: ");
  EXPECT_EQ(message(header + row + "1,0,1,nan\n").substr(0, 6), ":3:7: ");
  EXPECT_NE(message(header + row), "");
  EXPECT_NE(message(""), "");
}



TEST(MeasuredTest, AMissingColumnIsNamed)
{
  const std::string text =
    message("time_s,displacement_mm,pressure\n0,0,1\n1,0,1\n");
  EXPECT_EQ(text.substr(0, 6), ":1:1: ");
  EXPECT_NE(text.find("'pressure_MPa'"), std::string::npos) << text;
  EXPECT_NE(message("time_s," + header + "0,0,0,1,1\n").find("twice"),
            std::string::npos);
}



TEST(MeasuredTest, AMissingFileIsNamed)
{
  EXPECT_THROW(read_measured_test("no_such_file.csv"), InputError);
  EXPECT_THROW(read_measured_test("."), InputError);
}



TEST(MeasuredTest, AHistoryReadsAsATest)
{
  const auto    file = test_folder() / "as_test.csv";
  HistoryWriter writer(file, "simulated");
  HistoryRow    row;
  row.pressure = 5.8;
  writer.write(row);
  row.time     = 0.1;
  row.friction = 0.1 / 3.;
  writer.write(row);

  const MeasuredTest test = read_measured_test(file);
  EXPECT_EQ(test.name, "simulated");
  EXPECT_EQ(test.friction[1], row.friction);
  EXPECT_EQ(test.displacement_y.size(), 2u);
}
