// SPDX-License-Identifier: LGPL-2.1-or-later

// Files of instruments, converted by a map.

#include <slipstep/measured_data/import_record.h>
#include <slipstep/measured_data/test_set.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "tests/file_text.h"
#include "tests/temporary_folder.h"
#include "imported.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace fs = std::filesystem;

TEST(Import, LoadsUnitsSignsAndConstants)
{
  const auto         raw = write("raw.txt",
                         "Rig 3\r\noperator\tN. N.\r\n"
                                 "\tClock\tTime [ms]\tLoad\tLoad\tPos (\xB5m)\tF\t\r\n"
                                 "\t10:00\t1000,\t2,5\t100\t-50,0\t0,\t\r\n"
                                 "\t10:01\t1500,\t2,5\t100\t-40,0\t-0,25\t\r\n"
                                 "\t10:02\t2000,\t\t100\t-30,0\t-0,25\t\r\n"
                                 "\t10:03\t2500,\t2,5\t100\t-20,0\t-0,5\t\r\n"
                                 "End of test\r\n");
  const MeasuredTest test =
    import_test(map_of({{"Raw file/Header line", "3"},
                        {"Raw file/Comment marks", "End of"},
                        {"Columns/Time", "Time [ms]"},
                        {"Columns/Normal load", "column 4 in N"},
                        {"Columns/Tangential load", "F in N"},
                        {"Columns/Displacement", "Pos (\xB5m)"},
                        {"Constants/Area", "0.5 mm^2"},
                        {"Convention/Friction sign", "reversed"},
                        {"Test/Condition", "dry"},
                        {"Test/Licence", "MIT"}}),
                raw);
  EXPECT_EQ(test.time, std::vector<double>({0., 0.5, 1.5}));
  EXPECT_EQ(test.displacement.size(), 3u);
  EXPECT_NEAR(test.displacement[1], 0.01, 1e-15);
  EXPECT_EQ(test.pressure, std::vector<double>({5., 5., 5.}));
  EXPECT_EQ(test.friction, std::vector<double>({0., 0.1, 0.2}));
  EXPECT_EQ(test.name, "raw");
  EXPECT_EQ(test.condition, "dry");
  EXPECT_EQ(test.notes.at("licence"), "MIT");
  ASSERT_EQ(test.warnings.size(), 1u);
  EXPECT_TRUE(contains(test.warnings[0], "left out: 1 (first: line 6)"));
}



// Instruments repeat the header when a range or a channel changes: the same one
// again is left out, below another one the rows are of something else.
TEST(Import, AnotherHeaderBetweenTheRowsIsRefused)
{
  const std::string header = "Time [s],Way [mm],F [N],N [N]";
  const auto        with   = [&](const std::string &units,
                        const std::string &second,
                        const std::string &more = "") {
    return write("again.csv",
                 header + "\n" + units + "0,0,0,10\n1,0.1,1,10\n" + second +
                   "\n" + more + "2,0.2,1,10\n3,0.3,1,10\n");
  };
  const auto map = [&](const std::string &marks, const std::string &units) {
    return map_of({{"Raw file/Comment marks", marks},
                   {"Raw file/Header line", "1"},
                   {"Raw file/Units line", units},
                   {"Columns/Time", "Time [s] in s"},
                   {"Columns/Displacement", "Way [mm] in mm"},
                   {"Columns/Tangential load", "F [N] in N"},
                   {"Columns/Normal load", "N [N] in N"},
                   {"Constants/Area", "2 mm^2"}});
  };
  const std::string of_s = "Time";
  EXPECT_EQ(import_test(map(of_s, "0"), with("", header)).time.size(), 4u);
  EXPECT_EQ(import_test(map(of_s, "0"), with("", "Time of the second range"))
              .time.size(),
            4u);
  for (const auto &[second, told] :
       std::vector<std::pair<std::string, std::string>>{
         {"Time [s],Way [um],F [N],N [N]",
          "4:10: the header is repeated with "
          "'Way [um]' in place of 'Way [mm]'"},
         {"Time [ms],Way [um],F [kN],N [kN]", "'Time [ms]'"},
         {"Time [s],Way [mm],N [N],F [N]", "'N [N]' in place of 'F [N]'"}})
    EXPECT_TRUE(contains(message(map(of_s, "0"), with("", second)), told))
      << message(map(of_s, "0"), with("", second));
  // Units in a line of their own, which is repeated, too.
  const std::string units = "s,mm,N,N";
  EXPECT_EQ(import_test(map("Time, s", "2"),
                        with(units + "\n", header, units + "\n"))
              .time.size(),
            4u);
  EXPECT_TRUE(contains(message(map("Time, s", "2"),
                               with(units + "\n", header, "s,um,N,N\n")),
                       "'um' in place of 'mm'"));
}



