#ifndef slipstep_diagnosis_prove_h
#define slipstep_diagnosis_prove_h

#include <slipstep/calibration/advice.h>
#include <slipstep/diagnosis/diagnosis.h>
#include <slipstep/diagnosis/judge.h>

#include <optional>
#include <string>
#include <vector>

namespace SlipStep
{
  /// All fitted parameters of a model: those of added effects with intervals
  /// by profile likelihood, the others from the curvature.
  std::vector<DiagnosedParameter> find_intervals(const Workspace &workspace,
                                                 const Model     &model,
                                                 const double     confidence);

  /// The whole catalogue with what became of every effect.
  std::vector<CandidateResult>
  candidate_results(const Workspace                       &workspace,
                    const Judgement                       &judgement,
                    const std::vector<DiagnosedParameter> &parameters,
                    const Model                           &base);

  /// How far apart two models predict a test, in standard deviations, given
  /// the noise and how well their parameters are known.
  double separation(const Workspace    &workspace,
                    const Model        &a,
                    const Model        &b,
                    const MeasuredTest &motion);

  /// The test that tells the winner from its rivals: the cheapest in time of
  /// those by which all are five standard deviations apart, else the one that
  /// separates most.
  NextTest propose_next_test(const Workspace          &workspace,
                             const Model              &winner,
                             const std::vector<Rival> &rivals);

  /// The free-form correction of one covariate, cause unknown.
  struct Correction
  {
    std::string covariate, formula;
    Model       model;
    double      share = 0.; ///< of the excess that it takes away
  };

  /// @return none if it takes away less than half
  std::optional<Correction>
  find_correction(const Workspace                 &workspace,
                  const Model                     &base,
                  const Judgement                 &judgement,
                  const std::vector<Localisation> &where);
} // namespace SlipStep

#endif
