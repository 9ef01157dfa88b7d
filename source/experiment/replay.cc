// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/replay.h>
#include <slipstep/experiment/step_control.h>

#include <slipstep/measured_data/arc.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/process.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace SlipStep
{
  using dealii::Tensor;

  namespace
  {
    // Least share of an interval: a jump of a soft machine takes no time.
    constexpr double least_share = 1e-9;



    // A length in the direction of the first motion that is more than a
    // tremble, and the time that takes with its speed.
    std::pair<Tensor<1, 2>, double> first_motion(const MeasuredTest &test,
                                                 const double        length)
    {
      double largest = 0.;
      for (std::size_t i = 1; i < test.time.size(); ++i)
        largest =
          std::max(largest, (position(test, i) - position(test, 0)).norm());
      for (std::size_t i = 1; i < test.time.size(); ++i)
        {
          const Tensor<1, 2> moved = position(test, i) - position(test, 0);
          if (moved.norm() < 0.02 * largest || largest == 0.)
            continue;
          const double speed =
            moved.norm() / (test.time[i] - test.time.front());
          return {length / moved.norm() * moved, length / speed};
        }
      return {Tensor<1, 2>(), 0.};
    }



    // Whether the contact has to stick anew, or to let go.
    bool is_abrupt(const Tensor<1, 2> &before, const Tensor<1, 2> &now)
    {
      const double slow = std::min(before.norm(), now.norm());
      const double fast = std::max(before.norm(), now.norm());
      return fast > 0. &&
             (slow < 0.2 * fast || before * now < 0.5 * slow * fast);
    }
  } // namespace



  Replay::Replay(const MeasuredTest &test,
                 const double        lead_in,
                 const double        row_distance)
    : order(test.order())
    , motion(std::make_shared<Motion>(motion_of(test, lead_in, row_distance)))
  {
    for (std::size_t i = 0; i < motion->intervals.size(); ++i)
      steps.push_back({i, 0., 1.});
  }



  ContactPoint Replay::start(const FrictionLaw &law) const
  {
    ContactState state = law.initial_state();
    // 0 stands for a number that is not known.
    if (order.has_value())
      state[contact_memory("test_number")] =
        *order == 0. ? std::numeric_limits<double>::min() : *order;
    return ContactPoint(state);
  }



  Replay::Motion Replay::motion_of(const MeasuredTest &test,
                                   const double        lead_in,
                                   const double        row_distance)
  {
    Motion result;
    result.start_time   = test.time.front();
    result.row_distance = row_distance;
    // Put on the plane, the contact takes the first pressure at once: a rest
    // would strengthen it.
    constexpr double at_once  = 1e-9; // of the test
    const double     pressure = test.pressure.front();
    result.intervals.push_back(
      {Tensor<1, 2>(),
       0.,
       pressure,
       at_once * (test.time.back() - test.time.front())});
    if (lead_in > 0.)
      {
        const auto [length, duration] = first_motion(test, lead_in);
        if (duration > 0.)
          result.intervals.push_back({length, pressure, pressure, duration});
      }
    result.n_before = result.intervals.size();
    for (std::size_t i = 1; i < test.time.size(); ++i)
      {
        const double duration = test.time[i] - test.time[i - 1];
        const double change   = test.pressure[i] - test.pressure[i - 1];
        Tensor<1, 2> before   = position(test, i - 1);
        for (const PartOfWay &part : way_to(test, i))
          {
            result.intervals.push_back(
              {part.to - before,
               test.pressure[i - 1] + part.begin * change,
               test.pressure[i - 1] + part.end * change,
               (part.end - part.begin) * duration});
            before = part.to;
          }
      }
    return result;
  }



  MachineStep Replay::make(const Step        &step,
                           const FrictionLaw &law,
                           const Machine     &machine,
                           const Slider      &start,
                           ContactPoint      &point) const
  {
    const Interval &interval = motion->intervals[step.interval];
    const double    share    = step.end - step.begin;
    return machine.step(law,
                        point,
                        start,
                        share * interval.motion,
                        interval.start_pressure +
                          step.end *
                            (interval.end_pressure - interval.start_pressure),
                        share * interval.duration);
  }



  // What the load point moves before the contact slides, a small part of it.
  double Replay::first_step(const std::size_t  interval,
                            const FrictionLaw &law,
                            const Machine     &machine) const
  {
    constexpr double first_slip = 0.1; // of the elastic one

    const std::vector<Interval> &intervals = motion->intervals;
    const Interval              &now       = intervals[interval];
    const Tensor<1, 2>           rate      = now.motion / now.duration;
    const Tensor<1, 2>           rate_before =
      interval == 0 ?
                  Tensor<1, 2>() :
                  intervals[interval - 1].motion / intervals[interval - 1].duration;
    if (!is_abrupt(rate_before, rate))
      return std::numeric_limits<double>::infinity();
    const double traction =
      law.static_coefficient() * std::max(now.start_pressure, now.end_pressure);
    // Off the plane.
    if (!(traction > 0.))
      return std::numeric_limits<double>::infinity();
    return first_slip * elastic_slip(traction, law, machine) /
           std::max(rate.norm(), rate_before.norm());
  }



  // One step is tried; the next one is told. Returns whether it is good.
  bool Replay::attempt(const Step        &step,
                       const FrictionLaw &law,
                       const Machine     &machine,
                       const double       tolerance,
                       ContactPoint      &point,
                       Slider            &slider,
                       double            &wanted_step) const
  {
    const double made =
      (step.end - step.begin) * motion->intervals[step.interval].duration;
    const MachineStep tried = make(step, law, machine, slider, point);
    const bool        is_looked_at =
      step.interval >= motion->n_before && made > 1.5 * motion->row_distance;
    const StepError estimate = machine.error(law, point, tried);
    const double    error = is_looked_at ? estimate.measure() : estimate.at_end;
    const double    factor =
      std::isfinite(error) ?
           0.9 * std::sqrt(tolerance / std::max(error, 1e-30)) :
           0.;
    if (error <= 1.5 * tolerance)
      {
        wanted_step = std::max(made, wanted_step) * std::min(factor, 2.);
        slider      = tried.slider;
        return true;
      }
    wanted_step = made * std::clamp(factor, 0.1, 0.7);
    // The ends are rounded.
    if (step.end - step.begin > 1.5 * least_share)
      return false;
    if (!std::isfinite(error))
      throw RunError("no time step is small enough" +
                     words_of_sudden_effects(law));
    slider = tried.slider;
    return true;
  }



  void Replay::plan(const FrictionLaw &law,
                    const Machine     &machine,
                    const double       tolerance,
                    const std::size_t  most_steps)
  {
    const std::vector<Interval> &intervals = motion->intervals;
    const std::size_t            n_before  = motion->n_before;
    ContactPoint                 point     = start(law);
    Slider                       slider;
    steps.clear();
    time_list.assign(1, motion->start_time);
    double time         = motion->start_time,
           wanted_step  = std::numeric_limits<double>::max();
    std::size_t n_tried = 0;
    for (std::size_t i = 0; i < intervals.size(); ++i)
      {
        const double duration = intervals[i].duration;
        if (i == n_before)
          first_compared = steps.size();
        wanted_step = std::min(wanted_step, first_step(i, law, machine));
        for (double begin = 0.; begin < 1.;)
          {
            SignalGuard::throw_if_caught();
            const double left = 1. - begin;
            double       share =
              std::min(left, std::max(wanted_step / duration, least_share));
            // Two equal ones instead of one and a crumb.
            if (share < left && share > left / 2.)
              share = left / 2.;
            const Step step = {i, begin, share == left ? 1. : begin + share};
            if (n_tried++ > 2 * most_steps)
              throw RunError(
                "more than " + std::to_string(most_steps) +
                " time steps are needed: at t = " + rounded_text(time, 4) +
                " s they are " + rounded_text(wanted_step, 2) + " s long");
            if (!attempt(
                  step, law, machine, tolerance, point, slider, wanted_step))
              continue;
            point.commit();
            steps.push_back(step);
            begin = step.end;
            if (i >= n_before)
              time_list.push_back(time + begin * duration);
          }
        if (i >= n_before)
          time += duration;
      }
    if (intervals.size() == n_before)
      first_compared = steps.size();
  }



  Replay Replay::halved() const
  {
    Replay result = *this;
    result.steps.clear();
    result.time_list.assign(1, motion->start_time);
    for (std::size_t i = 0; i < steps.size(); ++i)
      {
        const double middle = (steps[i].begin + steps[i].end) / 2.;
        result.steps.push_back({steps[i].interval, steps[i].begin, middle});
        result.steps.push_back({steps[i].interval, middle, steps[i].end});
        if (i < first_compared)
          continue;
        const double end = time_list[i - first_compared + 1];
        result.time_list.push_back((result.time_list.back() + end) / 2.);
        result.time_list.push_back(end);
      }
    result.first_compared = 2 * first_compared;
    return result;
  }



  void Replay::simulate(const FrictionLaw &law,
                        const Machine     &machine,
                        Curve             &curve) const
  {
    ContactPoint point = start(law);
    Slider       slider;
    curve.friction.clear();
    curve.friction_y.clear();
    const auto observe = [&]() {
      const ContactState &state = point.committed();
      const double        inverse =
        state.normal_traction > 0. ? 1. / state.normal_traction : 0.;
      curve.friction.push_back(slider.load[0] * inverse);
      curve.friction_y.push_back(slider.load[1] * inverse);
    };
    for (std::size_t i = 0; i < steps.size(); ++i)
      {
        SignalGuard::throw_if_caught();
        if (i == first_compared)
          observe();
        slider = make(steps[i], law, machine, slider, point).slider;
        point.commit();
        if (i >= first_compared)
          observe();
      }
  }



  std::vector<double> Replay::at(const std::vector<double> &curve,
                                 const std::vector<double> &wanted_times) const
  {
    return at_times(time_list, curve, wanted_times);
  }
} // namespace SlipStep
