// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/local_system.h>

#include <slipstep/utilities/roots.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  using dealii::Tensor;

  // @sect3{The elastic core}
  //
  // Without a core the ratios r and r_s are the radii of circles around zero,
  // in tractions x = f_t / tau_y. With a core c the circle of r_s is similar to
  // that of radius 1 with c as the centre of similarity: a point of the plane
  // keeps its place between c and the large circle. So its centre is (1 - r_s)
  // c, and with the circle of r around the same centre
  // @f[ x = (1 - r_s) c + r n, \qquad |n| = 1, \qquad V^{vp} = \lambda n: @f]
  // slip is normal to the circle through the traction, as it is without a core.
  // In full sliding, r_s = 1, the core does nothing. While nothing slips and r
  // falls below r_s, r_s = r is the ratio of similarity(). What the core does
  // with slip is the effect's own: c = E c_0 + g n.
  //
  // Backward Euler with the trial traction T and the slip s in the stage then
  // says @f$T - \tau_y (1 - r_s) E c_0 = [\alpha_t s + \tau_y (r + (1 - r_s)
  // g)]\, n@f$. r_s, E and g follow from s, so n is the direction of the left
  // hand side and r follows from its norm: one unknown again. With u >= 0 and
  // |c| < 1 the residual of a given strength is monotone in it.
  //
  // The strength depends on the direction of the trial as without a core, and
  // on the way as if that went along the normal to the circle of the start
  // through the trial traction. The way itself goes along n, which
  // differs by a second order of the step; so the residual stays one of the
  // slip alone.

  // The radius R of the circle with r = r_s = R through a traction: |y + R
  // tau_y c| = R tau_y with y = f_t - tau_y c.
  FrictionLaw::Similarity FrictionLaw::similarity(const Tensor<1, 2> &traction,
                                                  const double        strength,
                                                  const Tensor<1, 2> &centre)
  {
    const Tensor<1, 2> y    = traction - strength * centre;
    const double       yc   = y * centre;
    const double       room = 1. - centre.norm_square();
    const double       root = std::sqrt(yc * yc + room * y.norm_square());
    const double       radius =
      yc >= 0. ? (yc + root) / room : y.norm_square() / (root - yc);
    Similarity result;
    result.ratio = radius / strength;
    if (radius > 0.)
      result.normal = (y + radius * centre) / radius;
    return result;
  }



  // The same circles seen along the elastic path: they are convex and lie
  // within each other, so there is one minimum.
  double FrictionLaw::smallest_similarity_ratio(const Tensor<1, 2> &a,
                                                const Tensor<1, 2> &b,
                                                const double        c,
                                                const double end_strength,
                                                const Tensor<1, 2> &centre,
                                                double             &s)
  {
    const double d  = end_strength - c;
    const auto   at = [&](const double s) {
      return similarity(a + s * b, c + s * d, centre);
    };
    const auto slope = [&](const double s) {
      const Similarity now = at(s);
      return now.normal * (b - d * centre) -
             now.ratio * d * (1. - centre * now.normal);
    };
    if (slope(0.) >= 0.)
      s = 0.;
    else if (slope(1.) <= 0.)
      s = 1.;
    else
      s = root_between(slope, 0., 1.);
    return at(s).ratio;
  }



  // Where the strength believes that slip goes.
  void FrictionLaw::find_forward(LocalSystem &local) const
  {
    const ContactState &start = local.start;
    const Tensor<1, 2>  rest  = local.trial - start.strength *
                                              (1. - start.normal_ratio) *
                                              local.core.centre;
    local.forward_norm = rest.norm();
    if (local.forward_norm > 0.)
      local.forward = rest / local.forward_norm;
  }



  // Slip may reverse the traction, so it can take more than T: as much as
  // leaves no r at all.
  void FrictionLaw::extend_reach(LocalSystem &local) const
  {
    stick(local);
    double more = local.core.centre.norm() * local.strength;
    for (unsigned int i = 0; more > 0. && i < 100; ++i, more *= 2.)
      {
        local.reach = local.trial_norm + more;
        evaluate(0., local);
        if (local.ratio <= 0.)
          break;
      }
  }



  // Where the circle is, for a strength that may depend on the work and so on
  // where the circle is.
  void FrictionLaw::place_core(LocalSystem &local) const
  {
    const CoreEvolution &evolution = local.evolution;
    const double         open      = 1. - local.normal_ratio.value;
    const auto           place     = [&] {
      const Tensor<1, 2> &trial = local.trial;
      local.centre = local.strength * open * evolution.kept * local.core.centre;
      const Tensor<1, 2> rest = trial - local.centre;
      local.offset            = rest.norm();
      local.normal = local.offset > 0. ? rest / local.offset : local.direction;
      // offset - alpha_t slip, of which T may be far larger than the rest.
      local.along = local.traction - (local.reach - local.trial_norm);
      const double sum = local.offset + local.trial_norm;
      if (sum > 0.)
        local.along += local.centre * (local.centre - 2. * trial) / sum;
      local.work =
        local.slip * (local.along + local.centre * local.normal) -
        (moved_core(local.start, local.strength, local.normal, local.slip)
           .energy -
         local.core.energy);
    };
    for (unsigned int iteration = 0; iteration < 50; ++iteration)
      {
        place();
        const double before = local.strength;
        evolve_strength(local);
        const double d_work = local.d_strength.d_work;
        if (d_work == 0.)
          break;
        const double slope =
          core_change(local, 0., Tensor<1, 2>(), 0., 1.).work;
        const double next =
          before + (local.strength - before) / (1. - d_work * slope);
        local.strength = std::max(next, before / 2.);
        if (std::abs(local.strength - before) <= 1e-14 * before)
          break;
      }
    place();
    local.ratio = local.along / local.strength - open * evolution.gained;
  }



  void FrictionLaw::evaluate_with_core(LocalSystem &local) const
  {
    local.normal_ratio =
      normal_ratio->normal_ratio_after_slip(local.start_ratio, local.slip);
    local.evolution = core->core_after_slip(local.slip);
    place_core(local);
    evaluate_flow(local);
    local.d_residual =
      core_change(local, 1., Tensor<1, 2>(), 0.).residual(local, 1.);
  }



  // With the strength given.
  FrictionLaw::CoreChange
  FrictionLaw::core_change(const LocalSystem  &local,
                           const double        d_slip,
                           const Tensor<1, 2> &d_trial,
                           const double        d_normal_ratio,
                           const double        d_strength) const
  {
    const CoreEvolution &evolution = local.evolution;
    const Tensor<1, 2>  &n         = local.normal;
    const double         strength = local.strength, slip = local.slip;
    const double         open = 1. - local.normal_ratio.value;

    CoreChange change;
    change.normal_ratio = d_normal_ratio;
    change.strength     = d_strength;
    change.centre       = (d_strength * open * evolution.kept -
                     strength * d_normal_ratio * evolution.kept +
                     strength * open * evolution.d_kept * d_slip) *
                    local.core.centre;
    const Tensor<1, 2> rest = d_trial - change.centre;
    if (local.offset > 0.)
      change.normal = (rest - (n * rest) * n) / local.offset;
    change.along = n * rest - alpha_t * d_slip;
    change.ratio =
      (change.along - local.along / strength * d_strength) / strength +
      d_normal_ratio * evolution.gained - open * evolution.d_gained * d_slip;

    const Tensor<1, 2> &c_0 = local.core.centre;
    const Tensor<1, 2>  c   = evolution.kept * c_0 + evolution.gained * n;
    const Tensor<1, 2>  d_c =
      d_slip * (evolution.d_kept * c_0 + evolution.d_gained * n) +
      evolution.gained * change.normal;
    const double held =
      core->core_length() *
      (d_strength * (c - c_0) * (c + c_0) / 2. + strength * (c * d_c));
    change.work =
      d_slip * (local.along + local.centre * n) +
      slip * (change.along + change.centre * n + local.centre * change.normal) -
      held;
    return change;
  }



  // With the strength that follows.
  FrictionLaw::CoreChange FrictionLaw::core_change(const LocalSystem  &local,
                                                   const double        d_slip,
                                                   const Tensor<1, 2> &d_trial,
                                                   const double d_normal) const
  {
    const Tensor<1, 2> &m = local.direction;
    Tensor<1, 2>        turn;
    if (local.trial_norm > 0.)
      turn = (d_trial - (m * d_trial) * m) / local.trial_norm;
    Tensor<1, 2> turn_forward;
    if (local.forward_norm > 0.)
      turn_forward = (d_trial - (local.forward * d_trial) * local.forward) /
                     local.forward_norm;
    const double d_start_strength = local.d_trial_strength_d_normal * d_normal +
                                    local.d_trial_strength_d_direction * turn +
                                    local.d_trial_strength_d_way * turn_forward;
    const double d_normal_ratio =
      local.normal_ratio.d_slip * d_slip +
      local.normal_ratio.d_start *
        (local.d_start_ratio_d_trial * d_trial +
         local.d_start_ratio_d_strength * d_start_strength);

    const Strength &d          = local.d_strength;
    const double    d_strength = d.d_slip * d_slip + d.d_normal * d_normal +
                              d.d_direction * turn + d.d_way * turn_forward;
    const auto change = [&](const double d_strength) {
      return core_change(local, d_slip, d_trial, d_normal_ratio, d_strength);
    };
    const CoreChange first = change(d_strength);
    if (d.d_work == 0.)
      return first;
    const double slope = core_change(local, 0., Tensor<1, 2>(), 0., 1.).work;
    return change(d_strength + d.d_work * first.work / (1. - d.d_work * slope));
  }



  ContactResponse
  FrictionLaw::linearise_with_core(const LocalSystem &local) const
  {
    ContactResponse response;
    response.traction     = local.centre + local.along * local.normal;
    const auto derivative = [&](const Tensor<1, 2> &d_trial,
                                const double        d_normal) {
      const double d_slip =
        -core_change(local, 0., d_trial, d_normal).residual(local, 0.) /
        local.d_residual;
      return core_change(local, d_slip, d_trial, d_normal).traction(local);
    };
    for (unsigned int i = 0; i < 2; ++i)
      {
        Tensor<1, 2> unit;
        unit[i]                   = 1.;
        const Tensor<1, 2> d_slip = alpha_t * derivative(unit, 0.);
        for (unsigned int j = 0; j < 2; ++j)
          response.d_slip[j][i] = d_slip[j];
      }
    response.d_normal = derivative(Tensor<1, 2>(), 1.);
    return response;
  }



  // The core after slip along a normal, with the energy that it takes at a
  // strength.
  ElasticCore FrictionLaw::moved_core(const ContactState &start,
                                      const double        strength,
                                      const Tensor<1, 2> &normal,
                                      const double        slip) const
  {
    ElasticCore         result    = core->core(start);
    const Tensor<1, 2>  before    = result.centre;
    const CoreEvolution evolution = core->core_after_slip(slip);
    result.centre = evolution.kept * before + evolution.gained * normal;
    result.energy += strength * core->core_length() *
                     ((result.centre - before) * (result.centre + before)) / 2.;
    return result;
  }



  // Along which a contact slips: n.
  Tensor<1, 2> FrictionLaw::slip_normal(const ContactState &state) const
  {
    if (!has_core())
      return direction_of(state);
    const Tensor<1, 2> rest =
      isotropic_traction(state.traction) -
      state.strength * (1. - state.normal_ratio) * core->core(state).centre;
    const double norm = rest.norm();
    return norm > 0. ? rest / norm : rest;
  }



  // See complete().
  void FrictionLaw::complete_with_core(ContactState &state) const
  {
    core->remember_core(core->core(state), state);
    const double normal_ratio = std::max(state.normal_ratio, 0.);
    state.loading_ratio = state.normal_ratio = 0.;
    if (!(state.strength > 0.))
      return;
    const Tensor<1, 2> traction = isotropic_traction(state.traction);
    state.loading_ratio         = traction.norm() / state.strength;
    const double largest =
      similarity(traction, state.strength, core->core(state).centre).ratio;
    state.normal_ratio =
      std::min({1., largest, flow == &neutral ? 1. : normal_ratio});
  }



  // As for r_s: the core that the last slip rate alone, over the whole step,
  // would make, and what it moves the circle.
  double FrictionLaw::error_of_core(const ContactState &start,
                                    const StageRecord  &last) const
  {
    const ContactState &end = last.end;
    if (!has_core() || !(end.slip_rate > 0.))
      return 0.;
    const Tensor<1, 2> one_stage =
      moved_core(start,
                 end.strength,
                 slip_normal(end),
                 end.slip_rate * last.time_step / TwoStages::gamma)
        .centre;
    return 0.5 * (1. - end.normal_ratio) *
           (one_stage - core->core(end).centre).norm();
  }
} // namespace SlipStep
