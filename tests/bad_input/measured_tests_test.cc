// SPDX-License-Identifier: LGPL-2.1-or-later

// Measured tests, folders of them and maps that are wrong in one way each.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "slipstep_process.h"
#include "tests/rows_header.h"

namespace
{
  void expect_refused_test(const std::string              &content,
                           const std::vector<std::string> &words)
  {
    const SlipstepProcess process;
    process.write("a.csv", content);
    expect_refusal(process.run({"check", "a.csv"}), words);
  }

  // Right but for what is appended.
  const std::string map = "set Columns/Time = t in s\n"
                          "set Columns/Displacement = x in mm\n"
                          "set Constants/Pressure = 5 MPa\n";
} // namespace



TEST(MeasuredTests, WrongFilesAreRefused)
{
  const std::string row = "0,0,1,0\n";
  expect_refused_test("time_s,displacement_mm,friction\n0,0,0\n1,1,0.1\n",
                      {"a.csv:1:1: ", "'pressure_MPa' is missing"});
  expect_refused_test("time,displacement_mm,pressure_MPa,friction\n" + row,
                      {"a.csv:1:1: ", "unit", "'time_s'"});
  expect_refused_test("time_s,displacement_mm,pressure_MPas,friction\n" + row,
                      {"a.csv:1:24: ", "nearest is MPa"});
  expect_refused_test(header + row + "1,1,1,o.1\n",
                      {"a.csv:3:7: ", "'o.1' is not a number (friction)"});
  expect_refused_test(header + row + "2,1,1,0.1\n1,1,1,0.1\n",
                      {"a.csv:4:1: ", "time goes backwards"});
  expect_refused_test(header + row + "1,1,0,0.1\n",
                      {"a.csv:3:5: ", "pressure is zero"});
  expect_refused_test(header + row + "1,1,-1,0.1\n",
                      {"a.csv:3:5: ", "pressure is -1 MPa"});
  expect_refused_test(header + row + "1,1,1,-0.1\n",
                      {"a.csv:3:7: ", "sign", "slipstep import"});
  expect_refused_test(
    "# condition: dry\n# condition: wet\n" + header + row,
    {"a.csv", "contradict each other on 'condition'", "dry", "wet"});
  expect_refused_test("# order: third\n" + header + row,
                      {"a.csv: order: third", "number"});
  expect_refused_test(header, {"a.csv", "two rows"});
  expect_refused_test("", {"a.csv:1:1: ", "header"});
  const SlipstepProcess process;
  expect_refusal(process.run({"check", "nowhere.csv"}),
                 {"nowhere.csv", "cannot be read"});
}



TEST(MeasuredTests, WarningsAreShownAndRightFilesDescribed)
{
  const SlipstepProcess process;
  process.write("a.csv", header + "0,0,1,0\n1,,1,0.1\n2,2,1,0.1\n");
  const auto result = process.run({"check", "a.csv"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.err, "left out: 1 (first: line 3)"));
  EXPECT_TRUE(contains(result.out, "a.csv: OK, 2 rows, 2 s"));
  // What calibrate would refuse.
  process.write("a.csv", "# noise: 0,002\n" + header + "0,0,1,0\n1,1,1,0.1\n");
  expect_refusal(process.run({"check", "a.csv"}), {"a.csv: noise: 0,002"});
}



// Also those of a case that only 'slipstep diagnose' will read.
TEST(MeasuredTests, OfACaseAreChecked)
{
  const SlipstepProcess process;
  process.write("a.csv", header + "0,0,1,0\n1,1,1,0.1\n2,2,1,0.1\n");
  process.write("case.prm", "set Calibration/Tests = a.csv\n");
  const auto right = process.run({"check", "case.prm"});
  EXPECT_EQ(right.exit_code, 0) << right.err;
  EXPECT_EQ(right.out, "case.prm: OK\n  1 test: 1 without a condition\n");
  process.write("case.prm", "set Calibration/Noise = much\n");
  expect_refusal(process.run({"check", "case.prm"}),
                 {"case.prm:1", "Calibration/Noise", "estimated"});
  process.write("case.prm", "set Calibration/Tests = nowhere.csv\n");
  expect_refusal(process.run({"check", "case.prm"}),
                 {"case.prm:1", "nowhere.csv"});
}