TEST(Import, SpeedRowsAndNumberedColumns)
{
  const auto raw = write("raw.dat", "0 0.0\n1 0.1\n2 0.2\n3 0.1\n");
  const auto test =
    import_test(map_of({{"Raw file/Has header", "false"},
                        {"Columns/Time", "column 1 in s"},
                        {"Columns/Friction", "column 2"},
                        {"Constants/Speed", "60 mm/min"},
                        {"Constants/Pressure", "2 MPa"},
                        {"Selection/Begin", "1 s"},
                        {"Selection/End", "2.5 s"},
                        {"Convention/Start from zero", "false"}}),
                raw);
  EXPECT_EQ(test.time, std::vector<double>({1., 2.}));
  EXPECT_EQ(test.displacement, std::vector<double>({0., 1.}));
  EXPECT_EQ(test.friction, std::vector<double>({0.1, 0.2}));

  // A gap may begin the record.
  const auto begun_late =
    import_test(map_of({{"Columns/Time", "t in s"},
                        {"Columns/Friction", "mu"},
                        {"Constants/Speed", "60 mm/min"},
                        {"Constants/Pressure", "2 MPa"}}),
                write("late.csv", "t,mu\n,0.1\n1,0.1\n2,0.2\n3,0.1\n"));
  EXPECT_EQ(begun_late.time, std::vector<double>({0., 1., 2.}));
  EXPECT_EQ(begun_late.displacement, std::vector<double>({0., 1., 2.}));
}



// Ramps of speed, forth and back; a row without a speed is left out.
TEST(Import, ARecordedSpeedIsIntegrated)
{
  std::string rows = "t,v,mu\n";
  for (int i = 0; i <= 40; ++i)
    rows += std::to_string(0.5 * i) + "," +
            (i == 7 ? "" : std::to_string(3.6 * (1. - 0.1 * i))) +
            (i <= 10 ? ",0.1\n" : ",-0.1\n");
  auto       map  = map_of({{"Columns/Time", "t in s"},
                            {"Columns/Speed", "v in m/h"},
                            {"Columns/Friction", "mu"},
                            {"Constants/Pressure", "2 MPa"}});
  const auto test = import_test(map, write("v.csv", rows));
  ASSERT_EQ(test.time.size(), 40u);
  for (std::size_t i = 0; i < test.time.size(); ++i)
    EXPECT_NEAR(test.displacement[i],
                test.time[i] - 0.1 * test.time[i] * test.time[i],
                1e-12);
  map.set("Constants/Speed", "1 mm/s", "test");
  EXPECT_TRUE(contains(message(map, write("v.csv", rows)), "Columns/Speed or"));
}



