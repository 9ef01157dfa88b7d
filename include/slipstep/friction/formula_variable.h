// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_friction_formula_variable_h
#define slipstep_friction_formula_variable_h

#include <slipstep/friction/effect.h>

#include <functional>
#include <string>
#include <vector>

namespace SlipStep
{
  /// What a formula of the user's own may be a function of.
  struct FormulaVariable
  {
    std::string name;
    std::string words; ///< with its unit, behind the name

    /// At the end of a step, with the derivatives. The length is that of slip
    /// after which a contact is new [mm].
    std::function<Strength(const SlipStepData &step, const double length)>
      value;

    /// The same of a state, where a step leads through all values between those
    /// of its ends; may be empty.
    std::function<double(const ContactState &)> reached = {};

    /// What has to be remembered: the value at the end of the last step.
    std::vector<ContactMemory> memories = {};

    /// The effect without which there is none; "" if there is always one.
    std::string of_effect = "";
  };

  /// All of them.
  const std::vector<FormulaVariable> &formula_variables();
} // namespace SlipStep

#endif
