// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_verification_reference_contact_h
#define tests_verification_reference_contact_h

#include "reference_law.h"

#include <string>

namespace SlipStep::Testing
{
  /// One contact point led through a programme with hardly an error: the rate
  /// equations are integrated from event to event, so that no step contains a
  /// corner of the programme or a beginning or an end of slip.
  class ReferenceContact
  {
  public:
    /// What is compared.
    struct Answer
    {
      std::array<double, 2> friction{};
      double                dissipation  = 0.;
      double                coefficient  = 0.;
      double                normal_ratio = 0.;
      double                ratio        = 0.; ///< with the strength at rest
    };

    /// @param tolerance of a step, in which the error is overestimated by far
    ReferenceContact(const Parameters &parameters,
                     const Programme  &programme,
                     const double      tolerance = 1e-9);

    Answer at(const double time) const;

    std::size_t n_steps() const
    {
      return steps.size();
    }

    const ReferenceLaw &law() const
    {
      return reference_law;
    }

  private:
    static constexpr std::size_t most_tries = 1000000;

    struct Step
    {
      double start = 0.; ///< of the segment, whose clock is 0 there
      RadauStep<n_unknowns> radau;
      Drive                 drive;
      Mode                  mode = Mode::sticks;
    };

    void cross(const Segment &segment);
    void let_go();

    /// The mode in which a segment begins.
    Mode first_mode(const double time) const;
    /// The mode after an event.
    Mode next_mode(const double time);

    /// Above zero when the present mode is over.
    double event(const double time, const PointState &x) const;

    /// Make a step; its size is the wanted one or less. @return whether it ends
    /// with an event
    bool advance(const double time, Step &step, double &wanted_step);

    double try_step(const double time, const double size, Step &step) const;

    double event_time(const Step &step, const double time) const;

    PointState scale() const;

    const ReferenceLaw reference_law;
    const double       tolerance;
    double             largest_traction = 0.;
    std::size_t        n_tries          = 0;

    std::vector<Step> steps;
    PointState        now;
    Drive             drive;
    Mode              mode = Mode::sticks;
  };



  inline ReferenceContact::ReferenceContact(const Parameters &parameters,
                                            const Programme  &programme,
                                            const double      tolerance)
    : reference_law(parameters)
    , tolerance(tolerance)
    , largest_traction(reference_law.static_coefficient() *
                       programme.largest_pressure())
    , now(reference_law.initial_state())
  {
    for (const Segment &segment : programme.segments())
      cross(segment);
  }



  inline PointState ReferenceContact::scale() const
  {
    PointState floor{};
    floor[traction_x] = floor[traction_y] = 1e-2 * largest_traction;
    floor[normal_ratio]                   = 1e-2;
    floor[coefficient]                    = reference_law.static_coefficient();
    floor[slip_path]   = largest_traction / reference_law.stiffness();
    floor[temperature] = 1.;
    floor[contact_age] = 1e-2;
    floor[dissipation] = floor[slip_path] * largest_traction;
    for (unsigned int i = 0; i < n_unknowns; ++i)
      floor[i] = tolerance * std::max(floor[i], std::abs(now[i]));
    return floor;
  }



  inline Mode ReferenceContact::first_mode(const double time) const
  {
    const double r   = reference_law.ratio(drive, time, now);
    const bool grows = reference_law.elastic_ratio_rate(drive, time, now) > 0.;
    const double r_s = now[normal_ratio];
    const bool   is_far = r > r_s + 1e-13;
    if (reference_law.has_rate_effect() && is_far)
      return Mode::slips;
    if (reference_law.has_subloading)
      return r < ReferenceLaw::least_ratio ? Mode::sticks :
             grows                         ? Mode::slips :
                                             Mode::unloads;
    return r >= r_s - 1e-11 && grows ? Mode::slips : Mode::sticks;
  }



  inline Mode ReferenceContact::next_mode(const double time)
  {
    if (mode == Mode::sticks)
      return Mode::slips;
    if (mode == Mode::slips && !reference_law.has_subloading)
      return Mode::sticks;
    const double r    = reference_law.ratio(drive, time, now);
    now[normal_ratio] = std::max(r, ReferenceLaw::least_ratio);
    if (mode == Mode::slips)
      return Mode::unloads;
    return r < ReferenceLaw::least_ratio ? Mode::sticks : Mode::slips;
  }



  inline double ReferenceContact::event(const double      time,
                                        const PointState &x) const
  {
    if (mode == Mode::open)
      return -1.;
    if (mode == Mode::sticks)
      return reference_law.ratio(drive, time, x) - x[normal_ratio] - 1e-13;
    if (mode == Mode::slips && reference_law.has_rate_effect())
      return x[normal_ratio] - reference_law.ratio(drive, time, x) - 1e-13;
    const double growth = reference_law.elastic_ratio_rate(drive, time, x);
    return mode == Mode::slips ? -growth : growth;
  }