TEST(Import, MistakesInTheMapAreNamed)
{
  const auto raw = write("raw.csv", "t,x,mu,mu\n0,0,0,0\n1,1,0.1,0.1\n");
  const auto expect =
    [&](const std::string &path, const std::string &value, const char *words) {
      const std::string text = message(map_of(simple_with(path, value)), raw);
      EXPECT_TRUE(contains(text, words))
        << path << " = " << value << ": " << text;
    };
  expect("Columns/Displacement", "y in mm", "has no column 'y'");
  expect("Columns/Displacement", "x", "the unit is missing");
  expect("Columns/Displacement", "x in N", "not a unit of a length");
  expect("Columns/Displacement", "column 9 in mm", "has 4 columns");
  expect("Columns/Friction", "mu", "'column 3' or 'column 4'");
  auto single = simple_with("Columns/Friction", "column 3");
  EXPECT_EQ(message(map_of(single), raw), "");
  for (const auto &[path, value, words] :
       std::vector<std::array<std::string, 3>>{
         {"Constants/Speed", "1 mm/s", "either this column, Columns/Speed or"},
         {"Constants/Pressure", "5", "the unit is missing"},
         {"Constants/Pressure", "-5 MPa", "must be positive"},
         {"Columns/Tangential load", "column 3 in N", "either this column or"},
         {"Constants/Area", "4 mm^2", "is 2.5 MPa, but the pressure is 5 MPa"},
         {"Selection/Begin", "7 s", "0 of 2 rows"}})
    {
      auto settings = single;
      settings.erase(std::remove_if(settings.begin(),
                                    settings.end(),
                                    [&](const auto &s) {
                                      return s.first == path;
                                    }),
                     settings.end());
      settings.emplace_back(path, value);
      if (path == "Constants/Area")
        settings.emplace_back("Constants/Normal load", "10 N");
      const std::string text = message(map_of(settings), raw);
      EXPECT_TRUE(contains(text, words)) << path << ": " << text;
    }
}



TEST(Import, FaultsOfTheRecordAreLocated)
{
  const std::string head = "t,x,mu\n0,0,0\n";
  EXPECT_TRUE(
    contains(message(map_of(simple), write("a.csv", head + "1,1,O.1\n")),
             "a.csv:3:5: 'O.1' is not a number"));
  EXPECT_TRUE(contains(
    message(map_of(simple), write("a.csv", head + "09:59:30,1,0.1\n")),
    "a.csv:3:1: '09:59:30' is not a number (Time); if these are times of a "
    "clock, a map of slipstep import says so: Columns/Time = NAME in clock"));
  EXPECT_TRUE(
    contains(message(map_of(simple), write("a.csv", head + "1,1,-0.1\n")),
             "a.csv:3:5: friction drives the motion"));
  const auto reversed = simple_with("Convention/Friction sign", "reversed");
  EXPECT_EQ(message(map_of(reversed), write("a.csv", head + "1,1,-0.1\n")), "");
}



TEST(Import, LongRecordsCanBeResampled)
{
  std::string text = "t,x,mu\n";
  for (int i = 0; i < 1000; ++i)
    text += std::to_string(i) + ',' + std::to_string(i) + ',' +
            (i == 333 ? "0.2\n" : "0.1\n");
  const auto test =
    import_test(map_of(simple_with("Selection/Most rows", "20")),
                write("a.csv", text));
  EXPECT_LE(test.time.size(), 20u);
  EXPECT_EQ(*std::max_element(test.friction.begin(), test.friction.end()), 0.2);
  EXPECT_TRUE(contains(test.notes.at("resampled"), "of 1000 rows"));
}



// Few rows of a curve with noise look noisier than all of them.
TEST(Import, ResampledRecordsKeepTheirNoise)
{
  std::mt19937                     random(1);
  std::normal_distribution<double> noise(0., 1e-3);
  std::string                      text = "t,x,mu\n";
  for (int i = 0; i < 2000; ++i)
    text +=
      std::to_string(i) + ',' + std::to_string(i) + ',' +
      std::to_string(0.1 * (1. - std::exp(-i / 100.)) + 0.01 + noise(random)) +
      '\n';
  const auto file = write("a.csv", text);
  const auto test =
    import_test(map_of(simple_with("Selection/Most rows", "60")), file);
  EXPECT_LE(test.time.size(), 60u);
  EXPECT_NEAR(std::stod(test.notes.at("noise")), 1e-3, 1e-4);
  EXPECT_EQ(import_test(map_of(simple), file).notes.count("noise"), 0u);
}



