// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_calibration_calibration_h
#define slipstep_calibration_calibration_h

#include <slipstep/calibration/fit_parameter.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace SlipStep
{
  /// A value with what a profile likelihood tells of it.
  struct ProfileInterval
  {
    double value = 0.;

    /// At the stated confidence. Open where the tests contradict nothing up to
    /// the bound, or up to values that the law refuses: the end is then the
    /// last value tried.
    double lower         = 0.;
    double upper         = 0.;
    bool   is_lower_open = false;
    bool   is_upper_open = false;

    /// (value, increase of the misfit), increasing in value, the optimum
    /// included.
    std::vector<std::pair<double, double>> profile;

    /// The same in other terms of the values, which increase as these do.
    template <typename Conversion>
    ProfileInterval converted(const Conversion &conversion) const
    {
      ProfileInterval result = *this;
      for (double *number : {&result.value, &result.lower, &result.upper})
        *number = conversion(*number);
      for (auto &point : result.profile)
        point.first = conversion(point.first);
      return result;
    }
  };

  /// A fitted parameter with what is known of its uncertainty. Values are in
  /// base units, an increase of 1 is where the interval ends.
  struct FittedParameter : ProfileInterval
  {
    FitParameter parameter;

    /// Standard deviation from the curvature at the optimum: of the value, or
    /// of its natural logarithm where the scale is logarithmic. Infinite if
    /// the tests say nothing.
    double deviation = std::numeric_limits<double>::infinity();

    /// Whether the optimum lies on a bound, or at a constraint.
    bool is_at_bound = false;

    /// The condition of the law, such as mu_k <= mu_s, at which the parameter
    /// stopped, in words; "" if there is none. Intervals then mean nothing.
    std::string constraint = "";

    /// Whether the misfit would fall beyond the constraint.
    bool is_wanted_beyond = false;
  };

  /// A quantity computed from parameters.
  struct DerivedQuantity
  {
    std::string name;
    std::string formula;
    double      value     = 0.; ///< in base units of what it is made of
    double      deviation = 0.; ///< to first order
  };

  /// How well one test is met.
  struct TestMisfit
  {
    std::string name;
    std::string condition;
    std::string file;
    std::size_t n_rows = 0;  ///< compared
    double      noise  = 0.; ///< standard deviation the rows are weighted by
    bool        noise_is_stated = false;
    double      rms             = 0.; ///< of the difference of friction
    double      start_rms       = 0.; ///< with the start values
    double      mean            = 0.; ///< of measured minus simulated
    /// How many rows in a row are off together, 1: independent; of two axes
    /// the larger one.
    double correlation_length = 1.;
    /// Frictional work per area, the integral of friction times pressure over
    /// the displacement [N/mm], over the rows compared.
    double measured_work  = 0.;
    double simulated_work = 0.;

    /// @name The curves, for pictures: all rows compared.
    ///@{
    std::vector<double> time;         ///< [s]
    std::vector<double> displacement; ///< [mm]
    std::vector<double> measured;
    std::vector<double> simulated;
    ///@}

    /// @name Those along the second axis, where there is one, and the noise of
    ///   each by itself.
    ///@{
    std::vector<double> displacement_2, measured_2, simulated_2;
    double              noise_1 = 0., noise_2 = 0.;
    ///@}
  };

  /// One of the starts of the search.
  struct StartResult
  {
    std::vector<double> start; ///< base units
    std::vector<double> end;   ///< base units; empty if it failed
    double       misfit = std::numeric_limits<double>::infinity(); ///< chi^2
    unsigned int iterations = 0;
    std::string  message; ///< why it ended
  };

  /// A combination of parameters that the tests hardly determine.
  struct WeakDirection
  {
    /// Change of each parameter along one standard deviation, in its own
    /// terms: of the natural logarithm if the scale is logarithmic, else of
    /// the value in base units.
    std::vector<double> change;
    /// Those of which it makes up most of the uncertainty.
    std::vector<std::size_t> members;
    /// What that means and what to do.
    std::string words;
  };

  /// Everything that `slipstep calibrate` found.
  struct Calibration
  {
    std::vector<FittedParameter> parameters;
    std::vector<DerivedQuantity> derived;
    std::vector<TestMisfit>      tests;
    std::vector<StartResult>     starts; ///< best first
    std::vector<WeakDirection>   weak;   ///< worst first
    /// Correlation of the parameters as they are scaled; 0 for one of which
    /// nothing is known.
    std::vector<std::vector<double>> correlation;

    double      misfit       = 0.; ///< chi^2, squares of residual over noise
    double      start_misfit = 0.;
    std::size_t n_rows       = 0;
    /// Rows that count as independent.
    double n_effective = 0.;
    /// Factor on all variances, because the residuals are larger than the noise
    /// or hang together; 1 if they are what noise would be.
    double inflation  = 1.;
    double confidence = 0.95;

    unsigned int             n_simulations = 0;  ///< of the whole campaign
    unsigned int             n_steps       = 0;  ///< contact updates of one
    double                   wall_time     = 0.; ///< [s]
    double                   cpu_time      = 0.; ///< [s]
    std::vector<std::string> warnings;
  };

  /// Difference over noise, NaN without noise.
  double noise_ratio(const TestMisfit &test);

  /// Where a start of the search ended, seen from where the best one did.
  struct StartComparison
  {
    double      excess   = 0.; ///< of chi^2
    double      distance = 0.; ///< largest, of the range between the bounds
    std::size_t farthest = 0;  ///< the parameter with this distance
    bool        has_end  = false;
    bool        is_same  = false; ///< the same optimum
    bool        is_equal = false; ///< as good, in the same place or not
  };

  /// For every start, the best one first.
  std::vector<StartComparison> compare_starts(const Calibration &calibration);

  /// Which parameters stopped at which condition of the law, and what to do.
  std::vector<std::string> constraint_sentences(const Calibration &calibration);
} // namespace SlipStep

#endif
