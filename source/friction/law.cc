// SPDX-License-Identifier: LGPL-2.1-or-later
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



  // @sect3{The law at one point}
  //
  // One implicit stage: given the state at its beginning, the slip of the block
  // over the plane, the normal traction at its end and its length in time, find
  // the state at its end. Elastic predictor and return: the trial traction
  // @f$f_t + \alpha_t \Delta u@f$ keeps its direction and is shortened by what
  // slips. All else (mu, strength, r_s, flow rule) follows from that one
  // number.
  //
  // The local system of one step: what is given, the unknown slip, and
  // everything that follows from the slip, with derivatives.
  struct FrictionLaw::LocalSystem
  {
    LocalSystem(const StageStart &stage,
                const double      time_step,
                const double      normal_traction)
      : stage(stage)
      , start(stage.state)
      , time_step(time_step)
      , normal_traction(normal_traction)
      , coefficient(start.coefficient)
    {}

    const StageStart   &stage;
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
            slip_direction(local.direction),
            local.coefficient,
            local.traction * local.slip};
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

    const Contributions all    = contributions(step_data(local));
    const Strength     &factor = all.factor, &sum = all.sum;

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
    LocalSystem  at_rest(local.stage,
                        local.time_step,
                        local.start.normal_traction);
    const double norm = local.stage.path_start.norm();
    if (norm > 0.)
      at_rest.direction = local.stage.path_start / norm;
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



  // Along an elastic path traction a + s b and strength c + s d are linear in s
  // in [0, 1]; their ratio is quasi-convex there, and the sign of its
  // derivative is that of a linear function of s.
  double FrictionLaw::smallest_ratio(const Tensor<1, 2> &a,
                                     const Tensor<1, 2> &b,
                                     const double        c,
                                     const double        end_strength,
                                     double             &s)
  {
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
    local.start_ratio = local.start.normal_ratio;
    if (local.start.normal_traction <= 0.)
      return;
    const Tensor<1, 2> &a = local.stage.path_start;
    const Tensor<1, 2>  b = local.trial - local.stage.path_base;
    double              s;
    const double        smallest =
      smallest_ratio(a, b, start_strength, end.strength, s);
    if (s == 0.)
      return;
    const Tensor<1, 2> traction = a + s * b;
    const double       norm     = traction.norm();
    const double       strength = (1. - s) * start_strength + s * end.strength;
    if (smallest < local.start_ratio)
      {
        local.start_ratio = smallest;
        // s is stationary, so only the explicit dependence counts.
        if (norm > 0.)
          local.d_start_ratio_d_trial = s * traction / (norm * strength);
        local.d_start_ratio_d_strength     = -s * smallest / strength;
        local.d_trial_strength_d_normal    = end.d_strength.d_normal;
        local.d_trial_strength_d_direction = end.d_strength.d_direction;
      }
  }



  // No slip in this stage.
  void FrictionLaw::stick(LocalSystem &local) const
  {
    local.traction    = local.trial_norm;
    local.slip        = 0.;
    local.coefficient = local.start.coefficient;
    evolve_coefficient(local);
    evolve_strength(local);
    local.ratio = local.trial_norm / local.strength;
    start_ratio(strength_at_rest(local), local, local);
  }



  // @sect3{Which root}
  //
  // Where there may be several roots, the one that goes on as before.
  void FrictionLaw::find_slip(LocalSystem &local) const
  {
    stick(local);
    // Below 1e-12 nothing can be told from zero.
    const auto must_slip = [](const LocalSystem &local) {
      return local.ratio > std::max(local.start_ratio, 1e-12);
    };
    const bool slid = local.start.slip_rate > 0.;
    if (slid && (depends_on_rate || !must_slip(local)))
      {
        if (slide_on(local))
          return;
        stick(local);
      }
    if (!must_slip(local))
      {
        if (normal_ratio != &neutral)
          local.normal_ratio.value = local.ratio;
        return;
      }
    if (depends_on_rate && !slid)
      return leave_sticking(local);
    // The ratio changes little from step to step; a new contact is on its way
    // to full slip.
    double expected = std::max(local.start.loading_ratio, local.start_ratio);
    if (expected < 1e-3)
      expected = 1.;
    solve(0.,
          local.trial_norm,
          std::min(expected * local.strength, (1. - 1e-3) * local.trial_norm),
          local);
  }



  // Strength that falls with slip or with speed lets a contact stick or slide
  // under the same traction. One that slides goes on as long as it can: the
  // root of its branch, from where it would slip at the rate that it has.
  // Returns whether there is one. That the strength grows when the slip comes
  // to rest does not count as unloading then.
  bool FrictionLaw::slide_on(LocalSystem &local) const
  {
    const double largest = local.trial_norm / alpha_t;
    const double slip =
      std::min(local.start.slip_rate * local.time_step, (1. - 1e-3) * largest);
    if (!(slip > 0.))
      return false;
    // The strength on the elastic path, with memories as they are.
    constexpr double moment = 1e-9; // of the time step
    LocalSystem      at_rate(local.stage,
                        moment * local.time_step,
                        local.normal_traction);
    at_rate.direction = local.direction;
    at_rate.slip      = moment * local.start.slip_rate * local.time_step;
    evolve_coefficient(at_rate);
    evolve_strength(at_rate);
    start_ratio(local.start.strength, at_rate, local);
    evaluate(local.trial_norm - alpha_t * slip, local);
    if (local.flow.value > 0.)
      return follow_branch(local);
    const double upper = local.traction;
    solve(0., upper, std::min(local.ratio * local.strength, upper), local);
    return true;
  }



  // From sticking on, the first root is next to where the contact was before.
  void FrictionLaw::leave_sticking(LocalSystem &local) const
  {
    const double largest = local.trial_norm / alpha_t;
    double       upper   = local.trial_norm;
    for (double slip = 1e-12 * largest; slip < largest; slip *= 4.)
      {
        const double lower = local.trial_norm - alpha_t * slip;
        evaluate(lower, local);
        if (local.flow.value >= 0.)
          return solve(lower, upper, lower, local);
        upper = lower;
      }
    solve(0., upper, upper / 2., local);
  }



  // Newton's method towards less slip, from a residual that is too large; the
  // branch ends where the residual grows no more with slip, or where slip
  // cannot be told from none.
  bool FrictionLaw::follow_branch(LocalSystem &local) const
  {
    for (unsigned int iteration = 0; iteration < 100; ++iteration)
      {
        const double slip = local.slip, lower = local.traction;
        if (!(local.d_residual > 0.) || alpha_t * slip <= 1e-15 * lower)
          return false;
        const double change = local.flow.value / local.d_residual;
        if (change <= 1e-13 * slip || alpha_t * change <= 1e-16 * lower)
          return true;
        evaluate(local.trial_norm -
                   alpha_t * std::max(slip - change, slip / 8.),
                 local);
        if (local.flow.value <= 0.)
          {
            const double upper = local.traction;
            solve(lower, upper, upper, local);
            return true;
          }
      }
    return false;
  }



  // The slip in the stage is sought by way of the traction that it leaves,
  // |f_t| = |f_trial| - alpha_t * slip: of the two this one keeps its digits
  // when a step is far longer than the elastic slip. The residual is positive
  // at the lower bound and negative at the upper one.
  void FrictionLaw::solve(const double lower,
                          const double upper,
                          const double guess,
                          LocalSystem &local) const
  {
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
          lower,
          upper,
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

    if (!(residual(lower) > 0.) || !(residual(upper) < 0.))
      return;
    boost::uintmax_t iterations = 200;
    const auto       bracket    = boost::math::tools::toms748_solve(
      residual,
      lower,
      upper,
      boost::math::tools::eps_tolerance<double>(50),
      iterations);
    evaluate((bracket.first + bracket.second) / 2., local);
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



  // Off the plane: mu goes on healing, the traction is lost.
  void FrictionLaw::open(const LocalSystem &local, ContactState &end) const
  {
    end                 = local.start;
    end.traction        = Tensor<1, 2>();
    end.coefficient     = local.coefficient;
    end.normal_ratio    = normal_ratio->virgin_normal_ratio();
    end.normal_traction = end.strength = 0.;
    end.loading_ratio = end.slip_rate = 0.;
    end.dissipation += local.start.traction.norm_square() / (2. * alpha_t);
    for (const StrengthEffect *effect : strength_effects)
      effect->remember(step_data(local), end);
  }



  ContactResponse
  FrictionLaw::isotropic_update(const StageStart   &stage,
                                const Tensor<1, 2> &slip_increment,
                                const double        normal_traction,
                                const double        time_step,
                                ContactState       &end) const
  {
    const ContactState &start = stage.state;
    LocalSystem         local(stage, time_step, std::max(normal_traction, 0.));
    if (normal_traction <= 0.)
      {
        evolve_coefficient(local);
        open(local, end);
        return {};
      }

    local.trial      = start.traction + alpha_t * slip_increment;
    local.trial_norm = local.trial.norm();
    if (local.trial_norm > 0.)
      local.direction = local.trial / local.trial_norm;

    find_slip(local);

    ContactResponse response = linearise(local);
    // Of an increment that is no round-off.
    response.slips = local.slip > std::max(0.5 * slip_increment.norm(),
                                           1e-6 * start.coefficient *
                                             normal_traction / alpha_t);

    end.traction        = response.traction;
    end.normal_traction = normal_traction;
    end.strength        = local.strength;
    // Without round-off, which the bounds do not forgive.
    end.loading_ratio = std::min(local.ratio, flow->maximum_ratio());
    end.normal_ratio  = normal_ratio == &neutral ?
                          local.normal_ratio.value :
                          std::min(local.normal_ratio.value, end.loading_ratio);
    end.coefficient   = local.coefficient;
    end.slip_path     = start.slip_path + local.slip;
    end.slip_rate     = local.slip / time_step;
    end.dissipation   = start.dissipation + local.traction * local.slip;
    end.memories      = start.memories;
    for (const StrengthEffect *effect : strength_effects)
      effect->remember(step_data(local), end);
    return response;
  }
} // namespace SlipStep
