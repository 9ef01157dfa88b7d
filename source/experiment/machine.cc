// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/machine.h>
#include <slipstep/experiment/contact_under_load.h>
#include <slipstep/utilities/pattern_words.h>

#include <slipstep/utilities/roots.h>
#include <slipstep/utilities/units.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace SlipStep
{
  using dealii::Tensor;

  namespace
  {
    const char *const stiffness_key = "Loading/Machine stiffness";
    const char *const mass_key      = "Loading/Machine mass";
  } // namespace



  void Machine::declare_parameters(Parameters &parameters)
  {
    parameters.declare(
      stiffness_key,
      "rigid",
      AnythingWithWords({"rigid"}),
      "Stiffness k of the machine between the load point, which the programme "
      "moves, and the contact point, or the driven faces of the block: "
      "tangential traction (of the block, load over nominal area of contact) "
      "per displacement. 'rigid', or more than 0 and at most 1e15, in MPa/mm.");
    parameters.declare(
      mass_key,
      "0",
      Quantity(Dimension::areal_mass, 0.),
      "Mass m per area of contact that moves with the contact point, or with "
      "the driven faces of the block, at the end of the spring: m u'' = k (U - u) - f_t. It "
      "makes stick-slip a motion instead of a jump. 0 or more, in MPa s^2/mm, "
      "which is 1e9 kg/m^2; 'kg/m^2' is understood. Only with a machine that is "
      "not rigid.");
  }



  Machine::Machine(const Parameters &parameters)
    : areal_mass(parameters.number(mass_key))
  {
    const std::string text = parameters.text(stiffness_key);
    if (text == "rigid")
      {
        if (areal_mass > 0.)
          parameters.reject(mass_key,
                            "on a rigid machine the mass moves as the "
                            "programme prescribes and has no effect; give " +
                              std::string(stiffness_key) + ", too");
        return;
      }
    // Where round-off leaves nothing of a spring, rigid is meant.
    const Quantity stiffness(Dimension::stiffness, 0., 1e15, true);
    if (!stiffness.match(text))
      parameters.reject(stiffness_key,
                        "must be 'rigid' or a stiffness greater than 0, such "
                        "as 50 MPa/mm, and at most 1e15 MPa/mm");
    compliance = 1. / stiffness.value(text);
  }



  namespace
  {
    /// A contact point at the end of a spring, in one stage.
    ///
    /// The law leaves a share w of the elastic trial traction, f_t = w f_trial,
    /// where f_trial = f_0 + C slip. With a spring, slip = motion - c (f_t -
    /// f_0), so that w determines the trial,
    ///   (1 + w c C) f_trial = f_0 + C (motion + c f_0),
    /// and the law a share that must be w. At w = 0 the law's cannot be less,
    /// at w = 1 it cannot be more.
    class SpringStep
    {
    public:
      SpringStep(const ContactStage &stage,
                 const double        compliance,
                 const Tensor<1, 2> &motion)
        : stage(stage)
        , compliance(compliance)
        , motion(motion)
        , elastic(stage.law.elastic_tangent())
        , old(stage.point.stage_traction())
        , unslipped(old + elastic * motion)
        , load(unslipped + compliance * (elastic * old))
      {}

      ContactResponse solve()
      {
        if (stage.law.has_core())
          {
            // What cannot be found makes the step shorter.
            Tensor<1, 2> slip;
            const auto   found = pull_contact(stage,
                                            1. / compliance,
                                            old + motion / compliance,
                                            slip);
            if (found)
              return *found;
            response.traction[0] = std::numeric_limits<double>::quiet_NaN();
            return response;
          }
        if (excess(1.) < -1e-14 && !solve_by_newton())
          solve_by_bisection();
        return response;
      }

    private:
      // The law's share of the trial traction minus the one assumed.
      double excess(const double share)
      {
        Tensor<2, 2> matrix = share * compliance * elastic;
        matrix[0][0] += 1.;
        matrix[1][1] += 1.;
        trial_by_load       = invert(matrix);
        trial               = trial_by_load * load;
        response            = stage.update(invert(elastic) * (trial - old));
        const double square = trial.norm_square();
        return square > 0. ? response.traction * trial / square - share : 0.;
      }

      // Its derivative, after excess().
      double slope() const
      {
        const Tensor<1, 2> d_trial =
          -compliance * (trial_by_load * (elastic * trial));
        const Tensor<1, 2> d_traction =
          response.d_slip * (invert(elastic) * d_trial);
        const double square = trial.norm_square();
        return (d_traction * trial + response.traction * d_trial) / square -
               2. * (response.traction * trial) * (trial * d_trial) /
                 (square * square) -
               1.;
      }

      // From where the traction stays as it was, which in sliding is close.
      bool solve_by_newton()
      {
        const double square = unslipped.norm_square();
        double       share  = square > 0. ? old * unslipped / square : 0.;
        double       lower = 0., upper = 1.;
        for (unsigned int n = 0; n < 20 && share > lower && share < upper; ++n)
          {
            const double value = excess(share);
            if (std::abs(value) <= 2e-15 * share)
              return true;
            (value > 0. ? lower : upper) = share;
            const double next            = share - value / slope();
            if (std::abs(next - share) <= 1e-15 * share)
              return true;
            share = next;
          }
        return false;
      }

      // On a weakening contact there may be several: the first, from sticking
      // on, is next to where the contact was before.
      void solve_by_bisection()
      {
        double upper = 1.;
        // Closer and closer to 1, then to 0.
        for (int power = -40; power <= 200; power += 3)
          {
            const double lower =
              power < 0 ? 1. - std::exp2(power) : std::exp2(-1 - power);
            if (excess(lower) > 0.)
              {
                const auto excess_at = [this](const double share) {
                  return excess(share);
                };
                upper = root_between(excess_at, lower, upper, 51);
                break;
              }
            upper = lower;
          }
        excess(upper);
      }

      const ContactStage &stage;
      const double        compliance;
      const Tensor<1, 2>  motion;
      const Tensor<2, 2>  elastic;
      const Tensor<1, 2>  old;
      const Tensor<1, 2>  unslipped; ///< trial if the traction stayed
      const Tensor<1, 2>  load;

      Tensor<2, 2>    trial_by_load;
      Tensor<1, 2>    trial;
      ContactResponse response;
    };
  } // namespace



  double Machine::softness_in(const double stage_time) const
  {
    return areal_mass > 0. ?
             1. / (stiffness() + areal_mass / (stage_time * stage_time)) :
             compliance;
  }



  // Of a mass, backward Euler makes a spring of stiffness K = k + m/dt^2: f_1 =
  // f_0 + K (motion - slip).
  ContactResponse Machine::move(const ContactStage &stage,
                                const Slider       &start,
                                const Tensor<1, 2> &load_point_increment,
                                Slider             &slider) const
  {
    ContactResponse response;
    Tensor<1, 2>    slip = load_point_increment;
    if (is_rigid())
      response = stage.update(slip);
    else
      {
        const double k       = stiffness();
        const double inertia = areal_mass / (stage.time_step * stage.time_step);
        // A contact that opens lets a mass go at once; what it stored is lost
        // to the law.
        const Tensor<1, 2> old =
          areal_mass > 0. ? stage.start() : stage.point.stage_traction();
        const Tensor<1, 2> motion =
          areal_mass > 0. ? (start.load - old + k * load_point_increment +
                             inertia * stage.time_step * start.velocity) /
                              (k + inertia) :
                            load_point_increment;
        const double softness = softness_in(stage.time_step);
        response              = SpringStep(stage, softness, motion).solve();
        slip                  = motion - softness * (response.traction - old);
      }
    slider.slip     = start.slip + slip;
    slider.velocity = slip / stage.time_step;
    slider.load     = areal_mass > 0. ?
                        start.load + stiffness() * (load_point_increment - slip) :
                        response.traction;
    return response;
  }



  // Here the spring of a mass is that of backward Euler alone.
  std::optional<ContactResponse> Machine::pull(const ContactStage &stage,
                                               const Slider       &start,
                                               const Tensor<1, 2> &load,
                                               Slider             &slider) const
  {
    std::optional<ContactResponse> response;
    Tensor<1, 2>                   slip;
    if (areal_mass == 0.)
      {
        response = push_contact(stage, load, slip);
        if (slip.norm() > fastest_slip * stage.time_step)
          response.reset();
      }
    else
      {
        const double softness  = stage.time_step * stage.time_step / areal_mass;
        const Tensor<1, 2> old = stage.start();
        const Tensor<1, 2> motion =
          softness * (load - old) + stage.time_step * start.velocity;
        response = SpringStep(stage, softness, motion).solve();
        slip     = motion - softness * (response->traction - old);
      }
    slider = {start.slip + slip, slip / stage.time_step, load};
    return response;
  }



  namespace
  {
    // The two of a step.
    std::array<ContactStage, 2> stages_of(const FrictionLaw &law,
                                          ContactPoint      &point,
                                          const double       normal_traction,
                                          const double       time_step)
    {
      constexpr double gamma      = TwoStages::gamma;
      const double     old_normal = point.committed().normal_traction;
      return {{{law,
                point,
                old_normal + gamma * (normal_traction - old_normal),
                gamma * time_step},
               {law, point, normal_traction, gamma * time_step}}};
    }



    Slider start_of_second(const Slider &start, const Slider &first)
    {
      return {TwoStages::carried(start.slip, first.slip),
              TwoStages::carried(start.velocity, first.velocity),
              TwoStages::carried(start.load, first.load)};
    }

    // Where friction rises with speed, a contact that lets go is as fast as
    // that allows, and short steps follow it.
    bool is_jump(const Machine     &machine,
                 const FrictionLaw &law,
                 const MachineStep &step,
                 const double       shortest_step)
    {
      constexpr double sudden = 1e3;

      const double slip = (step.slider.slip - step.start.slip).norm();
      return !machine.is_rigid() && machine.mass() == 0. &&
             step.motion.norm() > 0. && slip > sudden * step.motion.norm() &&
             (!law.is_rate_dependent() ||
              slip > fastest_slip * step.time_step ||
              step.time_step <= shortest_step);
    }
  } // namespace



  MachineStep Machine::step(const FrictionLaw  &law,
                            ContactPoint       &point,
                            const Slider       &start,
                            const Tensor<1, 2> &load_point_increment,
                            const double        normal_traction,
                            const double        time_step,
                            const double        shortest_step) const
  {
    constexpr double gamma  = TwoStages::gamma;
    const auto       stages = stages_of(law, point, normal_traction, time_step);
    const Tensor<1, 2> motion = gamma * load_point_increment;
    MachineStep        result;
    result.start     = start;
    result.motion    = load_point_increment;
    result.time_step = time_step;
    result.softness  = softness_in(gamma * time_step);
    point.revert();
    move(stages[0], start, motion, result.first);
    point.begin_second_stage(law);
    result.second = start_of_second(start, result.first);
    if (areal_mass == 0.)
      result.second.load = point.stage_traction();
    result.contact = move(stages[1], result.second, motion, result.slider);
    result.work =
      ((1. - gamma) * result.first.load + gamma * result.slider.load) *
      load_point_increment;
    result.jumps = is_jump(*this, law, result, shortest_step);
    if (!result.jumps)
      return result;
    // What the first of two stages jumps, the second would go on with.
    point.revert();
    result.contact = move({law, point, normal_traction, time_step},
                          start,
                          load_point_increment,
                          result.slider);
    result.work    = result.slider.load * load_point_increment;
    return result;
  }



  MachineStep Machine::push(const FrictionLaw  &law,
                            ContactPoint       &point,
                            const Slider       &start,
                            const Tensor<1, 2> &load,
                            const double        normal_traction,
                            const double        time_step) const
  {
    const auto  stages = stages_of(law, point, normal_traction, time_step);
    MachineStep result;
    result.start     = start;
    result.time_step = time_step;
    point.revert();
    result.holds = pull(stages[0],
                        start,
                        start.load + TwoStages::gamma * (load - start.load),
                        result.first)
                     .has_value();
    if (!result.holds)
      return result;
    point.begin_second_stage(law);
    result.second   = start_of_second(start, result.first);
    const auto last = pull(stages[1], result.second, load, result.slider);
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



  StepError Machine::error(const FrictionLaw  &law,
                           const ContactPoint &point,
                           const MachineStep  &step) const
  {
    StepError unknown;
    unknown.at_end = std::numeric_limits<double>::infinity();
    if (!std::isfinite((step.first.load + step.slider.load).norm()))
      return unknown;
    if (step.jumps)
      return {};
    StepError result = point.error(law, step.softness);
    if (areal_mass > 0.)
      result.at_end =
        std::max(result.at_end,
                 error_of_motion(step) /
                   std::max(point.trial().strength, step.slider.load.norm()));
    return result;
  }



  Tensor<1, 2> MachineStep::difference_of_orders() const
  {
    return 0.5 * TwoStages::carry * TwoStages::gamma * time_step *
           ((first.velocity - slider.velocity) +
            (first.velocity - start.velocity) -
            (slider.velocity - second.velocity));
  }



  // As of the law, half of the difference of two orders. The stage itself lets
  // a part of it through; of oscillations far quicker than it little is left.
  // Of a swing the scheme itself errs far less than this, so a part of it
  // counts.
  double Machine::error_of_motion(const MachineStep &step) const
  {
    const double     stage_time = TwoStages::gamma * step.time_step;
    constexpr double part       = 0.3;
    const double     all        = stiffness() + step.contact.d_slip.norm();
    return part * all * step.difference_of_orders().norm() /
           (1. + all * stage_time * stage_time / areal_mass);
  }



  // Of a mass whose velocity is at once what it would be without inertia.
  double Machine::lost_swing(const MachineStep &step) const
  {
    if (areal_mass == 0.)
      return 0.;
    const double all  = stiffness() + step.contact.d_slip.norm();
    const double time = TwoStages::gamma * step.time_step;
    const double lost = 1. / (1. + areal_mass / (all * time * time));
    return lost * lost * std::sqrt(areal_mass * all) *
           (step.first.velocity - step.start.velocity).norm();
  }



  std::vector<std::string> Machine::probe_names()
  {
    return {"displacement of the contact [mm]",
            "velocity of the contact [mm/s]",
            "load of the machine's spring / normal load"};
  }



  std::vector<double> Machine::probes(const Slider &slider,
                                      const double  pressure)
  {
    return {slider.slip[0],
            slider.velocity[0],
            pressure > 0. ? slider.load[0] / pressure : 0.};
  }



  double elastic_slip(const double       traction,
                      const FrictionLaw &law,
                      const Machine     &machine)
  {
    return traction / law.tangential_stiffness() +
           traction / machine.stiffness();
  }
} // namespace SlipStep
