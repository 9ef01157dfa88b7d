// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/machine.h>

namespace SlipStep
{
  using dealii::Tensor;

  MachineStep Machine::push(const FrictionLaw  &law,
                            ContactPoint       &point,
                            const Slider       &start,
                            const Tensor<1, 2> &load,
                            const double        normal_traction,
                            const double        time_step) const
  {
    constexpr double gamma      = TwoStages::gamma;
    const double     old_normal = point.committed().normal_traction;
    MachineStep      result;
    result.start     = start;
    result.time_step = time_step;
    point.revert();
    const auto first =
      pushed_stage(law,
                   point,
                   start,
                   start.load + gamma * (load - start.load),
                   old_normal + gamma * (normal_traction - old_normal),
                   gamma * time_step,
                   result.first);
    result.holds = first.has_value();
    if (!result.holds)
      return result;
    point.begin_second_stage(law);
    result.second   = {TwoStages::carried(start.slip, result.first.slip),
                       TwoStages::carried(start.velocity, result.first.velocity),
                       TwoStages::carried(start.load, result.first.load)};
    const auto last = pushed_stage(law,
                                   point,
                                   result.second,
                                   load,
                                   normal_traction,
                                   gamma * time_step,
                                   result.slider);
    result.holds    = last.has_value();
    if (!result.holds)
      return result;
    result.contact = *last;

    // Work is the integral of power by the same scheme.
    const auto load_point = [&](const Slider &at) {
      return at.slip + compliance * at.load;
    };
    result.motion = load_point(result.slider) - load_point(start);
    result.work =
      TwoStages::carry *
        (result.first.load * (load_point(result.first) - load_point(start))) +
      result.slider.load *
        (load_point(result.slider) - load_point(result.second));
    return result;
  }
} // namespace SlipStep
