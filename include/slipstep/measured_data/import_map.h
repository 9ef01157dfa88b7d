// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_import_map_h
#define slipstep_measured_data_import_map_h

#include <slipstep/measured_data/measured_test.h>
#include <slipstep/utilities/parameters.h>

#include <filesystem>

namespace SlipStep
{
  /// The keys of a map, a .prm file that says how the file of an instrument is
  /// to be read: its columns with their units, what it does not record, what
  /// its signs mean. Variants convert several files by one map.
  void declare_import_parameters(Parameters &parameters);

  /// Convert one file by a map: read it, convert to base units, put the rows in
  /// order (see tidy_rows()), count time and displacement from the first row,
  /// and resample if the map says so.
  /// @throws InputError naming the place in the map or in the file
  MeasuredTest import_test(const Parameters            &map,
                           const std::filesystem::path &raw_file);
} // namespace SlipStep

#endif
