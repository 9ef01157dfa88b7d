// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_measured_data_imported_h
#define tests_measured_data_imported_h

#include <slipstep/measured_data/import_record.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/file_text.h"
#include "tests/message_of.h"
#include "tests/temporary_folder.h"

namespace SlipStep
{
  namespace Testing
  {
    using ImportSettings = std::vector<std::pair<std::string, std::string>>;



    inline std::filesystem::path write(const std::string &name,
                                       const std::string &text)
    {
      std::ofstream(test_folder() / name, std::ios::binary) << text;
      return test_folder() / name;
    }



    // "Columns/Time = t" lines become a map.
    inline Parameters map_of(const ImportSettings &settings)
    {
      Parameters map;
      declare_import_parameters(map);
      for (const auto &[path, value] : settings)
        map.set(path, value, "--set");
      return map;
    }



    inline MeasuredTest import_test(const Parameters            &map,
                                    const std::filesystem::path &raw)
    {
      const auto tests = import_record(map, {raw, {}}, raw.stem().string());
      EXPECT_EQ(tests.size(), 1u);
      return tests.front();
    }



    inline std::string message(const Parameters            &map,
                               const std::filesystem::path &raw)
    {
      return message_of([&] { import_test(map, raw); });
    }



    inline const ImportSettings simple = {{"Columns/Time", "t in s"},
                                          {"Columns/Displacement", "x in mm"},
                                          {"Columns/Friction", "mu"},
                                          {"Constants/Pressure", "5 MPa"}};



    inline ImportSettings simple_with(const std::string &path,
                                      const std::string &value)
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



    inline void expect_refused(const ImportSettings        &s,
                               const std::filesystem::path &raw,
                               const std::string           &words)
    {
      const std::string text = message(map_of(s), raw);
      EXPECT_TRUE(contains(text, words));
      EXPECT_EQ(text.find("column1"), std::string::npos) << text;
    }
  } // namespace Testing
} // namespace SlipStep

#endif