namespace
{
  std::vector<MeasuredTest> parts(const ImportSettings &settings,
                                  const fs::path       &raw)
  {
    return import_record(map_of(settings), {raw, {}}, raw.stem().string());
  }

  // Triangular strokes of 1 mm in 10 s with a rest of 2 s at every end; a force
  // of 2 N against the motion, and a sensor with a zero and a drift.
  fs::path strokes(const std::string &name,
                   const double       zero,
                   const double       drift,
                   const int          n_strokes = 6)
  {
    std::string text = "t [s];x [mm];F [N]\n";
    for (int i = 0; i <= 120 * n_strokes; ++i)
      {
        const double t     = 0.1 * i;
        const int    n     = i / 120;
        const double along = std::min(1., (i % 120) / 100.);
        const double x     = n % 2 == 0 ? along : 1. - along;
        text += std::to_string(t) + ';' + std::to_string(x) + ';' +
                std::to_string((n % 2 == 0 ? 2. : -2.) + zero +
                               drift * (t - 6. * n_strokes)) +
                '\n';
      }
    return write(name, text);
  }

  const ImportSettings of_strokes = {{"Columns/Time", "t [s]"},
                                     {"Columns/Displacement", "x [mm]"},
                                     {"Columns/Tangential load", "F [N]"},
                                     {"Constants/Normal load", "10 N"},
                                     {"Constants/Area", "4 mm^2"}};

  ImportSettings and_also(ImportSettings settings, const ImportSettings &more)
  {
    settings.insert(settings.end(), more.begin(), more.end());
    return settings;
  }
} // namespace



// Full scale of the tangential load, 16 N, does not show in its quotient with a
// normal load that scatters.
TEST(Import, ALoadCellAtItsLimitIsTold)
{
  std::mt19937                     random(3);
  std::normal_distribution<double> noise;
  std::string                      text = "t,x,F,N\n";
  for (int i = 0; i < 200; ++i)
    text += std::to_string(0.1 * i) + "," + std::to_string(0.01 * i) + "," +
            std::to_string(std::min(16., 15. + noise(random))) + "," +
            std::to_string(100. + noise(random)) + "\n";
  const auto raw  = write("limited.csv", text);
  const auto test = import_test(map_of({{"Columns/Time", "t in s"},
                                        {"Columns/Displacement", "x in mm"},
                                        {"Columns/Tangential load", "F in N"},
                                        {"Columns/Normal load", "N in N"},
                                        {"Constants/Area", "50 mm^2"}}),
                                raw);
  ASSERT_EQ(test.warnings.size(), 1u);
  EXPECT_TRUE(
    contains(test.warnings[0], "tangential load [N] is exactly 16 in "));
}



TEST(Import, UnitsHaveALineAndThousandsAMark)
{
  const auto raw  = write("raw.txt",
                         "Messung 7\n"
                          "Zeit;Weg;Kraft;Last\n"
                          "[s];[\xC2\xB5m];N;kN\n"
                          "0,0;0;0;1,5\n"
                          "0,5;1.000,5;150;1,5\n"
                          "1,0;2.001,0;1.500,00;1,5\n");
  auto       map  = ImportSettings{{"Raw file/Header line", "2"},
                            {"Raw file/Units line", "3"},
                            {"Raw file/Thousands mark", "point"},
                            {"Columns/Time", "Zeit"},
                            {"Columns/Displacement", "Weg"},
                            {"Columns/Tangential load", "Kraft"},
                            {"Columns/Normal load", "Last"},
                            {"Constants/Area", "1 cm^2"}};
  const auto test = import_test(map_of(map), raw);
  EXPECT_EQ(test.displacement, std::vector<double>({0., 1.0005, 2.001}));
  EXPECT_EQ(test.friction, std::vector<double>({0., 0.1, 1.}));
  EXPECT_EQ(test.notes.at("area"), "100 mm^2");
  map[2].second = "none";
  expect_refused(map, raw, "raw.txt:5:5: '1.000,5' is not a number");
  expect_refused(map, raw, "Raw file/Thousands mark");
  map[1].second = "4";
  expect_refused(map, raw, "'0,0' is a number");
  map[1].second = "9";
  expect_refused(map, raw, "it is empty");
  map[1].second = "2";
  expect_refused(map, raw, "this is the header line");
  map[1].second = "0";
  expect_refused(map, raw, "the unit is missing");
  for (auto &setting : map)
    if (setting.first == "Columns/Time")
      setting.second = "Zeit in s";
    else if (setting.first == "Columns/Displacement")
      setting.second = "Weg in um";
    else if (setting.first == "Columns/Tangential load")
      setting.second = "Kraft in N";
    else if (setting.first == "Columns/Normal load")
      setting.second = "Last in kN";
  expect_refused(map, raw, "Raw file/Units line");
}



