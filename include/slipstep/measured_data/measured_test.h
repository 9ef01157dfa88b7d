// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_measured_test_h
#define slipstep_measured_data_measured_test_h

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/units.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace SlipStep
{
  /// A friction test as recorded: time series of equal length, and what its
  /// file says about it. A simulated history.csv reads as one, too.
  ///
  /// File: `# key: value` lines (name, condition, source, licence), then the
  /// columns time_s, displacement_mm, pressure_MPa, friction and, if wanted,
  /// displacement_y_mm, friction_y, temperature_C. Friction is tangential over
  /// normal load, positive where it resists motion in the positive direction.
  ///
  /// Other units may stand in the header (displacement_um, "Time [ms]",
  /// "pressure (kPa)"). Columns are separated by commas, semicolons, tabs or
  /// blanks; where it is not a comma, decimals may have one.
  struct MeasuredTest
  {
    /// "name" of the file's comments, else the file's own name.
    std::string name;
    /// Tests of the same condition are replicates; may be empty.
    std::string condition;
    /// All `key: value` comments.
    std::map<std::string, std::string> notes;
    /// The file it was read from.
    std::filesystem::path file;

    std::vector<double> time;         ///< increasing [s]
    std::vector<double> displacement; ///< [mm]
    std::vector<double> pressure;     ///< nominal, compression > 0 [MPa]
    std::vector<double> friction;

    /// @name Empty where the file has no such column.
    ///@{
    std::vector<double> displacement_y; ///< [mm]
    std::vector<double> friction_y;
    std::vector<double> temperature; ///< [degC]
    ///@}

    /// What was done to the rows, see tidy_rows(): a line each, to be shown.
    std::vector<std::string> warnings;

    /// As which test of its campaign it was made, if a comment says so
    /// ("order").
    std::optional<double> order() const;
  };

  /// One of the time series of a test.
  struct Channel
  {
    std::string         name; ///< in a header, without unit
    Dimension           dimension;
    std::string         unit; ///< that is written, as part of the column's name
    bool                is_required;
    std::vector<double> MeasuredTest::*values;

    /// "displacement_mm"
    std::string column() const;
  };

  /// Time, displacement, pressure, friction, then the optional ones.
  const std::vector<Channel> &channels();

  /// A name in a header: "displacement" and "mm" of "Displacement [mm]".
  struct Heading
  {
    std::string name; ///< lower case, blanks as underscores
    std::string unit; ///< as written; "" if there is none in brackets
    bool        has_brackets = false;
  };

  /// Take the unit in brackets or parentheses off a name in a header.
  Heading split_heading(const std::string &cell);

  /// Read a test, with its rows put in order, see tidy_rows().
  /// @throws InputError naming file:line:column for a missing column or unit,
  /// text or an infinite value in place of a number, time that goes backwards,
  /// pressure that is not positive, friction of the wrong sign throughout, or
  /// fewer than two rows
  MeasuredTest read_measured_test(const std::filesystem::path &file);

  /// Write a test; a file of that name is replaced in one go.
  /// @param n_digits significant digits of numbers, 0: all that it takes to
  ///   read them back exactly; times get three more
  /// @throws InputError if the folder cannot be written to, RunError if the
  /// disk
  ///   is full
  void write_measured_test(const std::filesystem::path &file,
                           const MeasuredTest          &test,
                           const unsigned int           n_digits = 0);
} // namespace SlipStep

#endif
