// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_comparison_h
#define slipstep_diagnosis_comparison_h

#include <slipstep/diagnosis/model.h>
#include <slipstep/diagnosis/noise.h>
#include <slipstep/measured_data/row_noise.h>

#include <Eigen/Core>

#include <limits>
#include <string>
#include <vector>

namespace SlipStep
{
  /// Where a test stands in the numbers that are compared.
  struct ComparedTest
  {
    /// The first row of the record of every number, and the end.
    std::vector<std::size_t> borders;
    std::vector<Series>      series;     ///< one per axis that is measured
    double                   level = 1.; ///< typical friction
    Eigen::Index             begin = 0;
    Eigen::Index             size  = 0; ///< all axes
    /// Tests of the same number are replicates.
    std::size_t condition = 0;
    Rounding    rounding; ///< of friction

    std::size_t n_bins() const
    {
      return borders.size() - 1;
    }

    bool has_row(const Eigen::Index row) const
    {
      return row >= begin && row < begin + size;
    }

    /// Of the rows of a number.
    std::size_t middle_row(const std::size_t bin) const
    {
      return (borders[bin] + borders[bin + 1]) / 2;
    }
  };

  /// For each time that of another test that is nearest to it; both rise.
  std::vector<std::size_t> partners(const std::vector<double> &time,
                                    const std::vector<double> &other);

  /// The measured friction of a campaign, against which models are held: noise
  /// is whitened, rows beyond a few hundred per test are averaged.
  class Comparison
  {
  public:
    /// @param most_rows of a test and axis
    Comparison(const std::vector<CampaignTest> &tests,
               const std::size_t                most_rows = 300);

    std::vector<ComparedTest> tests;
    std::vector<std::string>  conditions; ///< their names
    Eigen::VectorXd           measured;   ///< averaged, all tests in a row
    double                    usual_duration = 1.; ///< of tests [s]
    /// 1 of every number, 0 of those that weaken_row() made count for less:
    /// they are in no mean that is told.
    Eigen::VectorXd counts;
    /// When fit() ends with the best that it has.
    std::chrono::steady_clock::time_point deadline =
      std::chrono::steady_clock::time_point::max();

    /// Take this for the noise of the rows of a test, along one of its axes.
    void set_row_noise(const std::size_t test,
                       const std::size_t axis,
                       const RowNoise   &noise);

    /// The numbers that are compared, of these tests with other friction.
    Eigen::VectorXd
    means_of(const std::vector<CampaignTest> &campaign_tests) const;

    /// Multiply the noise of one of the numbers compared, which nothing
    /// explains.
    /// It is felt after set_noise().
    void weaken_row(const Eigen::Index row, const double factor);

    /// Weigh by this noise from now on; a gain multiplies @p friction.
    void set_noise(const Noise &noise, const Eigen::VectorXd &friction);

    const Noise &noise() const
    {
      return present_noise;
    }

    /// Simulated minus measured friction; empty if it cannot be simulated.
    Eigen::VectorXd difference(Simulator                 &simulator,
                               const std::vector<double> &scaled) const;

    /// The same of a model.
    Eigen::VectorXd difference(const Model &model) const
    {
      return difference(*model.simulator, model.scaled);
    }

    /// Whiten columns of friction of all tests.
    void whiten(RowMatrix &columns) const;

    /// How far a fit goes, as in least_squares().
    struct FitEnd
    {
      FitEnd(const double precision,
             const double goal = std::numeric_limits<double>::infinity())
        : precision(precision)
        , goal(goal)
      {}

      double precision, goal; ///< of the objective
    };

    /// Fit all parameters of a model, starting from those that it has.
    /// @param left_out tests that do not count
    /// @param held parameters that stay
    /// @return whether there is anything that can be simulated
    bool fit(Model                   &model,
             const FitEnd            &end,
             const std::vector<bool> &left_out = {},
             const std::vector<bool> &held     = {}) const;

    /// The squares of a model's whitened differences, by test.
    std::vector<double> squares_by_test(const Eigen::VectorXd &residual) const;

    /// Differences between replicates of measured minus simulated friction, or
    /// of measured friction where a model that is far off makes them larger.
    std::vector<Contrast> contrasts(const Eigen::VectorXd &difference) const;

    /// Numbers compared that are spikes(), as measured.
    std::vector<Eigen::Index> spikes_of_records() const;

    Eigen::Index n_rows() const
    {
      return measured.size();
    }

  private:
    void find_durations(const std::vector<CampaignTest> &campaign_tests);

    Noise                 present_noise;
    std::vector<Whitener> whiteners;
  };

  /// Root mean square of differences, as a share of the tests' friction.
  double relative_rms(const Comparison      &comparison,
                      const Eigen::VectorXd &difference);

  /// The same of what a model differs from the tests by.
  double relative_rms(const Comparison &comparison, const Model &model);

  /// By this factor a fit that has lost the tests is farther off than another.
  constexpr double lost_fit = 1.2;

  /// d (natural parameter) / d (scaled parameter), natural being the logarithm
  /// of positive parameters.
  double natural_slope(const FitParameter &parameter, const double scaled);
} // namespace SlipStep

#endif
