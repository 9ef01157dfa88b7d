// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_record_layout_h
#define slipstep_measured_data_record_layout_h

#include <filesystem>
#include <string>
#include <vector>

namespace SlipStep
{
  /// How the text of a record is laid out, as far as looking at it tells.
  /// Lines are counted from 1; 0: there is none.
  struct RecordLayout
  {
    char                     delimiter      = '\0';
    char                     decimal_mark   = '\0'; ///< 0: no number has any
    char                     thousands_mark = '\0';
    std::size_t              header_line    = 0;
    std::size_t              units_line     = 0;
    std::size_t              first_row      = 0;
    std::size_t              n_rows         = 0;
    std::size_t              n_cells        = 0;
    std::vector<std::string> comment_marks;
    /// Whether the decimal mark may as well part thousands, or the mark of
    /// thousands decimals.
    bool has_doubtful_marks = false;
    /// Whether names have blanks, so that there are more words than columns.
    bool has_unclear_header = false;
    /// Of such a header the names of the columns, if two blanks or more part
    /// as many as there are columns; else none.
    std::vector<std::string> names;
    /// Columns with numbers, counted from 0.
    std::vector<std::size_t> numbers;
    /// The first column with times of a clock, counted from 1, and the orders
    /// of day and month that they may have, see Clock.
    std::size_t              clock = 0;
    std::vector<std::string> date_orders;
  };

  /// Look for the largest table of numbers in a text file.
  /// @throws InputError if the file cannot be read or has no such table
  RecordLayout record_layout(const std::filesystem::path &file);
} // namespace SlipStep

#endif
