// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_model_h
#define slipstep_diagnosis_model_h

#include <slipstep/calibration/simulator.h>
#include <slipstep/diagnosis/candidates.h>

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

namespace SlipStep
{
  /// A case with parameters fitted to the campaign.
  struct Model
  {
    std::shared_ptr<const Campaign> campaign;
    std::shared_ptr<Simulator>      simulator;
    std::vector<double>             scaled;
    /// What was added to the starting model.
    std::vector<Part> parts;

    /// With a simulator of its own, which fits may change.
    Model copy() const;

    /// The values of the parameters fitted.
    Values values() const;

    /// Whether an effect was added.
    bool has(const std::string &name) const;

    /// The part that a parameter came with; none for one of the starting model.
    const Part *owner_of(const std::string &path) const;

    /// @name After Comparison::fit().
    ///@{
    double          objective = 0.;
    Eigen::VectorXd residual;    ///< whitened, measured minus simulated
    Eigen::MatrixXd derivatives; ///< of what is simulated, per scaled parameter
    ///@}
  };

  /// What tells a fitted model from others.
  struct ModelKey
  {
    explicit ModelKey(const Model &model);

    bool operator==(const ModelKey &other) const
    {
      return scaled == other.scaled && parts == other.parts &&
             objective == other.objective;
    }

    std::vector<double>      scaled;
    std::vector<std::string> parts;
    double                   objective;
  };

  /// The starting model with effects added, for tests that are ingested
  /// already; its search begins at the values of the case, with time steps
  /// for those, whose error stays.
  /// @param like a model that takes at most a few times fewer steps; none: see
  ///   Simulator::plan()
  /// @throws InputError, RunError if it cannot be simulated
  Model make_coarse_model(const Parameters                &start,
                          const std::vector<Part>         &parts,
                          const Values                    &values,
                          const std::vector<CampaignTest> &tests,
                          const Model                     *like = nullptr);

  /// The same without the error of the time steps, by a model that differs in
  /// weak effects only.
  Model make_model(const Parameters                &start,
                   const std::vector<Part>         &parts,
                   const Values                    &values,
                   const std::vector<CampaignTest> &tests,
                   const Model                     &like);
} // namespace SlipStep

#endif
