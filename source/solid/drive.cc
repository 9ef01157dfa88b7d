// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/drive.h>

#include <slipstep/experiment/contact_under_load.h>
#include <slipstep/utilities/text.h>

#include <algorithm>

namespace SlipStep
{
  using dealii::Tensor;

  void Drive::begin_step(const double time, const bool is_first_of_segment)
  {
    if (is_first_of_segment)
      load_before = at_start.load;
    begin_time                = time;
    stage_start               = at_start;
    load_point_at_stage_start = load_point_at_start;
  }



  void Drive::begin_second_stage()
  {
    first       = stage_end;
    stage_start = {TwoStages::carried(at_start.slip, first.slip),
                   TwoStages::carried(at_start.velocity, first.velocity),
                   TwoStages::carried(at_start.load, first.load)};
    load_point_at_stage_start =
      TwoStages::carried(load_point_at_start, load_point_at_stage_end);
  }



  // The load of a push grows from what the load point carried before.
  void Drive::begin_stage(const double end_time, const double time_step)
  {
    const Segment &segment = programme.segment_at(end_time);
    this->end_time         = end_time;
    stage_time             = time_step;
    pushes                 = segment.pushes;
    unknown                = pushes || !machine.is_rigid();
    motion                 = programme.at(end_time).displacement -
             programme.at(begin_time).displacement;
    const double share =
      (end_time - segment.start_time) / (segment.end_time - segment.start_time);
    push = share < 1. ? load_before + share * (segment.push - load_before) :
                        segment.push;
    if (!unknown)
      return;
    force_at_start = pushes ? push : spring_load(stage_start.slip);
    resistance     = pushes ? 0. : machine.stiffness();
    force_at_start += machine.mass() / time_step * stage_start.velocity;
    resistance += machine.mass() / (time_step * time_step);
  }



  Tensor<1, 2> Drive::displacement(const double growth) const
  {
    return unknown ? at_start.slip + growth * last_motion :
                     programme.at(end_time).displacement + pushed;
  }



  void Drive::end_stage(const Tensor<1, 2> &displacement,
                        const Tensor<1, 2> &reaction)
  {
    stage_end.slip     = displacement;
    stage_end.velocity = (displacement - stage_start.slip) / stage_time;
    stage_end.load     = pushes             ? push :
                         machine.is_rigid() ? reaction / area :
                                              spring_load(displacement);
    load_point_at_stage_end =
      pushes ? load_point_at_start + (displacement - at_start.slip) +
                 (stage_end.load - at_start.load) / machine.stiffness() :
               programme.at(end_time).displacement + pushed;
  }



  double Drive::work_beyond(const Tensor<1, 2> &reaction) const
  {
    return area * (stage_end.load *
                   (load_point_at_stage_end - load_point_at_stage_start)) -
           reaction * (stage_end.slip - stage_start.slip);
  }



  MachineStep Drive::step_against(const Tensor<2, 2> &springs) const
  {
    MachineStep step;
    step.start          = at_start;
    step.first          = first;
    step.second         = stage_start;
    step.slider         = stage_end;
    step.time_step      = stage_time / TwoStages::gamma;
    step.contact.d_slip = springs / area;
    return step;
  }



  double Drive::error(const Tensor<2, 2> &springs, const double strength) const
  {
    if (machine.mass() == 0.)
      return 0.;
    StepError error;
    error.at_end = machine.error_of_motion(step_against(springs)) /
                   std::max(strength / area, stage_end.load.norm());
    return error.measure();
  }



  double Drive::lost_swing(const Tensor<2, 2> &springs,
                           const double        strength) const
  {
    return strength > 0. ?
             machine.lost_swing(step_against(springs)) / (strength / area) :
             0.;
  }



  void Drive::accept(const double pressure)
  {
    this->pressure = pressure;
    last_motion    = stage_end.slip - at_start.slip;
    at_start       = stage_end;
    if (pushes)
      {
        path += (load_point_at_stage_end - load_point_at_start).norm();
        pushed = load_point_at_stage_end - programme.at(end_time).displacement;
      }
    load_point_at_start = load_point_at_stage_end;
  }



  bool Drive::is_faster_than_waves() const
  {
    return pushes && machine.mass() == 0. &&
           stage_end.velocity.norm() > fastest_slip;
  }



  std::string Drive::reason_of_failure() const
  {
    if (pushes)
      return reason_of_slip(push.norm() < at_start.load.norm() ?
                              push :
                              programme.segment_at(end_time).push,
                            at_start.load,
                            pressure);
    return "the contact gives way faster than the machine's spring of " +
           short_text(machine.stiffness(), 6) +
           " MPa/mm slackens, and would jump; a Loading/Machine mass turns the "
           "jump into a motion";
  }
} // namespace SlipStep
