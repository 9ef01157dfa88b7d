// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_calibration_derived_h
#define slipstep_calibration_derived_h

#include <slipstep/utilities/parameters.h>

#include <string>
#include <vector>

namespace SlipStep
{
  /// A quantity computed from parameters, or a parameter that follows others.
  struct Derived
  {
    std::string name;
    /// With {path of a key} for values in base units.
    std::string formula;
    /// Whether the name is the path of a key.
    bool is_tie = false;
  };

  /// What "Calibration/Derived" lists.
  /// @throws InputError for a formula that cannot be read, a path that does not
  /// exist, or two of a name
  std::vector<Derived> read_derived(const Parameters &parameters);

  /// The value in base units.
  /// @throws InputError
  double evaluate(const Derived &derived, const Parameters &parameters);

  /// Give the tied keys the values that follow from the others, in the order
  /// listed.
  /// @throws InputError if a value is not allowed
  void apply_ties(const std::vector<Derived> &derived, Parameters &parameters);
} // namespace SlipStep

#endif
