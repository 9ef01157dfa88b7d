// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_covariate_h
#define slipstep_diagnosis_covariate_h

#include <Eigen/Core>

#include <string>
#include <vector>

namespace SlipStep
{
  /// What happens at a row.
  enum class Phase
  {
    presliding, ///< the first flank
    peak,
    softening, ///< friction still falls, or rises, after the peak
    steady,
    hold,
    restart, ///< the flank after a hold
    reversal ///< the flank after a change of direction
  };

  std::string name_of(const Phase phase);

  /// Whether friction rises towards sliding.
  bool is_flank(const Phase phase);

  struct Covariates;

  /// What a difference may depend on.
  struct Covariate
  {
    std::string     name; ///< "slip since start"
    std::string     unit; ///< as shown, "deg" of what is in rad
    Eigen::VectorXd Covariates::*values;
    bool                         is_logarithmic;
    bool                         is_rare; ///< near zero in most rows
    /// What effect expression calls it; "" if that does not know it.
    std::string in_expression;
    /// Where that is, with * for values: "at speeds of *".
    std::string words;

    /// A value in the unit.
    double shown(const double value) const;
  };

  /// In the order in which they are looked at.
  const std::vector<Covariate> &all_covariates();

  const Covariate &covariate_called(const std::string &name);

  /// @param name as effect expression has it
  const Covariate &covariate_in_expression(const std::string &name);
} // namespace SlipStep

#endif
