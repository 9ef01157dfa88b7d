// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/local_system.h>

#include <slipstep/utilities/roots.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace SlipStep
{
  // @sect3{Which root}
  //
  // A flow rule that remembers a rate drives none below the ratio of that rate.
  bool FrictionLaw::must_slip(const LocalSystem &local) const
  {
    if (rate_memory != &neutral)
      return flow
               ->flow_residual(
                 local.ratio,
                 local.start_ratio,
                 rate_memory->flow_rate(local.start, 0., local.time_step).value)
               .value < 0.;
    // Below 1e-12 nothing can be told from zero.
    return local.ratio > std::max(local.start_ratio, 1e-12);
  }



  // Where there may be several roots, the one that goes on as before.
  void FrictionLaw::find_slip(LocalSystem &local) const
  {
    if (has_core())
      extend_reach(local);
    const bool slid = local.start.slip_rate > 0.;
    if (slid && depends_on_rate && slide_on(local))
      return;
    stick(local);
    if (slid && !depends_on_rate && !must_slip(local))
      {
        if (slide_on(local))
          return;
        stick(local);
      }
    if (!must_slip(local))
      {
        if (normal_ratio != &neutral)
          local.normal_ratio.value = rate_memory == &neutral ?
                                       local.ratio :
                                       std::min(local.ratio, local.start_ratio);
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
          local.reach,
          std::min(expected * local.strength + (local.reach - local.trial_norm),
                   (1. - 1e-3) * local.reach),
          local);
  }



  // Strength that falls with slip or with speed lets a contact stick or slide
  // under the same traction. One that slides goes on as long as it can: the
  // root of its branch, from where it would slip at the rate that it has.
  // Returns whether there is one. That the strength grows when the slip comes
  // to rest does not count as unloading then.
  bool FrictionLaw::slide_on(LocalSystem &local) const
  {
    const double largest = local.reach / alpha_t;
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
    at_rate.forward   = local.forward;
    at_rate.slip      = moment * local.start.slip_rate * local.time_step;
    evolve_coefficient(at_rate);
    evolve_strength(at_rate);
    start_ratio(local.start.strength, at_rate, local);
    evaluate(local.reach - alpha_t * slip, local);
    if (local.flow.value > 0.)
      return follow_branch(local);
    // The first step of Newton's method is known already.
    const double upper = local.traction;
    const double next  = upper + alpha_t * local.flow.value / local.d_residual;
    solve(0., upper, next > 0. && next < upper ? next : upper, local);
    return true;
  }



  // From sticking on, the first root is next to where the contact was before.
  void FrictionLaw::leave_sticking(LocalSystem &local) const
  {
    const double largest = local.reach / alpha_t;
    double       upper   = local.reach;
    for (double slip = 1e-12 * largest; slip < largest; slip *= 4.)
      {
        const double lower = local.reach - alpha_t * slip;
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
        evaluate(local.reach - alpha_t * std::max(slip - change, slip / 8.),
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
    constexpr double   tolerance       = 1e-6;
    const auto newton = [&](const double from, const int digits, auto &n) {
      return boost::math::tools::newton_raphson_iterate(
        [&](const double traction) {
          const double value = residual(traction);
          return std::make_tuple(value, -local.d_residual / alpha_t);
        },
        from,
        lower,
        upper,
        digits,
        n);
    };
    try
      {
        // Digits of the last correction: the next would be its square, unless
        // there is little slip.
        boost::uintmax_t iterations = most_iterations;
        double           traction   = newton(guess, 22, iterations);
        double           value      = residual(traction);
        double           correction = alpha_t * value / local.d_residual;
        if (std::abs(correction) > 1e-11 * (local.reach - traction) &&
            iterations < most_iterations)
          {
            iterations = most_iterations;
            traction   = newton(traction, 35, iterations);
            value      = residual(traction);
            correction = alpha_t * value / local.d_residual;
          }
        if (iterations < most_iterations)
          {
            const bool is_close = local.d_residual > 0. &&
                                  std::abs(correction) <= tolerance * traction;
            if (is_close && std::abs(value) <= tolerance)
              return;
            // A strength that rises steeply from rest makes the correction
            // small far from any root, too.
            if (is_close &&
                value * residual((1. + std::copysign(tolerance, value)) *
                                 traction) <
                  0.)
              {
                evaluate(traction, local);
                return;
              }
          }
      }
    catch (const boost::math::evaluation_error &)
      {}

    if (!(residual(lower) > 0.) || !(residual(upper) < 0.))
      return;
    evaluate(root_between(residual, lower, upper), local);
  }
} // namespace SlipStep
