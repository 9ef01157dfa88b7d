// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_import_record_h
#define slipstep_measured_data_import_record_h

#include <slipstep/measured_data/measured_test.h>
#include <slipstep/measured_data/raw_files.h>
#include <slipstep/utilities/csv.h>
#include <slipstep/utilities/parameters.h>

#include <vector>

namespace SlipStep
{
  /// The keys of a map, a .prm file that says how the file of an instrument is
  /// to be read: its columns with their units, what it does not record, what
  /// its signs mean. Variants or wildcards convert several files by one map.
  void declare_import_parameters(Parameters &parameters);

  /// Convert one file by a map: read it, convert to base units, take zero and
  /// drift of the sensor off, put the rows in order (see tidy_rows()), cut it
  /// into parts (see cut_record()), count time and displacement from the first
  /// row of each, and resample if the map says so.
  ///
  /// @param name of the file of each test, without folder; the map can have
  ///   another (Test/File). Parts are numbered.
  /// @return the tests, one unless the map cuts the record
  /// @throws InputError naming the place in the map or in the file
  std::vector<MeasuredTest> import_record(const Parameters  &map,
                                          const RawFile     &raw_file,
                                          const std::string &name);
} // namespace SlipStep

#endif
