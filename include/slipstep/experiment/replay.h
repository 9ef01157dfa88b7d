// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_experiment_replay_h
#define slipstep_experiment_replay_h

#include <slipstep/experiment/machine.h>
#include <slipstep/friction/contact_point.h>
#include <slipstep/measured_data/measured_test.h>

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace SlipStep
{
  /// A contact point led through the motion and the pressure of a measured
  /// test, again and again with other parameters.
  ///
  /// plan() chooses the steps for one law; simulate() takes the same steps with
  /// any other, so that its results are smooth functions of the parameters and
  /// can be differentiated by differences.
  class Replay
  {
  public:
    /// @param test its rows are the borders of steps, see resample(); on a
    ///   smooth curve it is led along arcs between them, see way_to()
    /// @param lead_in length [mm] slid before the first row, in the direction
    ///   and with the speed of the first motion, under the first pressure: for
    ///   records that begin while the contact slides already
    /// @param row_distance time between neighbouring rows at which curves are
    ///   wanted [s]; the rows of @p test if not given
    explicit Replay(
      const MeasuredTest &test,
      const double        lead_in      = 0.,
      const double        row_distance = std::numeric_limits<double>::max());

    /// Whether one is a copy of the other, whatever steps are planned.
    bool has_motion_of(const Replay &other) const
    {
      return motion == other.motion;
    }

    /// As which of a campaign the test was made, see effect run_order.
    std::optional<double> order;

    /// Choose the steps such that the error which the law estimates for each
    /// is at most @p tolerance, relative to the friction at full slip, and that
    /// of straight lines between their ends, which does not add up, four times
    /// that where there are rows in between.
    /// @param most_steps where to give up, after twice as many attempts: a
    ///   contact that sticks and slips, or times and lengths that do not go
    ///   together, may take any number
    /// @throws RunError if no step is small enough, there are too many, or a
    ///   signal has come
    void plan(const FrictionLaw &law,
              const Machine     &machine,
              const double       tolerance,
              const std::size_t  most_steps = Replay::most_steps);

    /// More steps than any record of a laboratory takes.
    static constexpr std::size_t most_steps = 1000000;
    /// The same for tests that are only imagined: another one will do.
    static constexpr std::size_t most_steps_of_imagined_test = 5000;

    /// The same with every step cut into two equal ones: friction differs by
    /// half of its error to first order.
    Replay halved() const;

    /// Time at the end of every step planned, beginning with the first row [s].
    const std::vector<double> &times() const
    {
      return time_list;
    }

    /// What the load point carries over the pressure, 0 where there is none,
    /// along both axes, at times(): the friction that an instrument records.
    struct Curve
    {
      std::vector<double> friction;
      std::vector<double> friction_y;
    };

    /// @param[out] curve resized
    void simulate(const FrictionLaw &law,
                  const Machine     &machine,
                  Curve             &curve) const;

    /// A curve at other times, which must be increasing and within times(); by
    /// straight lines.
    std::vector<double> at(const std::vector<double> &curve,
                           const std::vector<double> &wanted_times) const;

    /// Updates of the contact point that simulate() makes.
    std::size_t n_steps() const
    {
      return steps.size();
    }

  private:
    /// From one row to the next or a part of that, or the lead-in.
    struct Interval
    {
      dealii::Tensor<1, 2> motion; ///< [mm]
      double               start_pressure;
      double               end_pressure;
      double               duration;
    };

    /// A part of an interval.
    struct Step
    {
      std::size_t interval;
      double      begin; ///< of the interval, 0 to 1
      double      end;
    };

    /// What the contact point is led through.
    struct Motion
    {
      std::vector<Interval> intervals;
      /// Intervals before the first row.
      std::size_t n_before = 0;
      double      start_time;
      double      row_distance;
    };

    /// The contact that has not been loaded yet.
    ContactPoint start(const FrictionLaw &law) const;

    static Motion motion_of(const MeasuredTest &test,
                            const double        lead_in,
                            const double        row_distance);

    /// Time after which a step in this interval ends, infinite if the motion
    /// just goes on.
    double first_step(const std::size_t  interval,
                      const FrictionLaw &law,
                      const Machine     &machine) const;

    bool attempt(const Step        &step,
                 const FrictionLaw &law,
                 const Machine     &machine,
                 const double       tolerance,
                 ContactPoint      &point,
                 Slider            &slider,
                 double            &wanted_step) const;

    MachineStep make(const Step        &step,
                     const FrictionLaw &law,
                     const Machine     &machine,
                     const Slider      &start,
                     ContactPoint      &point) const;

    std::shared_ptr<const Motion> motion;
    std::vector<Step>             steps;
    std::size_t                   first_compared = 0; ///< of the steps
    std::vector<double>           time_list;
  };
} // namespace SlipStep

#endif
