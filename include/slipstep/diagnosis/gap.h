// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_gap_h
#define slipstep_diagnosis_gap_h

#include <slipstep/diagnosis/candidate_scores.h>
#include <slipstep/diagnosis/diagnosis.h>
#include <slipstep/diagnosis/rules.h>
#include <slipstep/diagnosis/track_waves.h>

#include <algorithm>

namespace SlipStep
{
  /// With what later stages ask of it.
  struct GapTest : Gap
  {
    double          scatter = 0.; ///< of the excess, by chance
    Eigen::VectorXd explained;    ///< that part of the residual, whitened

    /// What of the excess may be chance: two standard deviations.
    double slack() const
    {
      return std::max(sure_excess, 2. * scatter);
    }
  };

  /// The chance that replicates agree as much in what a model leaves: their
  /// noise is independent, so that what they have in common is not noise,
  /// whatever its shape and whatever kind of noise it is. 1 without replicates.
  /// @param residual whitened
  double chance_of_agreement(const Comparison      &comparison,
                             const Eigen::VectorXd &residual,
                             const RowMatrix       &null_draws);

  /// Find the directions along which gaps are looked for, whatever the model;
  /// again when draws of noise or weights have changed.
  void prepare_gap_test(Workspace &workspace);

  /// The wave along the track that a model leaves, if that is evidence of a gap
  /// by itself, with the wavelength that explains most; else its wavelength is
  /// 0.
  TrackWave clear_track_wave(const Workspace &workspace, const Model &model);

  /// Whether a model leaves more than noise, with what is seen from it.
  GapTest
  test_gap(const Workspace &workspace, const Model &model, const View &view);
} // namespace SlipStep

#endif
