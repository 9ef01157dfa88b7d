// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_calibration_campaign_h
#define slipstep_calibration_campaign_h

#include <slipstep/calibration/derived.h>
#include <slipstep/calibration/fit_parameter.h>
#include <slipstep/experiment/machine.h>
#include <slipstep/experiment/replay.h>
#include <slipstep/friction/law.h>
#include <slipstep/measured_data/friction_axes.h>
#include <slipstep/measured_data/mains_hum.h>
#include <slipstep/measured_data/test_rows.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace SlipStep
{
  /// A measured test, prepared for comparison.
  struct CampaignTest
  {
    /// Only the rows that are compared.
    MeasuredTest rows;
    /// Along which friction is compared, with the noise by which differences
    /// are weighted.
    std::vector<FrictionAxis> axes;
    bool                      noise_is_stated = false;
    /// Leads the contact point; with the fewer rows that resample() leaves.
    Replay replay;
    /// To which its positions were rounded, coarsely [mm]; 0 if they were not.
    double   motion_step = 0.;
    Rounding rounding    = {}; ///< of its friction
    /// The hum of the mains in the friction of each axis, taken off where it
    /// can be told; empty without any.
    std::vector<Hum> hum = {};

    /// Friction along an axis.
    std::vector<double> friction(const FrictionAxis &axis) const
    {
      return axis.of(rows.friction, rows.friction_y);
    }

    std::size_t n_residuals() const
    {
      return rows.time.size() * axes.size();
    }

    /// Root mean square of differences of friction, given over the noise, the
    /// rows of one axis after those of the other.
    double root_mean_square(const double *weighted) const;
  };

  /// What neighbouring rows scatter by, over the noise that is stated: the
  /// median of the tests of which it is; 1 without any. Rows of few that were
  /// kept for their bends do not count.
  double scatter_over_stated(const std::vector<CampaignTest> &tests);

  /// The tests of a case and the parameters to be found from them.
  class Campaign
  {
  public:
    /// @throws InputError for tests that cannot be read, fewer rows than
    /// parameters, or anything wrong with section "Calibration"
    explicit Campaign(const Parameters &parameters);

    /// The same with tests that have been read and prepared already.
    Campaign(const Parameters                &parameters,
             const std::vector<CampaignTest> &tests);

    /// The same with these to be fitted, whatever the case lists.
    Campaign(const Parameters                &parameters,
             const std::vector<FitParameter> &fitted,
             const std::vector<CampaignTest> &tests);

    const Parameters                parameters;
    const std::vector<FitParameter> fitted;
    const std::vector<Derived>      derived;
    std::vector<CampaignTest>       tests;

    /// Rows compared, along every axis.
    std::size_t n_residuals() const;

    /// Largest error of a step while searching, see Replay::plan().
    const double search_tolerance;

    /// The scaled values of the starts.
    std::vector<double> scaled_start() const;

    /// What was done to the rows of the tests, and what the model makes of
    /// them.
    std::vector<std::string> warnings() const;

    /// The tests that Calibration/Tests names, ready to be simulated.
    /// @throws InputError if one cannot be read or its noise makes no sense
    static std::vector<CampaignTest> read_tests(const Parameters &parameters);

    /// Calibration/Noise, 0 if it is to be estimated.
    /// @throws InputError if it is neither
    static double stated_noise(const Parameters &parameters);

    /// What a comment of the test says of its noise, 0 if nothing.
    /// @throws InputError if that is not a number greater than 0
    static double noted_noise(const MeasuredTest &test);

    /// Paths of the tests' files.
    static std::vector<std::filesystem::path>
    test_files(const Parameters &parameters);
  };

  /// That tests begin at different positions, of which effects that depend on
  /// the position know nothing; "" if they do not.
  std::string warning_of_positions(const std::vector<CampaignTest> &tests);
} // namespace SlipStep

#endif
