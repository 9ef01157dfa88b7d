// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_free_factor_h
#define slipstep_diagnosis_free_factor_h

#include <slipstep/diagnosis/verdict.h>

#include <optional>
#include <string>

namespace SlipStep
{
  /// A free factor of friction along one covariate of effect `expression`,
  /// piecewise linear between a few knots, added to a model and fitted.
  struct FreeFactor : Correction
  {
    Model model; ///< with the factor
  };

  /// @param covariate of effect expression
  /// @param corrects the effect of the model whose formula it completes; "" if
  ///   its cause is unknown
  /// @return none if the tests do not vary the covariate, chance explains what
  ///   it would change, or nothing is gained
  std::optional<FreeFactor> add_free_factor(const Workspace   &workspace,
                                            const Model       &model,
                                            const std::string &covariate,
                                            const std::string &corrects = "");

  /// For the part of a model whose formula leaves most along its own covariate;
  /// none if no formula does.
  std::optional<FreeFactor> complete_formula(const Workspace &workspace,
                                             const Model     &model);

  /// What has no name, described along the covariate where most of it is.
  /// @return none if it takes away less than half
  std::optional<FreeFactor>
  find_correction(const Workspace                 &workspace,
                  const Model                     &base,
                  const Judgement                 &judgement,
                  const std::vector<Localisation> &where);
} // namespace SlipStep

#endif