TEST(Import, RecordsAreCutAtReversalsAndCycles)
{
  const auto raw     = strokes("a.csv", 0., 0.);
  const auto strokes = parts(and_also(of_strokes,
                                      {{"Selection/Cut", "at reversals"},
                                       {"Test/Condition", "10 N, {way}"}}),
                             raw);
  ASSERT_EQ(strokes.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i)
    {
      EXPECT_EQ(strokes[i].condition,
                i % 2 == 0 ? "10 N, forth" : "10 N, back");
      EXPECT_EQ(strokes[i].file.string(),
                "a_part_" + std::to_string(i + 1) + ".csv");
      EXPECT_EQ(strokes[i].time.front(), 0.);
      EXPECT_NEAR(strokes[i].time.back(), i == 0 ? 9.9 : 12., 2.01) << i;
    }
  EXPECT_EQ(strokes[2].name, "a, part 3");
  EXPECT_TRUE(contains(strokes[2].notes.at("part"), "3 of 6"));

  const auto cycles = parts(and_also(of_strokes,
                                     {{"Selection/Cut", "every 2 cycles"},
                                      {"Selection/Row step", "4"}}),
                            raw);
  ASSERT_EQ(cycles.size(), 1u);
  EXPECT_NEAR(cycles[0].time.back(), 48., 0.41);
  EXPECT_NEAR(cycles[0].time[1], 0.4, 1e-12);
}



TEST(Import, RecordsAreCutAtHoldsAndTimes)
{
  const auto raw    = strokes("a.csv", 0., 0.);
  const auto cut_at = [&](const std::string &cut, const std::string &chosen) {
    return parts(and_also(of_strokes,
                          {{"Selection/Cut", cut},
                           {"Selection/Parts", chosen},
                           {"Convention/Start from zero", "false"}}),
                 raw);
  };
  // Rests from 10 to 12 s and so on: the last one ends the record.
  const auto at = cut_at("at holds of 1.9 s", "all");
  ASSERT_EQ(at.size(), 7u);
  EXPECT_NEAR(at[1].time.front(), 10., 0.11);
  EXPECT_NEAR(at[2].time.front(), 22., 0.11);
  const auto after = cut_at("after holds of 1.9 s", "2 to 3, 5");
  ASSERT_EQ(after.size(), 3u);
  EXPECT_NEAR(after[0].time.front(), 12., 0.11);
  EXPECT_NEAR(after[1].time.front(), 24., 0.11);
  EXPECT_NEAR(after[2].time.front(), 48., 0.11);
  const auto timed = cut_at("at 20 s, 0.5 min", "all");
  ASSERT_EQ(timed.size(), 3u);
  EXPECT_EQ(timed[1].time.front(), 20.);
  EXPECT_EQ(timed[2].time.front(), 30.);

  const auto refused = [&](const std::string &cut,
                           const std::string &chosen,
                           const std::string &words) {
    expect_refused(and_also(of_strokes,
                            {{"Selection/Cut", cut},
                             {"Selection/Parts", chosen}}),
                   raw,
                   words);
  };
  refused("at holds of 3 s", "all", "no rest of 3 s");
  refused("at holds of 3", "all", "unit is missing");
  refused("every 9 cycles", "all", "turns 5 times only");
  refused("every two cycles", "all", "allowed: none, at reversals");
  refused("sometimes", "all", "allowed: none, at reversals");
  refused("at 100 s", "all", "outside of the record");
  refused("at 30 s, 20 s", "all", "must increase");
  refused("at reversals", "7", "6 parts only");
  expect_refused(and_also(simple, {{"Selection/Cut", "at 1 s"}}),
                 write("two_rows.csv", "t,x,mu\n0,0,0\n1,1,0.1\n"),
                 "no part has the two rows");
  refused("at reversals", "2, 1 to 3", "named twice");
  refused("at reversals", "two", "write numbers of parts");
}



