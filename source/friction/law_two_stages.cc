// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/law.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  using dealii::Tensor;

  // What the steps of two stages add to the stages of law.cc.

  namespace
  {
    // What two rates mean for the end of a step: the method of second order
    // takes shares of both, the one of first order the last alone. Half of the
    // difference is the error of backward Euler where the rate changes evenly.
    constexpr double share = 0.5 * TwoStages::carry;

    double slip_of(const StageRecord &stage)
    {
      return stage.end.slip_rate * stage.time_step;
    }
  } // namespace



  // An end of which only the strength is to be found.
  SlipStepData FrictionLaw::step_data(const ContactState &start,
                                      const ContactState &end,
                                      const double        slip,
                                      const double        time_step) const
  {
    double work = isotropic_traction(end.traction).norm() * slip;
    if (has_core())
      {
        const Tensor<1, 2> normal = slip_normal(end);
        const double       taken =
          moved_core(start, end.strength, normal, slip).energy -
          core->core(start).energy;
        // Of a rate that is carried on; heat is positive.
        work =
          std::max(isotropic_traction(end.traction) * normal * slip - taken,
                   0.);
      }
    const Tensor<1, 2> way = true_slip(slip * slip_normal(end));
    return {start,
            time_step,
            end.normal_traction,
            slip,
            slip_direction(direction_of(end)),
            end.coefficient,
            work,
            is_anisotropic ? way.norm() : slip,
            way};
  }



  // Of the traction of an isotropic law, along which that one slips.
  Tensor<1, 2> FrictionLaw::direction_of(const ContactState &state) const
  {
    const Tensor<1, 2> traction = isotropic_traction(state.traction);
    const double       norm     = traction.norm();
    return norm > 0. ? traction / norm : traction;
  }



  // Traction, path and energy go on straight; r_s and the memories as they do
  // with the slip rate of the first stage.
  StageStart FrictionLaw::second_stage(const ContactState &start,
                                       const StageRecord  &first) const
  {
    const double  slip      = slip_of(first);
    const double  more      = (TwoStages::carry - 1.) * slip;
    const double  more_time = (TwoStages::carry - 1.) * first.time_step;
    StageStart    result(first.end);
    ContactState &state = result.state;

    const double coefficient =
      TwoStages::carried(start.coefficient, first.end.coefficient);
    state.coefficient =
      std::clamp(coefficient,
                 std::min(range_of_coefficient[0], start.coefficient),
                 std::max(range_of_coefficient[1], start.coefficient));

    SlipStepData rest = step_data(first.end, first.end, more, more_time);
    if (first.end.normal_traction <= 0.)
      rest.way = (TwoStages::carry - 1.) * first.slip_increment;
    for (const StrengthEffect *effect : strength_effects)
      effect->remember(rest, state);
    if (first.end.normal_traction <= 0.)
      return result;

    const Tensor<1, 2> normal = slip_normal(first.end);
    if (has_core())
      {
        core->remember_core(
          moved_core(first.end, first.end.strength, normal, more), state);
        result.core_motion =
          core->core(state).centre - core->core(first.end).centre;
      }
    state.slip_path = first.end.slip_path + rest.path;
    state.dissipation =
      TwoStages::carried(start.dissipation, first.end.dissipation);
    state.traction +=
      (TwoStages::carry - 1.) * (first.end.traction - start.traction);
    if (slip > 0.)
      state.normal_ratio =
        normal_ratio->normal_ratio_after_slip(state.normal_ratio, more).value;
    result.path_base = first.end.traction - alpha_t * more * cone * normal;
    result.normal_traction =
      TwoStages::carried(start.normal_traction, first.end.normal_traction);
    return result;
  }



  StepError FrictionLaw::step_error(const ContactState &start,
                                    const StageRecord  &first,
                                    const StageStart   &second,
                                    const StageRecord  &last,
                                    const double        compliance) const
  {
    StepError error;
    error.at_end = error_of_coefficient(start, first, second, last);

    const ContactState &end = last.end;
    if (!(end.normal_traction > 0.))
      {
        // When it came off the plane is known to a part of the step only.
        const ContactState &closed =
          first.end.strength > 0. ? first.end : start;
        if (closed.strength > 0.)
          error.at_end =
            std::max(error.at_end,
                     share * closed.traction.norm() * closed.slip_rate *
                       last.time_step /
                       (end.dissipation +
                        closed.strength * closed.strength / (2. * alpha_t)));
        return error;
      }

    error.at_end = std::max(
      {error.at_end,
       error_of_traction(start, first, last, compliance) / end.strength,
       error_of_memories(start, first, last),
       error_of_core(start, last),
       error_of_flow_rate(start, last),
       error_of_normal_ratio(start, first, last)});

    // Off the plane nothing is felt of what a point passes over.
    if (start.normal_traction > 0.)
      for (const StrengthEffect *effect : strength_effects)
        error.of_line =
          std::max(error.of_line, effect->hidden_change(start, end));

    // A parabola through three points is farthest from its chord in the middle;
    // a corner may be somewhat farther.
    if (start.normal_traction > 0. && first.end.normal_traction > 0.)
      {
        const auto friction = [](const ContactState &state) {
          return state.traction / state.normal_traction;
        };
        constexpr double gamma   = TwoStages::gamma;
        constexpr double highest = 0.3 / (gamma * (1. - gamma));
        error.of_line =
          std::max(error.of_line,
                   highest *
                     (friction(first.end) - (1. - gamma) * friction(start) -
                      gamma * friction(end))
                       .norm() *
                     end.normal_traction / end.strength);
      }
    return error;
  }



  // Of what the rates of slip differ, stiffness and flow rule let a part
  // through, and a spring in series takes its share: (1 + c D)^-1 D. A contact
  // that slips when a step begins and sticks when its first stage ends has
  // slipped in between, which no stage sees; without a rate effect slip stops
  // at once.
  double FrictionLaw::error_of_traction(const ContactState &start,
                                        const StageRecord  &first,
                                        const StageRecord  &last,
                                        const double        compliance) const
  {
    const auto slip = [&](const ContactState &state) {
      return inverse_cone * (state.slip_rate * slip_normal(state));
    };
    const auto traction = [&](const StageRecord  &stage,
                              const Tensor<1, 2> &change) {
      const Tensor<1, 2> rigid = stage.response.d_slip * change;
      if (compliance == 0.)
        return rigid.norm();
      Tensor<2, 2> both = compliance * stage.response.d_slip;
      both[0][0] += 1.;
      both[1][1] += 1.;
      return determinant(both) > 0. ?
               std::min(rigid.norm(), (invert(both) * rigid).norm()) :
               rigid.norm();
    };
    double error =
      share * last.time_step * traction(last, slip(last.end) - slip(first.end));
    if (is_rate_dependent() && start.normal_traction > 0.)
      error = std::max(error,
                       0.5 * first.time_step *
                         traction(first, slip(first.end) - slip(start)));
    return error;
  }



  double FrictionLaw::error_of_coefficient(const ContactState &start,
                                           const StageRecord  &first,
                                           const StageStart   &second,
                                           const StageRecord  &last) const
  {
    const double mu = last.end.coefficient;
    const double slope =
      1. - slip_of(last) * coefficient_rate_per_slip(mu).derivative -
      last.time_step * coefficient_rate_per_time(mu).derivative;
    return share *
           std::abs((mu - second.state.coefficient) -
                    (first.end.coefficient - start.coefficient)) /
           (slope * mu);
  }



  // The strength that the last rates alone, over the whole step, would make.
  double FrictionLaw::error_of_memories(const ContactState &start,
                                        const StageRecord  &first,
                                        const StageRecord  &last) const
  {
    if (strength_effects.empty())
      return 0.;
    const ContactState &end       = last.end;
    const double        time_step = last.time_step / TwoStages::gamma;
    SlipStepData        step =
      step_data(start, end, end.slip_rate * time_step, time_step);
    if (!(start.normal_traction > 0.))
      step.way = TwoStages::carry * first.slip_increment + last.slip_increment -
                 elastic_slip(end.traction);
    const Contributions all = contributions(step);
    const double        strength =
      end.normal_traction * end.coefficient * all.factor.value + all.sum.value;
    double error = 0.5 * std::abs(strength - end.strength) / end.strength;
    for (const StrengthEffect *effect : strength_effects)
      error = std::max(error, effect->unseen_error(start, end));
    return error;
  }



  // r that goes with the rate which the last slip rate alone would leave.
  double FrictionLaw::error_of_flow_rate(const ContactState &start,
                                         const StageRecord  &last) const
  {
    const ContactState &end = last.end;
    if (rate_memory == &neutral || !(end.slip_rate > 0.))
      return 0.;
    const double time_step = last.time_step / TwoStages::gamma;
    const auto   flow_at   = [&](const double rate) {
      return flow->flow_residual(end.loading_ratio, end.normal_ratio, rate);
    };
    const FlowResidual one_stage = flow_at(
      rate_memory->flow_rate(start, end.slip_rate * time_step, time_step)
        .value);
    const double present =
      flow_at(rate_memory->flow_rate(end, 0., time_step).value).value;
    return 0.5 * std::abs((one_stage.value - present) / one_stage.d_ratio);
  }



  // r_s that the last slip rate alone, over the whole step and its elastic
  // path, would make.
  double FrictionLaw::error_of_normal_ratio(const ContactState &start,
                                            const StageRecord  &first,
                                            const StageRecord  &last) const
  {
    const ContactState &end = last.end;
    if (normal_ratio == &neutral || !(end.slip_rate > 0.) ||
        !(start.strength > 0.))
      return 0.;
    const Tensor<1, 2> path =
      alpha_t *
      (cone * (TwoStages::carry * first.slip_increment + last.slip_increment));
    double       where;
    const double smallest = smallest_ratio(isotropic_traction(start.traction),
                                           path,
                                           start.strength,
                                           end.strength,
                                           core->core(start).centre,
                                           where);
    const NormalRatio one_stage = normal_ratio->normal_ratio_after_slip(
      std::max(std::min(start.normal_ratio, smallest),
               normal_ratio->elastic_range()),
      end.slip_rate * last.time_step / TwoStages::gamma);
    return 0.5 * std::abs(one_stage.value - end.normal_ratio);
  }
} // namespace SlipStep
