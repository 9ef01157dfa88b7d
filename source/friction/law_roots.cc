// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/local_system.h>

#include <slipstep/utilities/roots.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace SlipStep
{
  namespace
  {
    // Of a traction, what a smaller correction may not change.
    constexpr double round_off = 2. * std::numeric_limits<double>::epsilon();
  } // namespace



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
    evaluate(std::min(expected_traction(local), (1. - 1e-3) * local.reach),
             local);
    solve(0., local.reach, local);
  }



  // After stick(). What drives slip beyond r_s changes little from step to
  // step; r_s and the strength go on as they begin. A new contact is on its way
  // to full slip.
  double FrictionLaw::expected_traction(const LocalSystem &local) const
  {
    const ContactState &start = local.start;
    const double before = std::max(start.loading_ratio, local.start_ratio);
    if (has_core() || before < 1e-3)
      return (before < 1e-3 ? 1. : before) * local.strength +
             (local.reach - local.trial_norm);
    const double driving =
      std::max(start.loading_ratio - start.normal_ratio, 0.);
    const double slip =
      std::max(local.reach - (local.start_ratio + driving) * local.strength,
               0.) /
      alpha_t;
    const double ratio =
      normal_ratio->normal_ratio_after_slip(local.start_ratio, slip).value +
      driving;
    const double change = depends_on_rate ? 0. : local.d_strength.d_slip * slip;
    return ratio * std::max(local.strength + change, local.strength / 2.);
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
    solve(0., local.traction, local);
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
          return solve(lower, upper, local);
        upper = lower;
      }
    evaluate(upper / 2., local);
    solve(0., upper, local);
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
        if (change <= 1e-13 * slip || alpha_t * change <= round_off * lower)
          return true;
        evaluate(local.reach - alpha_t * std::max(slip - change, slip / 8.),
                 local);
        if (local.flow.value <= 0.)
          {
            solve(lower, local.traction, local);
            return true;
          }
      }
    return false;
  }



  // The slip in the stage is sought by way of the traction that it leaves,
  // |f_t| = |f_trial| - alpha_t * slip: of the two this one keeps its digits
  // when a step is far longer than the elastic slip. The residual is positive
  // at the lower bound and negative at the upper one; the local system is the
  // one of a traction between them.
  void FrictionLaw::solve(const double lower,
                          const double upper,
                          LocalSystem &local) const
  {
    constexpr double tolerance = 1e-6;

    const auto residual = [&](const double traction) {
      evaluate(traction, local);
      return local.flow.value;
    };
    if (approach_root(lower, upper, local))
      {
        const double traction = local.traction, value = local.flow.value;
        const bool   is_close =
          local.d_residual > 0. &&
          std::abs(alpha_t * value / local.d_residual) <= tolerance * traction;
        if (is_close && std::abs(value) <= tolerance)
          return;
        // A strength that rises steeply from rest makes the correction small
        // far from any root, too.
        if (is_close &&
            value *
                residual((1. + std::copysign(tolerance, value)) * traction) <
              0.)
          {
            evaluate(traction, local);
            return;
          }
      }
    if (!(residual(lower) > 0.) || !(residual(upper) < 0.))
      return;
    evaluate(root_between(residual, lower, upper), local);
  }



  // Newton's method with the derivatives of the last two points instead of one:
  // the traction as a cubic function of the residual. Returns whether the
  // corrections have become as small as they can.
  bool FrictionLaw::approach_root(double       lower,
                                  double       upper,
                                  LocalSystem &local) const
  {
    // A traction, its residual, and the derivative of the former with respect
    // to the latter.
    struct Point
    {
      double traction, value, slope;
    };
    Point  before            = {};
    double correction_before = std::numeric_limits<double>::infinity();
    for (unsigned int iteration = 0; iteration < 50; ++iteration)
      {
        const Point now = {local.traction,
                           local.flow.value,
                           -alpha_t / local.d_residual};
        if (!std::isfinite(now.value))
          return false;
        const double correction = std::abs(now.value * now.slope);
        // Of slip and traction the smaller one has these digits, if round-off
        // leaves it as many.
        const double smaller =
          std::min(local.reach - now.traction, now.traction);
        if (correction <= std::max(1e-12 * smaller, round_off * now.traction) ||
            (correction <= 3e-11 * now.traction &&
             correction > 0.5 * correction_before))
          return true;

        (now.value > 0. ? lower : upper) = now.traction;
        const auto is_inside             = [&](const double traction) {
          return traction > lower && traction < upper;
        };
        double next = now.traction - now.value * now.slope;
        if (iteration > 0 && std::max(now.slope, before.slope) < 0.)
          {
            const double height = now.value - before.value;
            const double w = now.value / height, v = 1. - w;
            const double cubic =
              now.traction +
              w * (w * ((1. + 2. * v) * (before.traction - now.traction) +
                        height * v * before.slope) -
                   height * v * v * now.slope);
            if (w > -0.5 && w < 1. && is_inside(cubic))
              next = cubic;
          }
        // Beyond the upper bound there is far less slip, or none.
        if (!is_inside(next))
          next = now.value > 0. && next >= upper ?
                   upper - (upper - lower) / 16. :
                   (lower + upper) / 2.;
        if (!is_inside(next))
          return true;
        before            = now;
        correction_before = correction;
        evaluate(next, local);
      }
    return false;
  }
} // namespace SlipStep
