// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/test_set.h>

#include <slipstep/measured_data/test_rows.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace SlipStep
{
  namespace
  {
    constexpr double largest_ratio = 1.2;

    // From first to last motion [s].
    double duration_of_motion(const MeasuredTest &test)
    {
      std::size_t first = test.time.size(), last = 0;
      for (const auto *displacement :
           {&test.displacement, &test.displacement_y})
        {
          const std::vector<double> smooth =
            without_jitter(*displacement, jitter_of(test));
          for (std::size_t i = 1; i < smooth.size(); ++i)
            if (smooth[i] != smooth[i - 1])
              {
                first = std::min(first, i - 1);
                last  = std::max(last, i);
              }
        }
      return first < last ? test.time[last] - test.time[first] : 0.;
    }



    void compare(const MeasuredTest &one,
                 const MeasuredTest &other,
                 const std::string  &quantity,
                 const std::string  &unit,
                 double (*value)(const MeasuredTest &))
    {
      const double a = value(one), b = value(other);
      if (std::max(a, b) <= largest_ratio * std::min(a, b))
        return;
      throw InputError(name_in_messages(other) + ": the condition '" +
                       other.condition + "' is that of " +
                       name_in_messages(one) + ", but its " + quantity +
                       " is " + rounded_text(b, 3) + " " + unit + ", not " +
                       rounded_text(a, 3) + " " + unit +
                       "; replicates agree in it within 20 %");
    }


    void warn_of_copies(std::vector<MeasuredTest> &tests)
    {
      std::map<std::vector<double>, std::vector<const MeasuredTest *>>
        by_friction;
      for (MeasuredTest &test : tests)
        {
          auto      &others = by_friction[test.friction];
          const auto same =
            std::find_if(others.begin(),
                         others.end(),
                         [&](const MeasuredTest *other) {
                           return other->displacement == test.displacement &&
                                  range_of(test.friction) > 0.;
                         });
          if (same == others.end())
            others.push_back(&test);
          else if ((*same)->pressure != test.pressure &&
                   noise_level(test.friction) == 0.)
            continue; // computed, and friction has no say of pressure
          else if ((*same)->pressure != test.pressure)
            test.warnings.push_back(
              name_in_messages(test) +
              ": its friction and its motion are identical to the last digit "
              "with those of " +
              name_in_messages(**same) +
              ", under another pressure: is it a copy?");
          else
            test.warnings.push_back(
              name_in_messages(test) +
              ": its rows are identical with those of " +
              name_in_messages(**same) +
              "; a copy is not a second measurement, so remove it");
        }
    }



    void warn_of_pressures(std::vector<MeasuredTest> &tests)
    {
      constexpr double far = 300.; // kPa for MPa, bar for Pa

      std::vector<double> pressures;
      for (const MeasuredTest &test : tests)
        pressures.push_back(typical_pressure(test));
      if (tests.size() < 3)
        return;
      const double usual = median(pressures);
      for (std::size_t i = 0; i < tests.size(); ++i)
        if (pressures[i] > far * usual || far * pressures[i] < usual)
          tests[i].warnings.push_back(
            name_in_messages(tests[i]) + ": its pressure is " +
            rounded_text(pressures[i], 3) + " MPa, that of most tests " +
            rounded_text(usual, 3) + " MPa: is its unit right?");
    }
  } // namespace



  void warn_of_oddities(std::vector<MeasuredTest> &tests)
  {
    warn_of_copies(tests);
    warn_of_pressures(tests);
  }



  std::vector<MeasuredTest> read_test_set(const std::filesystem::path &folder)
  {
    if (!std::filesystem::is_directory(folder))
      throw InputError(folder.string() + ": there is no such folder");
    std::vector<std::filesystem::path> files;
    for (const auto &entry : std::filesystem::directory_iterator(folder))
      if (entry.path().extension() == ".csv" && entry.is_regular_file())
        files.push_back(entry.path());
    if (files.empty())
      throw InputError(folder.string() +
                       ": this is a folder without tests (no *.csv)");
    std::sort(files.begin(), files.end());

    std::vector<MeasuredTest> tests;
    for (const auto &file : files)
      tests.push_back(read_measured_test(file));
    check_conditions(tests);
    return tests;
  }



  void check_conditions(const std::vector<MeasuredTest> &tests)
  {
    std::map<std::string, const MeasuredTest *> first;
    for (const MeasuredTest &test : tests)
      {
        if (test.condition.empty())
          continue;
        const MeasuredTest &other =
          *first.emplace(test.condition, &test).first->second;
        compare(other, test, "pressure", "MPa", typical_pressure);
        compare(other, test, "mean speed", "mm/s", mean_speed);
      }
  }



  double typical_pressure(const MeasuredTest &test)
  {
    std::vector<double> pressed;
    for (const double pressure : test.pressure)
      if (pressure > 0.)
        pressed.push_back(pressure);
    return median(std::move(pressed));
  }



  double mean_speed(const MeasuredTest &test)
  {
    const double duration = duration_of_motion(test);
    return duration > 0. ? path_of(test) / duration : 0.;
  }



  std::string describe(const MeasuredTest &test)
  {
    const auto range = [](const std::vector<double> &values) {
      const auto [least, most] =
        std::minmax_element(values.begin(), values.end());
      return rounded_text(*least, 3) + " to " + rounded_text(*most, 3);
    };
    const auto noted = test.notes.find("noise");
    return std::to_string(test.time.size()) + " rows, " +
           rounded_text(test.time.back() - test.time.front(), 4) + " s, path " +
           rounded_text(path_of(test), 4) + " mm, " +
           rounded_text(typical_pressure(test), 4) + " MPa, friction " +
           range(test.friction) +
           (test.friction_y.empty() ?
              "" :
              " along x and " + range(test.friction_y) + " along y") +
           ", noise " +
           (noted == test.notes.end() ?
              rounded_text(noise_of_friction(test), 2) :
              noted->second);
  }



  std::string describe(const std::vector<MeasuredTest> &tests)
  {
    constexpr std::size_t              most_shown = 12;
    std::vector<std::string>           conditions;
    std::map<std::string, std::size_t> number;
    for (const MeasuredTest &test : tests)
      if (number[test.condition]++ == 0 && !test.condition.empty())
        conditions.push_back(test.condition);

    std::string text      = counted(tests.size(), "test");
    const char *separator = ": condition ";
    for (std::size_t i = 0; i < conditions.size(); ++i)
      {
        text +=
          separator + (i < most_shown ?
                         "'" + conditions[i] +
                           "': " + std::to_string(number[conditions[i]]) :
                         std::to_string(conditions.size() - i) + " others");
        separator = ", ";
        if (i == most_shown)
          break;
      }
    if (number[""] > 0)
      text += std::string(conditions.empty() ? ": " : ", ") +
              std::to_string(number[""]) + " without a condition";
    return text;
  }
} // namespace SlipStep
