// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_sensor_zero_h
#define slipstep_diagnosis_sensor_zero_h

#include <slipstep/diagnosis/workspace.h>

#include <optional>

namespace SlipStep
{
  /// What the sensor of friction would have shown without any.
  struct SensorZero
  {
    double value   = 0.;    ///< in all rows of all tests
    bool   is_load = false; ///< [MPa] over the pressure; else friction itself
  };

  /// A zero of the sensor by which the starting model explains the tests as
  /// well as it does with the effects found, or, where none was, what it
  /// leaves. It looks like an effect: of direction where motion turns, else
  /// like a share that does not depend on pressure.
  /// @param base the starting model, fitted
  /// @param found the model with the effects named
  /// @param excess of the objective that makes the gap
  std::optional<SensorZero> find_sensor_zero(const Workspace &workspace,
                                             const Model     &base,
                                             const Model     &found,
                                             const double     excess);
} // namespace SlipStep

#endif
