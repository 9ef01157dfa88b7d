// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_test_set_h
#define slipstep_measured_data_test_set_h

#include <slipstep/measured_data/measured_test.h>

#include <filesystem>
#include <string>
#include <vector>

namespace SlipStep
{
  /// Read a test set: all *.csv of a folder, in the order of their names. Tests
  /// with the same condition are replicates.
  /// @throws InputError if there are none, one cannot be read, or tests
  /// contradict their condition, see check_conditions()
  std::vector<MeasuredTest> read_test_set(const std::filesystem::path &folder);

  /// Tests that say to be replicates must have been made alike: median pressure
  /// and mean speed from first to last motion within 20 % of each other.
  /// @throws InputError naming both tests
  void check_conditions(const std::vector<MeasuredTest> &tests);

  /// Warn of tests that have the rows of another one, since a copy would count
  /// as another measurement and its noise as none; and of pressures so far from
  /// those of most that the unit will be wrong.
  void warn_of_oddities(std::vector<MeasuredTest> &tests);

  /// Median pressure while there is any [MPa].
  double typical_pressure(const MeasuredTest &test);

  /// Path, without the tremble of the record, over the time from first to last
  /// motion [mm/s].
  double mean_speed(const MeasuredTest &test);

  /// A line about a test: rows, duration, path, pressure, friction, noise.
  std::string describe(const MeasuredTest &test);

  /// A line about a set: how many tests, and of each condition how many.
  std::string describe(const std::vector<MeasuredTest> &tests);
} // namespace SlipStep

#endif
