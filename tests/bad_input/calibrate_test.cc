// SPDX-License-Identifier: LGPL-2.1-or-later

// What slipstep calibrate refuses, and what it leaves when all is well.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "slipstep_process.h"

namespace
{
  namespace fs = std::filesystem;

  class Calibrate : public testing::Test
  {
  protected:
    Calibrate()
    {
      fs::create_directory(process.folder() / "measured");
      write_test("measured/a.csv", 1.);
    }

    // A fall from 0.12 to 0.1 over 5 mm or so, with something like noise.
    void write_test(const std::string &name,
                    const double       sign,
                    const std::string &comment = "") const
    {
      std::ostringstream text;
      text << comment << "time_s,displacement_mm,pressure_MPa,friction\n";
      for (int i = 0; i < 60; ++i)
        text << i << ',' << 0.5 * i << ",5.8,"
             << (i == 0 ? 0. :
                          sign * (0.1 + 0.02 * std::exp(-0.1 * i) +
                                  1e-3 * std::sin(7.3 * i * i)))
             << '\n';
      process.write(name, text.str());
    }

    SlipstepProcess::Result
    calibrate(const std::string              &section,
              const std::vector<std::string> &options = {}) const
    {
      process.write("case.prm",
                    "set Friction/Effects = subloading, softening\n"
                    "set Friction/Static coefficient = 0.12\n"
                    "subsection Calibration\n" +
                      section + "end\n");
      std::vector<std::string> arguments = {"calibrate", "case.prm"};
      arguments.insert(arguments.end(), options.begin(), options.end());
      return process.run(arguments);
    }

    void expect_refusal(const std::string              &section,
                        const std::vector<std::string> &words) const
    {
      const auto result = calibrate(section);
      EXPECT_EQ(result.exit_code, 2) << result.err;
      EXPECT_LE(result.n_error_lines(), 3u) << result.err;
      for (const std::string &word : words)
        EXPECT_TRUE(contains(result.err, word))
          << "  \"" << word << "\" is not in: " << result.err;
      EXPECT_FALSE(fs::exists(process.folder() / "output"));
      // What needs no search is found by slipstep check, too.
      if (section.find("Parameters") != std::string::npos)
        {
          const auto check = process.run({"check", "case.prm"});
          EXPECT_TRUE(check.err == result.err ||
                      result.err.find("no influence") != std::string::npos)
            << check.err;
        }
    }

    const std::string one =
      "set Parameters = Friction/softening/Rate from 0.001 to 1\n";

    const SlipstepProcess process;
  };
} // namespace



TEST_F(Calibrate, WhatIsWrongWithTheCaseIsSaid)
{
  expect_refusal("", {"Calibration/Parameters", "at least one parameter"});
  expect_refusal("set Parameters = Friction/softening/Rat from 0 to 1\n",
                 {"case.prm:4", "Friction/softening/Rate"});
  expect_refusal("set Parameters = Friction/softening/Rate from 0.5 to 1\n",
                 {"case.prm:4",
                  "0.045 that this parameter has by default",
                  "outside of the bounds",
                  "start 0.75"});
  expect_refusal(one + "set Tests = nowhere\n",
                 {"case.prm:5", "there is no", "nowhere"});
  expect_refusal(one + "set Noise = little\n",
                 {"case.prm:5", "'estimated' or a number"});
  expect_refusal(one + "set Skip = 2 min\n", {"case.prm:5", "nothing is left"});
  expect_refusal(one + "set Starts = 0\n", {"case.prm:5", "Starts"});
  expect_refusal(one + "set Confidence = 95\n", {"case.prm:5", "0.999"});
  expect_refusal(one + "set Derived = x = 2 * {Friction/softening/Rat}\n",
                 {"case.prm:5", "Friction/softening/Rate"});
  expect_refusal(one + "set Derived = x = 2 * * 3\n",
                 {"case.prm:5", "Unexpected operator"});
  expect_refusal(one +
                   "set Derived = x = 2 * {Friction/softening/Rate} + 0,5\n",
                 {"case.prm:5", "decimals begin with a point", "\n     "});
  expect_refusal(one + "set Derived = x == 5\n", {"case.prm:5", "write =="});
  expect_refusal(one + "set Derived = = 5\n",
                 {"case.prm:5", "write it as: name = formula"});
  expect_refusal(one + "set Derived = Friction/softening/Rate = 1\n",
                 {"case.prm:5", "fitted already"});
  expect_refusal(
    one + "set Parameters = Friction/Normal stiffness from 1e3 to 1e6\n",
    {"case.prm:5", "given twice"});
  expect_refusal("set Parameters = Friction/Normal stiffness from 1e3 to 1e6\n",
                 {"case.prm:4", "Friction/Normal stiffness has no influence"});
  expect_refusal(
    "set Parameters = Friction/overstress/Viscosity from 1e3 to 1e6\n",
    {"case.prm:4", "Friction/overstress/Viscosity", "off"});
}



