// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_record_parts_h
#define slipstep_measured_data_record_parts_h

#include <slipstep/measured_data/measured_test.h>

#include <string>
#include <vector>

namespace SlipStep
{
  /// Rows of a record that become a test of their own.
  struct RecordPart
  {
    std::size_t begin, end; ///< the first row, and the one behind the last
  };

  /// Cut a record, of which time and displacement are filled and in order.
  ///
  /// - "none": one part
  /// - "at reversals": a part for each stroke, from where the motion turns on,
  ///   with the rest there, if there is one
  /// - "every 5 cycles": the same for so many strokes forth and back; rows
  ///   before the first turn and after the last full part are left out
  /// - "at holds of 2 s": a part begins where a rest of at least so long does
  /// - "after holds of 2 s": a part begins with the last row of such a rest
  /// - "at 10 s, 20 s": at the first row from there on, by the record's clock
  ///
  /// Motion is what is larger than the tremble of the position: four times its
  /// noise_level(), and at least 1e-4 of the range (0.5 % for reversals).
  /// @param clock that the record's clock had at its time 0 [s]
  /// @throws InputError that says what is wrong of the text or of the record
  std::vector<RecordPart> cut_record(const MeasuredTest &record,
                                     const std::string  &cut,
                                     const double        clock = 0.);

  /// The parts that "2, 4, 6 to 8" names, counted from 1; "all".
  /// @throws InputError
  std::vector<std::size_t> chosen_parts(const std::string &text,
                                        const std::size_t  n_parts);
} // namespace SlipStep

#endif
