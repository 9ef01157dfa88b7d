// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_look_alike_h
#define slipstep_diagnosis_look_alike_h

#include <optional>
#include <string>

namespace SlipStep
{
  struct Model;
  struct Workspace;

  /// What is no missing effect, but looks like one.
  struct LookAlike
  {
    enum class Kind
    {
      friction_zero, ///< of the sensor, in all rows of all tests
      load_zero,     ///< likewise [MPa], over the pressure
      held_parameter ///< of the starting model, not fitted
    };

    Kind   kind;
    double value = 0.;

    /// @name Of a parameter: its path, and values as they stand in a case.
    ///@{
    std::string path = "", held_text = "", text = "";
    /// The name in whose place it explains the tests beside the others, "" if
    /// it needs none of them.
    std::string instead_of = "";
    ///@}
  };

  /// What makes the starting model explain the tests as well as it does with
  /// the effects found, or, where none was, what it leaves. A zero of the
  /// sensor looks like an effect of direction where motion turns, else like a
  /// share that does not depend on pressure; a wrong value that the case holds
  /// like what else changes friction with the same conditions.
  /// @param base the starting model, fitted
  /// @param found the model with the effects named
  /// @param excess of the objective that makes the gap
  std::optional<LookAlike> find_look_alike(Workspace   &workspace,
                                           const Model &base,
                                           const Model &found,
                                           const double excess);
} // namespace SlipStep

#endif