// Magnitudes get the sign of the motion; they are no zero.
TEST(Import, FrictionWithoutASignGetsThatOfTheMotion)
{
  std::string text = "t,x,mu\n";
  for (int i = 0; i <= 200; ++i)
    {
      const int place = i <= 100 ? std::min(i, 80) : std::max(180 - i, 0);
      text += std::to_string(i) + ',' + std::to_string(place) +
              (i < 100 ? ",0.12\n" : ",0.1\n");
    }
  const auto raw = write("magnitudes.csv", text);
  expect_refused(simple, raw, "of the motion");
  const auto test = import_test(
    map_of(simple_with("Convention/Friction sign", "of the motion")), raw);
  EXPECT_DOUBLE_EQ(test.friction[0], 0.12);
  EXPECT_DOUBLE_EQ(test.friction[90], 0.12);
  EXPECT_DOUBLE_EQ(test.friction[150], -0.1);
}



// The closed form: what was added comes off again.
TEST(Import, ZeroAndDriftOfASensorAreTakenOff)
{
  const double zero = 0.37, drift = 0.004;
  const auto   raw = strokes("a.csv", zero, drift);
  const auto   test =
    import_test(map_of(and_also(of_strokes,
                                {{"Correction/Zero", "mean of strokes"},
                                 {"Correction/Drift", "linear"}})),
                raw);
  for (std::size_t i = 0; i < test.friction.size(); ++i)
    EXPECT_NEAR(std::abs(test.friction[i]), 0.2, 2e-5) << i;
  EXPECT_TRUE(contains(test.notes.at("corrected"), "drift of 0.004"));
  EXPECT_TRUE(contains(test.notes.at("corrected"), "less 0.37"));

  const auto first =
    import_test(map_of(and_also(
                  of_strokes, {{"Correction/Zero", "mean of the first 0 s"}})),
                strokes("b.csv", 1., 0.));
  EXPECT_NEAR(first.friction[0], 0., 1e-12);
  EXPECT_NEAR(first.friction[130], -0.4, 1e-12);

  const auto with = [&](const std::string &key, const std::string &value) {
    return and_also(of_strokes, {{"Correction/" + key, value}});
  };
  expect_refused(with("Zero", "0.3"), raw, "mean of strokes");
  expect_refused(with("Zero", "mean of the first 2"), raw, "unit is missing");
  expect_refused(with("Drift", "quadratic"), raw, "allowed: none, linear");
  expect_refused(with("Zero", "mean of strokes"),
                 strokes("c.csv", 1., 0., 1),
                 "strokes in both directions");
}



TEST(Import, UnitsThatContradictTheFileAreTold)
{
  const auto raw =
    write("raw.csv", "Time [s],Pos [mm],F [N]\n0,0,0\n60,1,0.5\n");
  const auto read = [&](const std::string &time, const std::string &force) {
    return import_test(map_of({{"Columns/Time", time},
                               {"Columns/Displacement", "Pos [mm]"},
                               {"Columns/Tangential load", force},
                               {"Constants/Normal load", "5 N"},
                               {"Constants/Area", "1 mm^2"}}),
                       raw);
  };
  EXPECT_TRUE(read("Time [s] in s", "F [N]").warnings.empty());
  EXPECT_TRUE(read("Time [s]", "{F [N] in N} + 0.1").warnings.empty());
  const auto wrong = read("Time [s] in min", "2*{F [N] in kN} + {F [N] in kN}");
  ASSERT_GE(wrong.warnings.size(), 2u);
  EXPECT_EQ(wrong.time.back(), 3600.);
  EXPECT_TRUE(
    contains(wrong.notes.at("units"),
             "column 1 is taken in min, the file says s; column 3 is taken in "
             "kN, the file says N"));
}



