#ifndef slipstep_experiment_measured_test_h
#define slipstep_experiment_measured_test_h

#include <slipstep/utilities/exceptions.h>

#include <filesystem>
#include <map>
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
  struct MeasuredTest
  {
    /// "name" of the file's comments, else the file's own name.
    std::string name;
    /// Tests of the same condition are replicates; may be empty.
    std::string condition;
    /// All `key: value` comments.
    std::map<std::string, std::string> notes;

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
  };

  /// Read a test.
  /// @throws InputError naming file:line:column for a missing column, text or
  /// a non-finite value in place of a number, negative pressure, time that does
  /// not increase, or fewer than two rows
  MeasuredTest read_measured_test(const std::filesystem::path &file);
} // namespace SlipStep

#endif