TEST(MeasuredTests, MapsCanBeChecked)
{
  const SlipstepProcess process;
  process.write("paths.prm", map);
  process.write("sections.prm",
                "subsection Columns\n  set Time = t in s\nend\n"
                "subsection Variants\n  subsection a\n"
                "    set Raw file/Name = a.txt\n  end\n"
                "  subsection b\n    set Raw file/Name = b.txt\n  end\nend\n");
  const auto result = process.run({"check", "paths.prm", "sections.prm"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out,
            "paths.prm: OK, a map for slipstep import, 1 test\n"
            "sections.prm: OK, a map for slipstep import, 2 tests\n");
  process.write("wrong.prm", map + "set Columns/Tine = t in s\n");
  expect_refusal(process.run({"check", "wrong.prm"}),
                 {"wrong.prm:4", "Columns/Tine", "Columns/Time"});
}



TEST(MeasuredTests, WrongFoldersAreRefused)
{
  const SlipstepProcess process;
  std::filesystem::create_directory(process.folder() / "tests");
  expect_refusal(process.run({"check", "tests"}), {"tests", "without tests"});
  process.write("tests/a.csv",
                "# condition: dry\n" + header + "0,0,1,0.1\n1,1,1,0.1\n");
  process.write("tests/b.csv",
                "# condition: dry\n" + header + "0,0,3,0.1\n1,1,3,0.1\n");
  expect_refusal(process.run({"check", "tests", "--quiet"}),
                 {"a.csv", "b.csv", "condition 'dry'", "3 MPa, not 1 MPa"});
}



TEST(MeasuredTests, WrongMapsAreRefused)
{
  const SlipstepProcess process;
  process.write("raw.csv", "t,x,mu\n0,0,0\n1,1,-0.1\n");
  const auto with = [&](const std::string &line) {
    process.write("map.prm", map + line + "\n");
    return process.run({"import", "map.prm", "raw.csv"});
  };
  expect_refusal(with(""), {"Columns/Friction", "either this column or"});
  expect_refusal(with("set Columns/Friction = nu"),
                 {"map.prm:4", "no column 'nu'", "mean mu?"});
  expect_refusal(with("set Columns/Frction = mu"),
                 {"map.prm:4", "mean Columns/Friction?"});
  expect_refusal(with("set Columns/Friction = mu"),
                 {"raw.csv:3:5: ", "sign", "Convention"});
  expect_refusal(process.run({"import", "map.prm", "no.csv"}), {"no.csv"});
  expect_refusal(process.run({"import", "map.prm"}), {"Raw file/Name"});
  expect_refusal(process.run({"import"}), {"missing"});
  EXPECT_FALSE(std::filesystem::exists(process.folder() / "measured"));

  const auto result = process.run({"import",
                                   "map.prm",
                                   "raw.csv",
                                   "--set",
                                   "Convention/Friction sign=reversed"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(process.read("measured/raw.csv"), "1,1,5,0.1"));
}



// Looked at without a map, a record gets one, and nothing is overwritten.
TEST(MeasuredTests, RecordsWithoutAMapGetOne)
{
  const SlipstepProcess process;
  process.write("raw.csv",
                "t [s];x [mm];F [N];N [N]\n0;0;0;10\n1;1;1,5;10\n2;2;2;10\n");
  const auto first = process.run({"import", "raw.csv"});
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_NE(first.out.find("taken  Columns/Tangential load = F [N] in N"),
            std::string::npos)
    << first.out;
  EXPECT_NE(first.out.find("open   Constants/Area"), std::string::npos)
    << first.out;
  EXPECT_NE(
    process.read("output/raw/import/report.html").find("Constants/Area"),
    std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(process.folder() / "measured"));
  expect_refusal(process.run({"import", "raw.csv"}),
                 {"raw_map.prm", "there already"});
  expect_refusal(process.run({"import", "raw_map.prm"}),
                 {"Constants/Area", "area is needed"});
  const auto second = process.run(
    {"import", "raw_map.prm", "--set", "Constants/Area = 2 mm^2 assumed"});
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_NE(process.read("measured/raw.csv").find("1,1,5,0.15"),
            std::string::npos);
  EXPECT_NE(process.read("measured/raw.csv").find("# assumed: Area = 2 mm^2"),
            std::string::npos);

  process.write("words.txt", "once upon a time\n");
  expect_refusal(process.run({"import", "words.txt"}),
                 {"words.txt", "no table of numbers"});
  expect_refusal(process.run({"import", "no.txt"}), {"no.txt"});
  expect_refusal(process.run({"import", "raw.csv", "words.txt"}),
                 {"raw.csv", "is not a map"});
  expect_refusal(process.run({"import", "."}), {"this is a folder"});
}



TEST(MeasuredTests, WildcardsConvertManyFiles)
{
  const SlipstepProcess process;
  for (const std::string name : {"dry_5N_a", "dry_5N_b", "wet_7N_a"})
    process.write(name + ".txt", "t,x,F\n0,0,0\n1,1,0.7\n2,2,0.7\n");
  const std::string of_names = map.substr(0, map.find("set Constants")) +
                               "set Columns/Tangential load = F in N\n"
                               "set Constants/Normal load = {2} N\n"
                               "set Constants/Area = 1 mm^2\n"
                               "set Raw file/Name = *_*N_?.txt\n"
                               "set Test/Condition = {1}, {2} N\n";
  process.write("map.prm", of_names);
  const auto result = process.run({"import", "map.prm"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(process.read("measured/wet_7N_a.csv").find("1,1,7,0.1"),
            std::string::npos);
  const auto checked = process.run({"check", "measured"});
  EXPECT_NE(checked.out.find("3 tests: condition 'dry, 5 N': 2, 'wet, 7 N': 1"),
            std::string::npos)
    << checked.out;
  process.write("map.prm", of_names + "set Test/File = {1}\n");
  expect_refusal(process.run({"import", "map.prm"}),
                 {"dry_5N_a.txt", "dry_5N_b.txt", "Test/File"});
  process.write("map.prm", of_names + "set Test/Name = {4}\n");
  expect_refusal(process.run({"import", "map.prm"}),
                 {"map.prm:8", "{4}", "known: {1}"});
  expect_refusal(process.run({"import", "map.prm", "map.prm"}),
                 {"map.prm", "does not match this pattern"});
}



// A load over another area is another pressure.
TEST(MeasuredTests, AreasOfTestsAndBlockAreCompared)
{
  const SlipstepProcess process;
  process.write("a.csv",
                "# area: 50 mm^2\n" + header +
                  "0,0,1,0\n1,1,1,0.1\n2,2,1,0.1\n");
  const auto with_size = [&](const std::string &size) {
    process.write("case.prm",
                  "set Calibration/Tests = a.csv\nset Block/Size = " + size +
                    "\n");
    const auto result = process.run({"check", "case.prm"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.err;
  };
  const std::string alike = with_size("10 mm, 5 mm, 2 mm");
  EXPECT_EQ(alike.find("mm^2"), std::string::npos) << alike;
  const std::string warning = with_size("20 mm, 5 mm, 2 mm");
  EXPECT_NE(warning.find("divided by 50 mm^2"), std::string::npos) << warning;
  EXPECT_NE(warning.find("face of 100 mm^2"), std::string::npos) << warning;
}