TEST_F(Calibrate, WhatIsWrongWithTheTestsIsSaid)
{
  fs::create_directory(process.folder() / "empty");
  expect_refusal(one + "set Tests = empty\n", {"empty", "no "});
  write_test("wrong.csv", -1.);
  expect_refusal(one + "set Tests = wrong.csv\n", {"wrong.csv", "sign"});
  process.write("short.csv",
                "time_s,displacement_mm,pressure_MPa,friction\n"
                "0,0,1,0\n1,1,1,0.1\n");
  expect_refusal("set Parameters = Friction/Static coefficient from 0.1 to 0.2;"
                 "Friction/softening/Rate from 0.001 to 1\n"
                 "set Tests = short.csv\n",
                 {"2 parameters cannot be found from 2 rows"});
  write_test("a.csv", 1., "# noise: -1\n");
  expect_refusal(one + "set Tests = a.csv\n",
                 {"a.csv", "noise", "greater than 0"});
  process.write("b.csv",
                "# condition: x\ntime_s,displacement_mm,pressure_MPa,friction\n"
                "0,0,1,0.1\n1,1,1,0.1\n2,2,1,0.1\n");
  process.write("c.csv",
                "# condition: x\ntime_s,displacement_mm,pressure_MPa,friction\n"
                "0,0,2,0.1\n1,1,2,0.1\n2,2,2,0.1\n");
  write_test("a.csv", 1.);
  expect_refusal(one + "set Tests = a.csv, measured/../a.csv\n",
                 {"a.csv", "listed twice"});
  expect_refusal(one + "set Tests = b.csv, c.csv\n",
                 {"b.csv", "c.csv", "pressure"});
}



TEST_F(Calibrate, WhatItWritesCanBeUsed)
{
  const auto result = calibrate(one, {"--output", "found"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "95 % interval"));
  EXPECT_EQ(result.err, "");
  for (const char *name : {"calibration.json", "report.html", "fitted.prm"})
    EXPECT_GT(fs::file_size(process.folder() / "found" / name), 100u) << name;
  // The tests are found from there, too; and what was found stays.
  const auto again = process.run(
    {"calibrate", "found/fitted.prm", "--output", "again", "--quiet"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.out, "");
  const auto value = [this](const std::string &folder) {
    const std::string text = process.read(folder + "/calibration.json");
    return std::stod(text.substr(text.find("\"value\": ") + 9));
  };
  EXPECT_NEAR(value("again"), value("found"), 1e-4 * value("found"));
  const auto point =
    process.run({"point", "found/fitted.prm", "--output", "point", "--quiet"});
  EXPECT_EQ(point.exit_code, 0) << point.err;
  // Another command does not write among these results.
  const auto beside =
    process.run({"point", "found/fitted.prm", "--output", "found", "--quiet"});
  EXPECT_EQ(beside.exit_code, 2);
  EXPECT_TRUE(contains(beside.err, "holds results of slipstep calibrate"));
  EXPECT_FALSE(fs::exists(process.folder() / "found/history.csv"));
  // Results may be replaced, other files not.
  EXPECT_EQ(calibrate(one, {"--output", "found", "--quiet"}).exit_code, 0);
  EXPECT_EQ(calibrate(one, {"--output", "measured"}).exit_code, 2);
}



TEST_F(Calibrate, ASweepIsNotFitted)
{
  process.write("case.prm",
                "subsection Sweep\nset Key = Loading/Speed\n"
                "set Values = 1 mm/min, 2 mm/min\nend\n"
                "set Calibration/Parameters = Friction/softening/Rate from "
                "0.001 to 1\n");
  const auto result = process.run({"calibrate", "case.prm"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(contains(result.err, "--variant \"1 mm/min\""));
}
