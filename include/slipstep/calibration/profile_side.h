// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_calibration_profile_side_h
#define slipstep_calibration_profile_side_h

#include <slipstep/calibration/calibration.h>

#include <Eigen/Core>

#include <chrono>
#include <functional>
#include <map>
#include <vector>

namespace SlipStep
{
  /// Where a misfit that rises with the distance from its optimum reaches the
  /// threshold.
  struct RiseEnd
  {
    double distance = 0.;
    /// It was not reached: the last distance at which there was a value.
    bool is_open = false;
  };

  /// @param rise in units of the threshold, infinite where there is no value
  /// @param first_distance a guess
  /// @param room largest distance
  RiseEnd follow_rise(const std::function<double(const double)> &rise,
                      const double                               first_distance,
                      const double                               room);

  /// Thrown where a profile takes too long.
  struct OutOfTime
  {};

  /// One side of a profile likelihood: a parameter is moved away from the
  /// optimum while all others are fitted again, until the misfit has risen by
  /// the threshold.
  class ProfileSide
  {
  public:
    struct Fitted
    {
      double              misfit = 0.; ///< infinite where the law refuses
      std::vector<double> scaled;      ///< all parameters
    };

    /// Fits all but the one parameter, from there.
    using Refit = std::function<Fitted(const std::vector<double> &from)>;

    /// @param slopes of all scaled parameters, per distance, to first order
    /// @param threshold of the misfit above that of the optimum
    /// @param sign 1 upwards, -1 downwards
    /// @param deadline beyond which nothing is fitted
    ProfileSide(const Refit                                &refit,
                const Fitted                               &optimum,
                const Eigen::VectorXd                      &slopes,
                const std::size_t                           parameter,
                const double                                threshold,
                const int                                   sign,
                const std::chrono::steady_clock::time_point deadline);

    /// @param first_distance a guess [scaled]
    /// @throws OutOfTime
    void follow(const double first_distance);

    /// More places, shares of the distance to the end, for a picture.
    /// @throws OutOfTime
    void look_at(const std::vector<double> &shares);

    /// Give an interval this end and the points, (scaled, rise over threshold).
    void add_to(ProfileInterval &interval) const;

    double end     = 0.; ///< scaled
    bool   is_open = false;
    /// Where the misfit was less than at the optimum; empty if nowhere.
    std::vector<double> better;

  private:
    double rise(const double distance);

    Fitted in_time(const std::vector<double> &from);

    Fitted fit_at(const double distance);

    /// Whether the others do far better elsewhere: from there nothing rises.
    bool was_no_optimum() const
    {
      return least_rise < -1.;
    }

    bool jumps_at_end() const;

    std::map<double, Fitted>::const_iterator first_beyond() const;

    const Refit                                 refit;
    const Fitted                                optimum;
    const std::size_t                           parameter;
    const int                                   sign;
    const double                                threshold;
    const std::chrono::steady_clock::time_point deadline;
    const double                                start;
    const double                                room;
    Eigen::VectorXd                             slopes;
    double                                      least_rise = 0.;
    /// By distance; their misfit is the rise over the threshold.
    std::map<double, Fitted> fitted;
  };
} // namespace SlipStep

#endif