TEST(Import, ACoefficientMayBeInPercent)
{
  const auto read = [&](const std::string &heading, const std::string &column) {
    return import_test(map_of({{"Columns/Time", "t [s]"},
                               {"Columns/Displacement", "x [mm]"},
                               {"Columns/Friction", column},
                               {"Constants/Pressure", "5 MPa"}}),
                       write("raw.csv",
                             "t [s],x [mm]," + heading + "\n0,0,0\n1,1,50\n"));
  };
  EXPECT_EQ(read("COF [%]", "COF [%]").friction[1], 0.5);
  EXPECT_EQ(read("COF (%)", "COF (%) in %").friction[1], 0.5);
  EXPECT_EQ(read("COF", "COF in %").friction[1], 0.5);
  EXPECT_EQ(read("COF [-]", "COF [-]").friction[1], 50.);
  const auto force = read("COF [N]", "COF [N]");
  EXPECT_EQ(force.friction[1], 50.);
  EXPECT_TRUE(contains(force.notes.at("units"),
                       "column 3 is taken as a plain number, the file says N"));
  EXPECT_TRUE(contains(read("COF [%]", "COF [%] in 1").notes.at("units"),
                       "as a plain number, the file says %"));
  EXPECT_THROW(read("COF", "COF in N"), InputError);
  EXPECT_THROW(read("COF", "COF in furlong"), InputError);
}



// As loggers and spreadsheets have them, in a column with a limit, too.
TEST(Import, ValuesThatAreMissingAreLeftOut)
{
  std::string text = "t,x,F,N\n";
  for (int i = 0; i < 100; ++i)
    text += std::to_string(i) + "," + std::to_string(0.1 * i) + "," +
            (i % 7 == 3 ?
               std::vector<std::string>{
                 "---", "#N/A", "OVL", "-1.#IND", "1.#QNAN0"}[i % 5] :
               std::to_string(10 + i % 3)) +
            "," + std::to_string(100 + i % 2) + "\n";
  const auto test = import_test(map_of({{"Columns/Time", "t in s"},
                                        {"Columns/Displacement", "x in mm"},
                                        {"Columns/Tangential load", "F in N"},
                                        {"Columns/Normal load", "N in N"},
                                        {"Constants/Area", "50 mm^2"}}),
                                write("raw.csv", text));
  EXPECT_EQ(test.time.size(), 86u);
  ASSERT_EQ(test.warnings.size(), 1u);
  EXPECT_TRUE(contains(test.warnings[0], "rows without a value, left out: 14"));
}



TEST(Import, UnitsThatNobodyKnowsAreToldToo)
{
  const auto read = [&](const std::string &force) {
    return import_test(
      map_of({{"Columns/Time", "t [s]"},
              {"Columns/Displacement", "x [mm]"},
              {"Columns/Tangential load", force},
              {"Constants/Normal load", "5 N"},
              {"Constants/Area", "1 mm^2"}}),
      write("raw.csv", "t [s],x [mm],F [lbs],F (left)\n0,0,0,0\n1,1,1,1\n"));
  };
  EXPECT_TRUE(
    contains(read("F [lbs] in N").notes.at("units"),
             "is taken in N, the file says lbs, which is not a known unit"));
  EXPECT_TRUE(read("F (left) in N").notes.count("units") == 0);
}



