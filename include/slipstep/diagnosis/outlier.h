// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_outlier_h
#define slipstep_diagnosis_outlier_h

#include <slipstep/diagnosis/noise.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace SlipStep
{
  /// Replicates that differ by more than the noise of the others.
  struct Contradiction
  {
    std::vector<std::size_t> tests;
    double                   chance = 1.;
    Noise                    noise; ///< of the others
  };

  /// The worst contradiction among replicates, judged by noise that is
  /// estimated without it; none if chance makes such differences, or if there
  /// are fewer than three contrasts.
  /// @param present estimated with all, to look for the worst
  /// @param prior see estimate_noise()
  std::optional<Contradiction>
  find_contradiction(const std::vector<Contrast> &contrasts,
                     const Noise                 &present,
                     const Noise                 &prior,
                     const std::uint64_t          seed);

  /// Squares of the slow part of what is whitened by a noise: of a contrast, or
  /// of what a model leaves of one test.
  double slow_squares(const Contrast &contrast, const Noise &noise);
} // namespace SlipStep

#endif
