// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_sensor_zero_h
#define slipstep_measured_data_sensor_zero_h

#include <optional>
#include <string>
#include <vector>

namespace SlipStep
{
  /// Take the zero of a sensor off a friction signal (coefficient or load), the
  /// rows of which may have gaps (NaN). Rows count by the path that they move,
  /// so that rests do not.
  ///
  /// - "mean of strokes": half the sum of the means over the path forth and
  ///   over the path back. Friction that is the same both ways cancels.
  /// - "mean of the first 2 s": what the sensor shows before the test.
  /// - "none"
  ///
  /// @return what was taken off; 0 for "none"
  /// @throws InputError that says what is wrong of the text or of the record
  double take_off_zero(const std::string         &zero,
                       const std::vector<double> &time,
                       const std::vector<double> &displacement,
                       std::vector<double>       &signal);

  /// Whether a record moves, by more than it trembles, in the time that
  /// "mean of the first 2 s" takes.
  bool moves_in_first(const std::string         &zero,
                      const std::vector<double> &time,
                      const std::vector<double> &displacement);

  /// Take a drift that is linear in time off the same, about the middle of the
  /// record: the slope that fits best, by least squares, beside a mean forth
  /// and a mean back.
  /// @param drift "linear" or "none"
  /// @return the slope [1/s]; 0 for "none"
  double take_off_drift(const std::string         &drift,
                        const std::vector<double> &time,
                        const std::vector<double> &displacement,
                        std::vector<double>       &signal);
  /// What is left of friction that has one sign whichever way it slides.
  struct OneSign
  {
    double forth, back; ///< means
    double scatter;     ///< within the strokes of one way
  };

  /// Friction that is steady and of one sign whichever way the contact slides:
  /// it has lost its sign, or a zero of the sensor is larger than it is. An
  /// elastic contact that is pushed to and fro has friction of one sign, too,
  /// but that goes with the displacement; and what only trembles does not
  /// slide.
  /// @return nothing if it is not like that
  std::optional<OneSign>
  friction_of_one_sign(const std::vector<double> &time,
                       const std::vector<double> &displacement,
                       const std::vector<double> &friction);

  /// Give the sign of the last motion to friction that was recorded without.
  /// The newest row may stand first.
  /// @throws InputError if it does not move
  void give_sign_of_motion(const std::vector<double> &time,
                           const std::vector<double> &displacement,
                           std::vector<double>       &friction);
} // namespace SlipStep

#endif
