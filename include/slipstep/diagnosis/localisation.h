// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_localisation_h
#define slipstep_diagnosis_localisation_h

#include <slipstep/diagnosis/diagnosis.h>
#include <slipstep/diagnosis/verdict.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace SlipStep
{
  /// From where to where sizes are at least half of the one at @p top, which is
  /// not negative, without a gap.
  /// @param sizes by the value of a covariate, @p top among them
  std::pair<double, double> range_around(const std::map<double, double> &sizes,
                                         const double                    top);

  /// Where a model disagrees: every covariate that explains a part of the
  /// excess, most first.
  std::vector<Localisation>
  localise(const Workspace &workspace, const Model &model, const GapTest &gap);

  /// Names with changes of the simulated friction.
  using Changes = std::vector<std::pair<std::string, Eigen::VectorXd>>;

  /// What is left over along the covariates, with what models would change.
  std::vector<CovariatePanel>
  covariate_panels(const Workspace                 &workspace,
                   const Eigen::VectorXd           &difference,
                   const Changes                   &changes,
                   const std::vector<Localisation> &where);

  /// Along one of them; empty if it hardly varies.
  CovariatePanel covariate_panel(const Workspace       &workspace,
                                 const Eigen::VectorXd &difference,
                                 const Changes         &changes,
                                 const Covariate       &covariate);
} // namespace SlipStep

#endif