  inline double ReferenceContact::try_step(const double time,
                                           const double size,
                                           Step        &step) const
  {
    return step.radau.make(
      [this](const double t, const PointState &x) {
        return reference_law.rates(drive, mode, t, x);
      },
      time,
      size,
      now,
      scale());
  }



  inline double ReferenceContact::event_time(const Step  &step,
                                             const double time) const
  {
    if (event(time, now) >= 0.)
      return time;
    double lower = time, upper = time + step.radau.size;
    for (unsigned int i = 0; i < 60; ++i)
      {
        const double middle = (lower + upper) / 2.;
        (event(middle, step.radau.at(middle)) > 0. ? upper : lower) = middle;
      }
    return upper;
  }



  inline bool
  ReferenceContact::advance(const double time, Step &step, double &wanted_step)
  {
    for (;; ++n_tries)
      {
        const double error = try_step(time, wanted_step, step);
        const double factor =
          std::isfinite(error) ?
            std::clamp(0.8 * std::pow(std::max(error, 1e-30), -0.25), 0.1, 6.) :
            0.2;
        if (error <= 1.)
          {
            const double end   = time + step.radau.size;
            const bool   over  = event(end, step.radau.end()) > 0.;
            const double until = over ? event_time(step, time) : end;
            if (over && until < end && until > time)
              try_step(time, until - time, step);
            if (over && until == time)
              step.radau.size = 0.;
            wanted_step *= over ? 0.1 : factor;
            return over;
          }
        wanted_step *= factor;
        if (wanted_step < 1e-16 * time || wanted_step < 1e-40 ||
            n_tries > most_tries)
          throw std::runtime_error("the reference is stuck at t = " +
                                   std::to_string(time));
      }
  }



  // What is stored when the contact opens is lost.
  inline void ReferenceContact::let_go()
  {
    now[dissipation] += reference_law.stored_energy(now);
    now[traction_x] = now[traction_y] = now[contact_age] = 0.;
    now[normal_ratio] = reference_law.initial_state()[normal_ratio];
  }



  inline void ReferenceContact::cross(const Segment &segment)
  {
    const double duration = segment.end_time - segment.start_time;
    const auto  &velocity = segment.end.velocity;
    drive                 = {0.,
                             segment.start.pressure,
                             (segment.end.pressure - segment.start.pressure) / duration,
                             {{velocity[0], velocity[1]}}};
    const bool is_open =
      segment.start.pressure == 0. && segment.end.pressure == 0.;
    mode = is_open ? Mode::open : first_mode(0.);

    double time        = 0.;
    double wanted_step = 1e-6 * duration;
    if (velocity.norm() > 0.)
      wanted_step = std::min(wanted_step,
                             1e-3 * largest_traction /
                               (reference_law.stiffness() * velocity.norm()));
    unsigned int n_events_at_once = 0;
    while (time < duration)
      {
        const double left = duration - time;
        if (wanted_step > 0.99 * left)
          wanted_step = left;
        const bool is_last = wanted_step == left;
        Step       step{segment.start_time, {}, drive, mode};
        const bool is_over = advance(time, step, wanted_step);
        n_events_at_once   = step.radau.size == 0. ? n_events_at_once + 1 : 0;
        if (n_events_at_once > 5)
          throw std::runtime_error("the reference hesitates at t = " +
                                   std::to_string(time));
        if (step.radau.size > 0.)
          {
            steps.push_back(step);
            now  = step.radau.end();
            time = is_last && step.radau.size == left ? duration :
                                                        time + step.radau.size;
          }
        if (is_over)
          mode = next_mode(time);
      }
    if (mode == Mode::unloads)
      now[normal_ratio] = std::max(reference_law.ratio(drive, time, now),
                                   ReferenceLaw::least_ratio);
    if (segment.end.pressure == 0.)
      let_go();
  }



  inline ReferenceContact::Answer ReferenceContact::at(const double time) const
  {
    const auto found = std::lower_bound(
      steps.begin(), steps.end(), time, [](const Step &step, const double t) {
        return step.start + step.radau.begin + step.radau.size < t;
      });
    const Step &step = found == steps.end() ? steps.back() : *found;

    const double     clock    = time - step.start;
    const PointState x        = step.radau.at(clock);
    const double     pressure = step.drive.pressure_at(clock);
    const auto       traction = reference_law.traction(x);
    Answer           answer;
    if (pressure > 0.)
      {
        answer.friction = {{traction[0] / pressure, traction[1] / pressure}};
        answer.ratio    = reference_law.ratio(step.drive, clock, x);
      }
    answer.dissipation  = x[dissipation];
    answer.coefficient  = x[coefficient];
    answer.normal_ratio = step.mode == Mode::unloads ?
                            std::min(answer.ratio, x[normal_ratio]) :
                            x[normal_ratio];
    return answer;
  }
} // namespace SlipStep::Testing

#endif