TEST(Import, WhatIsAssumedIsSaid)
{
  auto settings = of_strokes;
  for (auto &setting : settings)
    if (setting.first == "Constants/Normal load")
      setting.second = "10 N assumed";
  const auto test = import_test(map_of(settings), strokes("a.csv", 0., 0.));
  EXPECT_EQ(test.notes.at("assumed"), "Normal load = 10 N");
  EXPECT_EQ(test.friction[5], 0.2);
}



TEST(Import, WildcardsTellConditions)
{
  std::map<std::string, std::string> found;
  EXPECT_TRUE(matches_pattern("PPS_100N_1.tsv", "*_*N_?.tsv", found));
  EXPECT_EQ(found,
            (std::map<std::string, std::string>{{"1", "PPS"},
                                                {"2", "100"},
                                                {"3", "1"}}));
  found.clear();
  EXPECT_TRUE(
    matches_pattern("PPS+30PTFE_60N_200RPM_2.tsv", "*_*N*_?.tsv", found));
  EXPECT_EQ(found.at("3"), "_200RPM");
  EXPECT_FALSE(matches_pattern("PPS_100N_1.txt", "*_*N_?.tsv", found));

  fs::create_directory(test_folder() / "runs");
  for (const std::string name : {"dry_5N_b", "wet_7N_a", "dry_5N_a"})
    write("runs/" + name + ".txt", "t,x,F\n0,0,0\n1,1,1\n");
  write("runs/notes.md", "");
  const auto files = files_of_pattern(test_folder() / "runs" / "*_*N_?.txt");
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(files[0].file.filename(), "dry_5N_a.txt");
  const auto map  = map_of({{"Columns/Time", "t in s"},
                            {"Columns/Displacement", "x in mm"},
                            {"Columns/Tangential load", "F in N"},
                            {"Constants/Normal load", "{2} N"},
                            {"Constants/Area", "1 mm^2"},
                            {"Test/Name", "{1}, run {3}"},
                            {"Test/File", "{1} {3}"},
                            {"Test/Condition", "{1}, {2} N"}});
  const auto test = import_record(map, files[2], "").front();
  EXPECT_EQ(test.name, "wet, run a");
  EXPECT_EQ(test.condition, "wet, 7 N");
  EXPECT_EQ(test.file, "wet_a.csv");
  EXPECT_EQ(test.friction[1], 1. / 7.);

  EXPECT_THROW(files_of_pattern(test_folder() / "runs" / "*.dat"), InputError);
  EXPECT_THROW(files_of_pattern(test_folder() / "r*" / "*.txt"), InputError);
  auto wrong = map_of(simple_with("Test/Condition", "{4}"));
  EXPECT_TRUE(
    contains(message(wrong, write("raw.csv", "t,x,mu\n0,0,0\n1,1,0.1\n")),
             "nothing is known as {4}"));
}



// What is shipped: maps can be read, and their tests are a set.
TEST(Import, ShippedMapsAndTestsCanBeRead)
{
  unsigned int n_maps = 0;
  for (const auto &entry : fs::directory_iterator(SLIPSTEP_SOURCE_DIR "/prm"))
    if (fs::exists(entry.path() / "import.prm"))
      {
        ++n_maps;
        Parameters map;
        declare_import_parameters(map);
        map.read(entry.path() / "import.prm");
        EXPECT_TRUE(fs::exists(entry.path() / "measured" / "LICENSE"));
        EXPECT_TRUE(fs::exists(entry.path() / "measured" / "README.md"));
        std::uintmax_t size = 0;
        for (const MeasuredTest &test :
             read_test_set(entry.path() / "measured"))
          {
            EXPECT_TRUE(test.warnings.empty()) << test.warnings[0];
            EXPECT_FALSE(test.condition.empty());
            EXPECT_FALSE(test.notes.at("source").empty());
            EXPECT_FALSE(test.notes.at("licence").empty());
            EXPECT_GT(test.time.size(), 1000u);
            size += fs::file_size(test.file);
          }
        EXPECT_LT(size, 2000000u) << entry.path();
      }
  EXPECT_EQ(n_maps, 3u);
}
