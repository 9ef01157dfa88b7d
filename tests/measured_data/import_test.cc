// SPDX-License-Identifier: LGPL-2.1-or-later

// Files of instruments, converted by a map.

#include <slipstep/measured_data/import_map.h>
#include <slipstep/measured_data/test_set.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include "tests/file_text.h"
#include "tests/temporary_folder.h"

using namespace SlipStep;

namespace
{
  namespace fs = std::filesystem;

  fs::path write(const std::string &name, const std::string &text)
  {
    std::ofstream(test_folder() / name, std::ios::binary) << text;
    return test_folder() / name;
  }

  // "Columns/Time = t" lines become a map.
  Parameters
  map_of(const std::vector<std::pair<std::string, std::string>> &settings)
  {
    Parameters map;
    declare_import_parameters(map);
    for (const auto &[path, value] : settings)
      map.set(path, value, "--set");
    return map;
  }

  std::string message(const Parameters &map, const fs::path &raw)
  {
    try
      {
        import_test(map, raw);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }

  const std::vector<std::pair<std::string, std::string>> simple = {
    {"Columns/Time", "t in s"},
    {"Columns/Displacement", "x in mm"},
    {"Columns/Friction", "mu"},
    {"Constants/Pressure", "5 MPa"}};

  std::vector<std::pair<std::string, std::string>>
  simple_with(const std::string &path, const std::string &value)
  {
    auto settings = simple;
    for (auto &setting : settings)
      if (setting.first == path)
        {
          setting.second = value;
          return settings;
        }
    settings.emplace_back(path, value);
    return settings;
  }
} // namespace



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
         {"Constants/Speed", "1 mm/s", "either this column or"},
         {"Constants/Pressure", "5", "the unit is missing"},
         {"Constants/Pressure", "-5 MPa", "must be positive"},
         {"Columns/Tangential load", "column 3 in N", "either this column or"},
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
