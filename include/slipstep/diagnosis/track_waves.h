// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_track_waves_h
#define slipstep_diagnosis_track_waves_h

#include <slipstep/diagnosis/covariates.h>
#include <slipstep/diagnosis/score_test.h>

#include <vector>

namespace SlipStep
{
  /// Friction that changes along the track, and comes back wherever the track
  /// does: a pattern of the surface, a bent slide, a screw that is not round.
  struct TrackWave
  {
    /// Chance of a wave of any length as clear.
    double p          = 1.;
    double wavelength = 0.; ///< of the clearest [mm]; 0 if nothing moves
    double score      = 0.; ///< of that, see Score::value
  };

  /// Wavelengths from half of the usual track downwards [mm]; none if nothing
  /// moves.
  std::vector<double> track_wavelengths(const Comparison &comparison,
                                        const Covariates &covariates);

  /// Waves over the position, times friction, where rows are close enough to
  /// tell them: four of each wavelength, an eighth of it apart.
  std::vector<Direction> track_waves(const Comparison          &comparison,
                                     const Covariates          &covariates,
                                     const std::vector<double> &wavelengths);

  /// @param waves of these wavelengths
  TrackWave find_track_wave(const DirectionSet        &waves,
                            const std::vector<double> &wavelengths,
                            const Model               &model,
                            const RowMatrix           &null_draws);

  /// The wavelength next to one of track_wavelengths() that explains most: on
  /// a track of many waves a little less or more is out of step at its end.
  double refined_wavelength(const Comparison &comparison,
                            const Covariates &covariates,
                            const Model      &model,
                            const double      wavelength);
} // namespace SlipStep

#endif
