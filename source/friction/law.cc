// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/local_system.h>

#include <slipstep/utilities/exceptions.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  using dealii::Tensor;

  const Effect FrictionLaw::neutral;



  // @sect3{The law at one point}
  //
  // One implicit stage: given the state at its beginning, the slip of the block
  // over the plane, the normal traction at its end and its length in time, find
  // the state at its end. Elastic predictor and return: the trial traction
  // @f$f_t + \alpha_t \Delta u@f$ keeps its direction and is shortened by what
  // slips. All else (mu, strength, r_s, flow rule) follows from that one
  // number.

  namespace
  {
    template <typename RateOf>
    inline Rate
    sum_of_rates(const std::vector<const CoefficientEffect *> &effects,
                 const RateOf                                 &rate_of)
    {
      Rate sum;
      for (const CoefficientEffect *effect : effects)
        {
          const Rate rate = rate_of(*effect);
          sum.value += rate.value;
          sum.derivative += rate.derivative;
        }
      return sum;
    }



    // The product rule.
    void multiply(Strength &product, const Strength &f)
    {
      const auto rule = [&](auto &derivative, const auto &f_derivative) {
        derivative = derivative * f.value + product.value * f_derivative;
      };
      rule(product.d_slip, f.d_slip);
      rule(product.d_normal, f.d_normal);
      rule(product.d_direction, f.d_direction);
      rule(product.d_rate, f.d_rate);
      rule(product.d_coefficient, f.d_coefficient);
      rule(product.d_work, f.d_work);
      rule(product.d_path, f.d_path);
      rule(product.d_way, f.d_way);
      product.value *= f.value;
    }



    void add(Strength &sum, const Strength &c)
    {
      sum.value += c.value;
      sum.d_slip += c.d_slip;
      sum.d_normal += c.d_normal;
      sum.d_direction += c.d_direction;
      sum.d_rate += c.d_rate;
      sum.d_coefficient += c.d_coefficient;
      sum.d_work += c.d_work;
      sum.d_path += c.d_path;
      sum.d_way += c.d_way;
    }
  } // namespace



  Rate FrictionLaw::coefficient_rate_per_slip(const double coefficient) const
  {
    return sum_of_rates(coefficient_effects, [=](const auto &effect) {
      return effect.coefficient_rate_per_slip(coefficient);
    });
  }



  Rate FrictionLaw::coefficient_rate_per_time(const double coefficient) const
  {
    return sum_of_rates(coefficient_effects, [=](const auto &effect) {
      return effect.coefficient_rate_per_time(coefficient);
    });
  }



  // Backward Euler for mu with the present slip. All rates fall with mu, so
  // the residual is monotone; Newton's method gets a bracket that shrinks.
  void FrictionLaw::evolve_coefficient(LocalSystem &local) const
  {
    const double start = local.start.coefficient;
    if (coefficient_effects.empty())
      {
        local.coefficient = start;
        return;
      }
    double lower = 0., upper = 1e3;
    double mu = local.coefficient;
    for (unsigned int iteration = 0; iteration < 2000; ++iteration)
      {
        const Rate   slip = coefficient_rate_per_slip(mu);
        const Rate   time = coefficient_rate_per_time(mu);
        const double value =
          mu - start - local.slip * slip.value - local.time_step * time.value;
        const double slope =
          1. - local.slip * slip.derivative - local.time_step * time.derivative;
        local.d_coefficient = slip.value / slope;

        (value > 0. ? upper : lower) = mu;
        const double next            = mu - value / slope;
        // Convergence is quadratic: the error left is the square of this.
        const bool is_converged = std::abs(next - mu) <= 1e-9 * mu;
        mu = (is_converged || (next > lower && next < upper) ?
                next :
                (lower + upper) / 2.);
        if (is_converged)
          break;
      }
    local.coefficient = mu;
  }



  SlipStepData FrictionLaw::step_data(const LocalSystem &local) const
  {
    const Tensor<1, 2> way = true_slip(local.slip * local.forward);
    return {local.start,
            local.time_step,
            local.normal_traction,
            local.slip,
            slip_direction(local.direction),
            local.coefficient,
            local.heat(has_core()),
            is_anisotropic ? way.norm() : local.slip,
            way};
  }



  FrictionLaw::Contributions
  FrictionLaw::contributions(const SlipStepData &step) const
  {
    Contributions result;
    for (const StrengthEffect *effect : strength_effects)
      {
        multiply(result.factor, effect->strength_factor(step));
        add(result.sum, effect->additive_strength(step));
      }
    const Strength place{step.start.strength_factor, 0., 0., {}};
    multiply(result.factor, place);
    multiply(result.sum, place);
    return result;
  }



  // tau_y = f_n mu G_1 G_2 ... + c_1 + c_2 + ... The derivative with respect to
  // slip becomes the total one: mu, the slip rate and the friction work change
  // with it.
  void FrictionLaw::evolve_strength(LocalSystem &local) const
  {
    const double f_n = local.normal_traction, mu = local.coefficient;
    Strength    &d = local.d_strength;
    if (strength_effects.empty())
      {
        const double place = local.start.strength_factor;
        local.strength     = place * f_n * mu;
        d.d_slip           = place * f_n * local.d_coefficient;
        d.d_normal         = place * mu;
        return;
      }

    const SlipStepData  step   = step_data(local);
    const Contributions all    = contributions(step);
    const Strength     &factor = all.factor, &sum = all.sum;
    const double        d_path = f_n * mu * factor.d_path + sum.d_path;
    // The way is s true_slip(n), the path its length.
    const Tensor<1, 2> &n     = local.forward;
    const Tensor<1, 2>  d_way = true_slip(f_n * mu * factor.d_way + sum.d_way +
                                         d_path * slip_direction(n));

    local.strength = f_n * mu * factor.value + sum.value;
    d.d_normal = mu * factor.value + f_n * mu * factor.d_normal + sum.d_normal;
    d.d_direction = f_n * mu * factor.d_direction + sum.d_direction;
    d.d_rate      = f_n * mu * factor.d_rate + sum.d_rate;
    d.d_work      = f_n * mu * factor.d_work + sum.d_work;
    d.d_slip = f_n * (local.d_coefficient * factor.value + mu * factor.d_slip) +
               sum.d_slip +
               (f_n * mu * factor.d_coefficient + sum.d_coefficient) *
                 local.d_coefficient +
               d.d_rate / local.time_step + d_way * n;
    // With a core work depends on the strength, see core_change().
    if (!has_core())
      d.d_slip += d.d_work * (local.traction - alpha_t * local.slip);
    if (is_anisotropic)
      d.d_direction = pull_back(d.d_direction, local.direction);
    if (has_core())
      d.d_way = local.slip * d_way;
    else
      d.d_direction += local.slip * d_way;
  }



  // Where the elastic path begins, slip comes to rest.
  double FrictionLaw::strength_at_rest(const LocalSystem &local) const
  {
    if (!depends_on_rate)
      return local.start.strength;
    LocalSystem  at_rest(local.stage,
                        local.time_step,
                        local.start.normal_traction);
    const double norm = local.stage.path_start.norm();
    if (norm > 0.)
      at_rest.direction = local.stage.path_start / norm;
    evolve_strength(at_rest);
    return at_rest.strength;
  }



  void FrictionLaw::evaluate_flow(LocalSystem &local) const
  {
    const auto residual = [&](const double rate) {
      return flow->flow_residual(local.ratio, local.normal_ratio.value, rate);
    };
    if (rate_memory == &neutral)
      {
        local.flow          = residual(local.slip / local.time_step);
        local.d_flow_d_slip = local.flow.d_rate / local.time_step;
        return;
      }
    const Rate rate =
      rate_memory->flow_rate(local.start, local.slip, local.time_step);
    local.flow          = residual(rate.value);
    local.d_flow_d_slip = local.flow.d_rate * rate.derivative;
  }



  void FrictionLaw::evaluate(const double traction, LocalSystem &local) const
  {
    const double slip = (local.reach - traction) / alpha_t;
    const double expected =
      local.coefficient + local.d_coefficient * (slip - local.slip);
    if (expected > 0.)
      local.coefficient = expected;
    local.traction = traction;
    local.slip     = slip;
    evolve_coefficient(local);
    if (has_core())
      return evaluate_with_core(local);
    evolve_strength(local);
    local.ratio = traction / local.strength;
    local.normal_ratio =
      normal_ratio->normal_ratio_after_slip(local.start_ratio, local.slip);
    evaluate_flow(local);

    const double d_ratio =
      -(alpha_t + local.ratio * local.d_strength.d_slip) / local.strength;
    local.d_residual = local.flow.d_ratio * d_ratio +
                       local.flow.d_normal_ratio * local.normal_ratio.d_slip +
                       local.d_flow_d_slip;
  }



  // Along an elastic path traction a + s b and strength c + s d are linear in s
  // in [0, 1]; their ratio is quasi-convex there, and the sign of its
  // derivative is that of a linear function of s.
  double FrictionLaw::smallest_ratio(const Tensor<1, 2> &a,
                                     const Tensor<1, 2> &b,
                                     const double        c,
                                     const double        end_strength,
                                     const Tensor<1, 2> &centre,
                                     double             &s) const
  {
    if (has_core())
      return smallest_similarity_ratio(a, b, c, end_strength, centre, s);
    const double d       = end_strength - c;
    const double slope_0 = (a * b) * c - d * (a * a);
    const double slope_1 = slope_0 + (b * b) * c - d * (a * b);
    s = slope_0 >= 0. ? 0. : slope_1 > 0. ? slope_0 / (slope_0 - slope_1) : 1.;
    return (a + s * b).norm() / (c + s * d);
  }



  // While r falls below r_s, r_s falls with it. A stage that first unloads and
  // then reloads therefore starts its slip from the smallest ratio on its
  // elastic path.
  void FrictionLaw::start_ratio(const double       start_strength,
                                const LocalSystem &end,
                                LocalSystem       &local) const
  {
    local.d_start_ratio_d_trial    = Tensor<1, 2>();
    local.d_start_ratio_d_strength = 0.;
    if (normal_ratio == &neutral)
      {
        local.start_ratio = 1.;
        return;
      }
    local.start_ratio =
      std::max(local.start.normal_ratio, normal_ratio->elastic_range());
    if (local.start.normal_traction <= 0.)
      return;
    const Tensor<1, 2> &a = local.stage.path_start;
    const Tensor<1, 2>  b = local.trial - local.stage.path_base;
    // Nothing slips along the path, so the core rests.
    const Tensor<1, 2> c = local.core.centre - local.stage.core_motion;
    double             s;
    const double       smallest =
      smallest_ratio(a, b, start_strength, end.strength, c, s);
    if (s == 0.)
      return;
    const Tensor<1, 2> traction = a + s * b;
    const double       norm     = traction.norm();
    const double       strength = (1. - s) * start_strength + s * end.strength;
    if (smallest < local.start_ratio)
      {
        local.start_ratio = std::max(smallest, normal_ratio->elastic_range());
        if (smallest < local.start_ratio)
          return;
        // s is stationary, so only the explicit dependence counts.
        local.d_start_ratio_d_strength = -s * smallest / strength;
        if (has_core())
          {
            const Tensor<1, 2> n     = similarity(traction, strength, c).normal;
            const double       scale = s / ((1. - c * n) * strength);
            local.d_start_ratio_d_trial = scale * n;
            local.d_start_ratio_d_strength -= scale * (c * n);
          }
        else if (norm > 0.)
          local.d_start_ratio_d_trial = s * traction / (norm * strength);
        local.d_trial_strength_d_normal    = end.d_strength.d_normal;
        local.d_trial_strength_d_direction = end.d_strength.d_direction;
        local.d_trial_strength_d_way       = end.d_strength.d_way;
      }
  }



  // No slip in this stage.
  void FrictionLaw::stick(LocalSystem &local) const
  {
    local.traction    = local.reach;
    local.slip        = 0.;
    local.work        = 0.;
    local.coefficient = local.start.coefficient;
    evolve_coefficient(local);
    evolve_strength(local);
    local.ratio =
      has_core() ?
        similarity(local.trial, local.strength, local.core.centre).ratio :
        local.trial_norm / local.strength;
    start_ratio(strength_at_rest(local), local, local);
  }



  // @sect3{The consistent tangent}
  //
  // Newton's method on the block converges quadratically only with the
  // derivative of what was computed, not of the rate equations: it follows from
  // the converged local residual.

  ContactResponse FrictionLaw::linearise(const LocalSystem &local) const
  {
    const Tensor<1, 2> &m = local.direction;
    ContactResponse     response;
    Tensor<2, 2>        unity;
    unity[0][0] = unity[1][1] = 1.;

    if (local.slip == 0.)
      {
        response.traction = local.trial;
        response.d_slip   = alpha_t * unity;
        return response;
      }
    if (has_core())
      return linearise_with_core(local);

    const Tensor<2, 2> transverse =
      (unity - outer_product(m, m)) / local.trial_norm;

    // Implicit function theorem: residual(slip; trial, f_n) = 0.
    const double from_strength =
      -local.flow.d_ratio * local.ratio / local.strength;
    const double from_start =
      local.flow.d_normal_ratio * local.normal_ratio.d_start;
    const double own_share =
      1. - local.ratio * local.d_strength.d_work * local.slip;
    const Tensor<1, 2> d_slip_d_trial =
      -(local.flow.d_ratio / local.strength * own_share * m +
        from_strength * (transverse * local.d_strength.d_direction) +
        from_start * (local.d_start_ratio_d_trial +
                      local.d_start_ratio_d_strength *
                        (transverse * local.d_trial_strength_d_direction))) /
      local.d_residual;
    const double d_slip_d_normal =
      -(from_strength * local.d_strength.d_normal +
        from_start * local.d_start_ratio_d_strength *
          local.d_trial_strength_d_normal) /
      local.d_residual;

    response.traction = local.traction * m;
    response.d_slip =
      alpha_t * (outer_product(m, m - alpha_t * d_slip_d_trial) +
                 local.traction * transverse);
    response.d_normal = -alpha_t * d_slip_d_normal * m;
    return response;
  }



  // With an elliptic cone f_t = P f', where f' is the traction of an isotropic
  // law. The slip that does the same work with f' is P times the true one, in
  // its elastic and in its viscoplastic part: then the latter is normal to the
  // ellipse, since that of the isotropic law is normal to its circle.
  ContactResponse FrictionLaw::update(const StageStart   &start,
                                      const Tensor<1, 2> &slip_increment,
                                      const double        normal_traction,
                                      const double        time_step,
                                      ContactState       &end) const
  {
    Assert(time_step > 0., dealii::ExcMessage("The time step must be > 0."));
    if (!is_anisotropic)
      return isotropic_update(
        start, slip_increment, normal_traction, time_step, end);

    StageStart isotropic_start     = start;
    isotropic_start.state.traction = isotropic_traction(start.state.traction);
    isotropic_start.path_start     = isotropic_traction(start.path_start);
    isotropic_start.path_base      = isotropic_traction(start.path_base);
    ContactResponse response       = isotropic_update(
      isotropic_start, cone * slip_increment, normal_traction, time_step, end);

    response.traction = cone * response.traction;
    response.d_slip   = cone * response.d_slip * cone;
    response.d_normal = cone * response.d_normal;
    end.traction      = response.traction;
    return response;
  }



  // Normal to the ellipse, from the direction in which an isotropic law slips.
  Tensor<1, 2> FrictionLaw::slip_direction(const Tensor<1, 2> &direction) const
  {
    if (!is_anisotropic)
      return direction;
    const Tensor<1, 2> slip = inverse_cone * direction;
    return direction == Tensor<1, 2>() ? slip : slip / slip.norm();
  }



  // Of what is slip in the metric in which the law is isotropic.
  Tensor<1, 2> FrictionLaw::true_slip(const Tensor<1, 2> &slip) const
  {
    return is_anisotropic ? inverse_cone * slip : slip;
  }



  // A gradient with respect to slip_direction(direction) becomes one with
  // respect to the direction.
  Tensor<1, 2> FrictionLaw::pull_back(const Tensor<1, 2> &gradient,
                                      const Tensor<1, 2> &direction) const
  {
    const Tensor<1, 2> e = slip_direction(direction);
    if (e == Tensor<1, 2>())
      return e;
    return inverse_cone * (gradient - (gradient * e) * e) /
           (inverse_cone * direction).norm();
  }



  // Off the plane: mu goes on healing, the traction is lost. Until then all
  // slip that was elastic and all motion become slip, for a share s = f_0 /
  // (f_0 - f_n) of the stage in which the normal traction changes from f_0 to
  // f_n; what follows only carries the point to another place.
  void FrictionLaw::open(const Tensor<1, 2> &slip_increment,
                         const double        normal_traction,
                         LocalSystem        &local,
                         ContactState       &end) const
  {
    const double base = local.stage.normal_traction;
    if (base > 0.)
      {
        const double share = base / (base - normal_traction);
        local.set_trial(local.start.traction +
                        share * alpha_t * slip_increment);
        local.slip = local.trial_norm / alpha_t;
      }
    evolve_coefficient(local);
    SlipStepData step = step_data(local);
    step.way = true_slip(local.start.traction / alpha_t + slip_increment);

    end                 = local.start;
    end.traction        = Tensor<1, 2>();
    end.coefficient     = local.coefficient;
    end.normal_ratio    = normal_ratio->virgin_normal_ratio();
    end.normal_traction = end.strength = 0.;
    end.loading_ratio = end.slip_rate = 0.;
    end.dissipation += local.start.traction.norm_square() / (2. * alpha_t) +
                       std::max(local.core.energy, 0.);
    core->remember_core({{}, std::min(local.core.energy, 0.)}, end);
    end.slip_path += step.path;
    for (const StrengthEffect *effect : strength_effects)
      effect->remember(step, end);
  }



  ContactResponse
  FrictionLaw::isotropic_update(const StageStart   &stage,
                                const Tensor<1, 2> &slip_increment,
                                const double        normal_traction,
                                const double        time_step,
                                ContactState       &end) const
  {
    // Squares and quotients of less underflow [MPa].
    constexpr double least = 1e-100;

    const ContactState &start   = stage.state;
    const bool          is_open = normal_traction < least;
    LocalSystem         local(stage, time_step, is_open ? 0. : normal_traction);
    if (has_core())
      local.core = core->core(start);
    if (is_open)
      {
        open(slip_increment, std::min(normal_traction, 0.), local, end);
        return {};
      }

    local.set_trial(start.traction + alpha_t * slip_increment);
    if (has_core())
      find_forward(local);
    find_slip(local);

    ContactResponse response = linearise(local);
    // Of an increment that is no round-off.
    response.slips = local.slip > std::max(0.5 * slip_increment.norm(),
                                           1e-6 * start.coefficient *
                                             normal_traction / alpha_t);

    if (has_core())
      local.forward = local.normal;
    const SlipStepData step = step_data(local);
    end.traction            = response.traction;
    end.normal_traction     = normal_traction;
    end.strength            = local.strength;
    // Without round-off, which the bounds do not forgive.
    end.loading_ratio = std::min(local.ratio, flow->maximum_ratio());
    end.normal_ratio  = normal_ratio == &neutral ?
                          local.normal_ratio.value :
                          std::min(local.normal_ratio.value, end.loading_ratio);
    end.coefficient   = local.coefficient;
    end.slip_path     = start.slip_path + step.path;
    end.slip_rate     = local.slip / time_step;
    end.dissipation   = start.dissipation + local.heat(has_core());
    end.memories      = start.memories;
    if (has_core())
      {
        // After a step of 1e16 elastic slips r has no digits.
        end.normal_ratio = std::max(end.normal_ratio, 0.);
        end.loading_ratio =
          std::min(response.traction.norm() / local.strength, maximum_ratio());
        core->remember_core(
          moved_core(start, local.strength, local.normal, local.slip), end);
      }
    for (const StrengthEffect *effect : strength_effects)
      effect->remember(step, end);
    return response;
  }
} // namespace SlipStep
