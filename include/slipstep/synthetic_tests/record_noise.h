// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_synthetic_tests_record_noise_h
#define slipstep_synthetic_tests_record_noise_h

#include <slipstep/measured_data/measured_test.h>
#include <slipstep/synthetic_tests/influence.h>

#include <string>
#include <vector>

namespace SlipStep
{
  namespace Planting
  {
    /// Departures of the noise from the usual.
    enum class NoiseKind
    {
      normal,
      heavy_tails, ///< white noise is Student's t with three degrees of freedom
      two_drifts,  ///< one drift is quick, another slow
      /// Rows hang together: 0.8 of each is what the row before it had.
      correlated_rows,
      /// The drift forgets within 10 s, however long a test is.
      drift_in_seconds,
      /// Positions are recorded to 0.01 mm.
      rounded_motion,
      /// Sensors of position and pressure are noisy, too.
      noisy_sensors,
      /// Half the variance of rows is a hum of 50 Hz.
      hum
    };

    /// "heavy_tails"
    std::string to_string(const NoiseKind kind);

    /// @throws InputError naming the nearest if there is none
    NoiseKind noise_kind(const std::string &name);

    /// Noise of a campaign's records. Standard deviations, relative to the mean
    /// friction of a test unless said.
    struct NoiseLevels
    {
      NoiseKind kind  = NoiseKind::normal;
      double    white = 0.01;  ///< of every row
      double    drift = 0.005; ///< Ornstein-Uhlenbeck, of all drifts together
      double    gain  = 0.006; ///< of a test, factor on its friction
      double offset = 0.002; ///< of a test, relative to the static coefficient
      double position = 0.;  ///< of every row [mm]
      double pressure = 0.;  ///< of every row, relative to the pressure
      /// Correlation times of the drifts over the duration of a test; in
      /// seconds of kind drift_in_seconds.
      std::vector<double> correlation_times;
    };

    /// What stays the same throughout one record.
    struct RecordNoise
    {
      double gain     = 0.;
      double offset_x = 0., offset_y = 0.;
    };

    /// Levels of one campaign.
    NoiseLevels
    draw_levels(const NoiseKind kind, const double factor, Random &random);

    RecordNoise draw_record_noise(const NoiseLevels &levels,
                                  const double       static_coefficient,
                                  Random            &random);

    /// Noise of rows at given times [s], of standard deviation 1: white but for
    /// kinds correlated_rows and hum.
    std::vector<double> row_noise(const std::vector<double> &times,
                                  const NoiseKind            kind,
                                  Random                    &random);

    /// A stationary Ornstein-Uhlenbeck process of standard deviation 1 at given
    /// times [s].
    std::vector<double> drift_noise(const std::vector<double> &times,
                                    const double               correlation_time,
                                    Random                    &random);

    /// One axis of a record: (1 + gain) friction + offset + drift + white.
    /// @param mean mean magnitude of the friction of the test
    std::vector<double> noisy_record(const std::vector<double> &times,
                                     const std::vector<double> &friction,
                                     const double               mean,
                                     const double               gain,
                                     const double               offset,
                                     const NoiseLevels         &levels,
                                     Random                    &random);

    /// What the instruments of position and pressure make of a test: few
    /// digits, or noise.
    void record_loading(const NoiseLevels &levels,
                        Random            &random,
                        MeasuredTest      &test);
  } // namespace Planting
} // namespace SlipStep

#endif
