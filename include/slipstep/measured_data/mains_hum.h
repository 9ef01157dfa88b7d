// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_mains_hum_h
#define slipstep_measured_data_mains_hum_h

#include <vector>

namespace SlipStep
{
  /// The wave that the mains leave in a series of friction. Rows further apart
  /// than half its period see it as a slower wave, which looks like friction.
  struct Hum
  {
    double frequency = 0.; ///< [Hz]; 0 without any
    double mains     = 0.; ///< nominal [Hz]; 0 if it is none of the mains
    double amplitude = 0.; ///< of the friction coefficient
    double phase     = 0.; ///< [rad] of the cosine, at the first row
    /// Not so where the rows see it as slow as friction itself, or noise hides
    /// it: the amplitude is then the one that other series have, and nothing is
    /// known of the phase.
    bool is_told = false;

    /// @param time [s] since the first row
    double at(const double time) const;
  };

  /// What a model leaves of a series of friction.
  struct HumSeries
  {
    std::vector<double> time;       ///< [s], rising
    std::vector<double> left;       ///< measured less simulated
    std::vector<double> friction;   ///< simulated; empty: constant
    double              level = 1.; ///< of friction, which a hum is a share of
    double              speed = 0.; ///< on average [mm/s]
  };

  /// The hum of the mains (50 or 60 Hz, or the double) in every series, in
  /// their order; empty if there is none.
  ///
  /// It is found by its frequency: in the spectrum of a series it stands above
  /// its neighbours, which a smooth remainder does not. It must do so in more
  /// series than chance allows (1e-5). A series in which friction itself has a
  /// wave of that frequency, as by strokes forth and back, says nothing; and
  /// unless there are such of several speeds, its phase must not be the same in
  /// those of one motion, as that of a wave along the track is.
  std::vector<Hum> find_mains_hum(const std::vector<HumSeries> &series);

  /// The same of any frequency that rows see as it is, as that of the mains is
  /// in step with rows but for a tenth of a hertz: it has to be in the
  /// differences of replicates, beyond what a gain makes, and at two speeds, or
  /// it could be of tracks that begin elsewhere. A peak of one of them, with a
  /// chance of less than 1e-3, is held against all others (1e-3).
  ///
  /// @param at_one_speed frequency [Hz] of what is at one speed alone; 0 without
  std::vector<Hum>
  find_hum_of_replicates(const std::vector<HumSeries> &differences,
                         const std::vector<HumSeries> &series,
                         double                       &at_one_speed);
} // namespace SlipStep

#endif
