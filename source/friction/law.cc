#include <slipstep/friction/law.h>

#include <slipstep/utilities/exceptions.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace SlipStep
{
  using dealii::Tensor;

  const Effect FrictionLaw::neutral;



  // The local system of one step: what is given, the unknown slip, and
  // everything that follows from the slip, with derivatives.
  struct FrictionLaw::LocalSystem
  {
    LocalSystem(const ContactState &start,
                const double        time_step,
                const double        normal_traction)
      : start(start)
      , time_step(time_step)
      , normal_traction(normal_traction)
      , coefficient(start.coefficient)
    {}

    const ContactState &start;
    const double        time_step;
    const double        normal_traction;

    Tensor<1, 2> trial;           // f_t + alpha_t * slip increment
    double       trial_norm = 0.; // T
    Tensor<1, 2> direction;       // m = trial / T

    // r_s at the point of the elastic path where r was smallest, and how it
    // depends on the traction increment and the trial strength.
    double       start_ratio = 0.;
    Tensor<1, 2> d_start_ratio_d_trial;
    double       d_start_ratio_d_strength  = 0.;
    double       d_trial_strength_d_normal = 0.;
    Tensor<1, 2> d_trial_strength_d_direction;

    double       traction = 0.; // |f_t|, the unknown
    double       slip     = 0.;
    double       coefficient;
    double       d_coefficient = 0.;
    double       strength      = 0.;
    Strength     d_strength; // value not used
    double       ratio = 0.;
    NormalRatio  normal_ratio;
    FlowResidual flow;
    double       d_residual = 1.;
  };



  namespace
  {
    template <typename RateOf>
    inline Rate
    sum_of_rates(const std::vector<std::unique_ptr<Effect>> &effects,
                 const RateOf                               &rate_of)
    {
      Rate sum;
      for (const auto &effect : effects)
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
    }
  } // namespace



  Rate FrictionLaw::coefficient_rate_per_slip(const double coefficient) const
  {
    return sum_of_rates(active, [coefficient](const Effect &effect) {
      return effect.coefficient_rate_per_slip(coefficient);
    });
  }



  Rate FrictionLaw::coefficient_rate_per_time(const double coefficient) const
  {
    return sum_of_rates(active, [coefficient](const Effect &effect) {
      return effect.coefficient_rate_per_time(coefficient);
    });
  }



  // Backward Euler for mu with the present slip. All rates fall with mu, so
  // the residual is monotone; Newton's method gets a bracket that shrinks.
  void FrictionLaw::evolve_coefficient(LocalSystem &local) const
  {
    const double start = local.start.coefficient;
    double       lower = 0., upper = 1e3;
    double       mu = local.coefficient;
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
    return {local.start,
            local.time_step,
            local.normal_traction,
            local.slip,
            is_anisotropic ? slip_direction(local.direction) : local.direction,
            local.coefficient,
            local.traction * local.slip};
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
        local.strength = f_n * mu;
        d.d_slip       = f_n * local.d_coefficient;
        d.d_normal     = mu;
        return;
      }

    const SlipStepData step = step_data(local);
    Strength           factor{1., 0., 0., {}}, sum;
    for (const StrengthEffect *effect : strength_effects)
      {
        multiply(factor, effect->strength_factor(step));
        add(sum, effect->additive_strength(step));
      }

    local.strength = f_n * mu * factor.value + sum.value;
    d.d_normal = mu * factor.value + f_n * mu * factor.d_normal + sum.d_normal;
    d.d_direction = f_n * mu * factor.d_direction + sum.d_direction;
    d.d_rate      = f_n * mu * factor.d_rate + sum.d_rate;
    d.d_work      = f_n * mu * factor.d_work + sum.d_work;
    d.d_slip = f_n * (local.d_coefficient * factor.value + mu * factor.d_slip) +
               sum.d_slip +
               (f_n * mu * factor.d_coefficient + sum.d_coefficient) *
                 local.d_coefficient +
               d.d_rate / local.time_step +
               d.d_work * (local.traction - alpha_t * local.slip);
    if (is_anisotropic)
      d.d_direction = pull_back(d.d_direction, local.direction);
  }



  // Where the elastic path begins, slip comes to rest.
  double FrictionLaw::strength_at_rest(const LocalSystem &local) const
  {
    if (!depends_on_rate)
      return local.start.strength;
    LocalSystem  at_rest(local.start,
                        local.time_step,
                        local.start.normal_traction);
    const double norm = local.start.traction.norm();
    if (norm > 0.)
      at_rest.direction = local.start.traction / norm;
    evolve_strength(at_rest);
    return at_rest.strength;
  }



  void FrictionLaw::evaluate(const double traction, LocalSystem &local) const
  {
    local.traction = traction;
    local.slip     = (local.trial_norm - traction) / alpha_t;
    evolve_coefficient(local);
    evolve_strength(local);
    local.ratio = traction / local.strength;
    local.normal_ratio =
      normal_ratio->normal_ratio_after_slip(local.start_ratio, local.slip);
    local.flow = flow->flow_residual(local.ratio,
                                     local.normal_ratio.value,
                                     local.slip / local.time_step);

    const double d_ratio =
      -(alpha_t + local.ratio * local.d_strength.d_slip) / local.strength;
    local.d_residual = local.flow.d_ratio * d_ratio +
                       local.flow.d_normal_ratio * local.normal_ratio.d_slip +
                       local.flow.d_rate / local.time_step;
  }



  // While r falls below r_s, r_s falls with it. A step that first unloads and
  // then reloads therefore starts its slip from the smallest ratio on its
  // elastic path. Along the path traction and strength are linear in s in
  // [0, 1]; r = |a + s b| / (c + s d) is quasi-convex there, and the sign of
  // its derivative is that of a linear function of s.
  void FrictionLaw::start_ratio(const Tensor<1, 2> &traction_increment,
                                LocalSystem        &local) const
  {
    if (normal_ratio == &neutral)
      {
        local.start_ratio = 1.;
        return;
      }
    local.start_ratio = local.start.normal_ratio;
    if (local.start.normal_traction <= 0.)
      return;
    const Tensor<1, 2> &a       = local.start.traction;
    const Tensor<1, 2> &b       = traction_increment;
    const double        c       = strength_at_rest(local);
    const double        d       = local.strength - c;
    const double        slope_0 = (a * b) * c - d * (a * a);
    const double        slope_1 = slope_0 + (b * b) * c - d * (a * b);

    if (slope_0 >= 0.)
      return;
    const double       s = (slope_1 > 0. ? slope_0 / (slope_0 - slope_1) : 1.);
    const Tensor<1, 2> traction = a + s * b;
    const double       strength = c + s * d;
    const double       norm     = traction.norm();
    const double       smallest = norm / strength;
    if (smallest < local.start_ratio)
      {
        local.start_ratio = smallest;
        // s is stationary, so only the explicit dependence counts.
        if (norm > 0.)
          local.d_start_ratio_d_trial = s * traction / (norm * strength);
        local.d_start_ratio_d_strength     = -s * smallest / strength;
        local.d_trial_strength_d_normal    = local.d_strength.d_normal;
        local.d_trial_strength_d_direction = local.d_strength.d_direction;
      }
  }



  // The slip in the step is sought by way of the traction that it leaves,
  // |f_t| = |f_trial| - alpha_t * slip: of the two this one keeps its digits
  // when a step is far longer than the elastic slip. At |f_t| = |f_trial| the
  // residual is negative, at 0 it is positive. Strength that falls quickly with
  // slip makes it have several roots; one in the middle, where it grows with
  // the traction, is no equilibrium that lasts.
  void FrictionLaw::solve(LocalSystem &local) const
  {
    const double largest = local.trial_norm;
    // The ratio changes little from step to step; a new contact is on its way
    // to full slip.
    double expected_ratio =
      std::max(local.start.loading_ratio, local.start_ratio);
    if (expected_ratio < 1e-3)
      expected_ratio = 1.;
    const double guess =
      std::min(expected_ratio * local.strength, (1. - 1e-3) * largest);

    const auto residual = [&](const double traction) {
      evaluate(traction, local);
      return local.flow.value;
    };
    const unsigned int most_iterations = 50;
    try
      {
        boost::uintmax_t iterations = most_iterations;
        const double     traction = boost::math::tools::newton_raphson_iterate(
          [&](const double traction) {
            const double value = residual(traction);
            return std::make_tuple(value, -local.d_residual / alpha_t);
          },
          guess,
          0.,
          largest,
          45,
          iterations);
        if (iterations < most_iterations)
          {
            evaluate(traction, local);
            const double correction =
              alpha_t * local.flow.value / local.d_residual;
            if (local.d_residual > 0. &&
                std::abs(correction) <= 1e-6 * traction)
              return;
          }
      }
    catch (const boost::math::evaluation_error &)
      {}

    boost::uintmax_t iterations = 200;
    const auto       bracket    = boost::math::tools::toms748_solve(
      residual,
      0.,
      largest,
      boost::math::tools::eps_tolerance<double>(50),
      iterations);
    evaluate((bracket.first + bracket.second) / 2., local);
  }



  // Backward Euler's local error of the slip is half the change of its rate
  // times the step. Of a change of size the flow rule lets only part through
  // (nothing without overstress), of a change of direction the transverse
  // stiffness. The error of mu is half the change of its rates.
  double FrictionLaw::error_estimate(const LocalSystem &local) const
  {
    double error = 0.;
    if (local.slip > 0.)
      {
        const double old_norm = local.start.traction.norm();
        if (old_norm > 0.)
          {
            const Tensor<1, 2> old = local.start.traction / old_norm;
            const Tensor<1, 2> turned =
              local.direction - (local.direction * old) * old;
            error += alpha_t * local.traction / local.trial_norm * 0.5 *
                     local.slip * turned.norm();
          }

        const double d_rate =
          local.flow.d_rate - local.flow.d_ratio * local.ratio /
                                local.strength * local.d_strength.d_rate;
        const double transmitted =
          std::abs((d_rate / local.time_step) / local.d_residual);
        error += alpha_t * transmitted * 0.5 *
                 std::abs(local.slip - local.time_step * local.start.slip_rate);
      }
    const double mu_0 = local.start.coefficient, mu = local.coefficient;
    const double d_mu =
      0.5 * (local.slip * (coefficient_rate_per_slip(mu).value -
                           coefficient_rate_per_slip(mu_0).value) +
             local.time_step * (coefficient_rate_per_time(mu).value -
                                coefficient_rate_per_time(mu_0).value));
    return error + local.normal_traction * local.ratio * std::abs(d_mu);
  }



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



  ContactState FrictionLaw::initial_state() const
  {
    ContactState state;
    state.coefficient  = initial_coefficient;
    state.normal_ratio = normal_ratio->virgin_normal_ratio();
    return state;
  }



  void FrictionLaw::complete(ContactState &state) const
  {
    if (state.normal_traction <= 0.)
      {
        state.traction        = Tensor<1, 2>();
        state.normal_traction = state.strength = 0.;
        state.loading_ratio = state.slip_rate = 0.;
        state.normal_ratio = normal_ratio->virgin_normal_ratio();
        return;
      }
    state.loading_ratio =
      (state.strength > 0. ?
         isotropic_traction(state.traction).norm() / state.strength :
         0.);
    if (normal_ratio == &neutral)
      state.normal_ratio = 1.;
    else
      {
        const double largest = std::min(state.loading_ratio, 1.);
        state.normal_ratio =
          (flow == &neutral ?
             largest :
             std::min(std::max(state.normal_ratio, 0.), largest));
      }
  }



  // Slip and time each drive mu towards the value where their rate vanishes;
  // rates fall with mu.
  std::array<double, 2> FrictionLaw::coefficient_range() const
  {
    std::array<double, 2> range  = {{initial_coefficient, initial_coefficient}};
    const auto            extend = [&range](const auto &rate_at) {
      double lower = 0., upper = 1e3;
      if (rate_at(lower) == 0. && rate_at(upper) == 0.)
        return;
      for (unsigned int bisection = 0; bisection < 200; ++bisection)
        {
          const double middle = (lower + upper) / 2.;
          (rate_at(middle) > 0. ? lower : upper) = middle;
        }
      range[0] = std::min(range[0], lower);
      range[1] = std::max(range[1], upper);
    };
    extend(
      [&](const double mu) { return coefficient_rate_per_slip(mu).value; });
    extend(
      [&](const double mu) { return coefficient_rate_per_time(mu).value; });
    return range;
  }



  // With an elliptic cone f_t = P f', where f' is the traction of an isotropic
  // law. The slip that does the same work with f' is P times the true one, in
  // its elastic and in its viscoplastic part: then the latter is normal to the
  // ellipse, since that of the isotropic law is normal to its circle.
  ContactResponse FrictionLaw::update(const ContactState &start,
                                      const Tensor<1, 2> &slip_increment,
                                      const double        normal_traction,
                                      const double        time_step,
                                      ContactState       &end) const
  {
    Assert(time_step > 0., dealii::ExcMessage("The time step must be > 0."));
    if (!is_anisotropic)
      return isotropic_update(
        start, slip_increment, normal_traction, time_step, end);

    ContactState isotropic_start = start;
    isotropic_start.traction     = isotropic_traction(start.traction);
    ContactResponse response     = isotropic_update(
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
    const Tensor<1, 2> slip = inverse_cone * direction;
    return direction == Tensor<1, 2>() ? slip : slip / slip.norm();
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



  ContactResponse
  FrictionLaw::isotropic_update(const ContactState &start,
                                const Tensor<1, 2> &slip_increment,
                                const double        normal_traction,
                                const double        time_step,
                                ContactState       &end) const
  {
    LocalSystem local(start, time_step, std::max(normal_traction, 0.));

    // Off the plane: mu goes on healing, the traction is lost.
    if (normal_traction <= 0.)
      {
        evolve_coefficient(local);
        end                 = start;
        end.traction        = Tensor<1, 2>();
        end.coefficient     = local.coefficient;
        end.normal_ratio    = normal_ratio->virgin_normal_ratio();
        end.normal_traction = end.strength = 0.;
        end.loading_ratio = end.slip_rate = 0.;
        end.dissipation += start.traction.norm_square() / (2. * alpha_t);
        for (const StrengthEffect *effect : strength_effects)
          effect->remember(step_data(local), end);
        return {};
      }

    const Tensor<1, 2> traction_increment = alpha_t * slip_increment;
    local.trial                           = start.traction + traction_increment;
    local.trial_norm                      = local.trial.norm();
    local.traction                        = local.trial_norm;
    if (local.trial_norm > 0.)
      local.direction = local.trial / local.trial_norm;

    evolve_coefficient(local);
    evolve_strength(local);
    local.ratio = local.trial_norm / local.strength;
    start_ratio(traction_increment, local);
    // Below 1e-12 nothing can be told from zero.
    if (local.ratio > std::max(local.start_ratio, 1e-12))
      solve(local);
    else if (normal_ratio != &neutral)
      local.normal_ratio.value = local.ratio;

    ContactResponse response = linearise(local);
    response.error           = error_estimate(local);
    response.slips           = local.slip > 0.5 * slip_increment.norm();

    end.traction        = response.traction;
    end.normal_traction = normal_traction;
    end.strength        = local.strength;
    end.loading_ratio   = local.ratio;
    end.normal_ratio    = local.normal_ratio.value;
    end.coefficient     = local.coefficient;
    end.slip_path       = start.slip_path + local.slip;
    end.slip_rate       = local.slip / time_step;
    end.dissipation     = start.dissipation + local.traction * local.slip;
    for (const auto memory : ContactState::memories())
      end.*memory.value = start.*memory.value;
    for (const StrengthEffect *effect : strength_effects)
      effect->remember(step_data(local), end);
    return response;
  }
} // namespace SlipStep
