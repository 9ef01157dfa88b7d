// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/block.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  using namespace dealii;

  // @sect3{First touch}

  // A block that nothing holds up, whose face is not flat, stands on what
  // touches first.
  template <int dim>
  bool Block<dim>::is_put_down() const
  {
    return control.time() == 0. && parameters.surface.is_curved() &&
           !parameters.is_held_along_normal();
  }



  namespace
  {
    // Before anything slides.
    double time_of_largest_load(const Programme &programme)
    {
      double pressure = 0., time = programme.segments().front().end_time;
      for (const Segment &segment : programme.segments())
        {
          if (segment.pushes || segment.end.velocity.norm() > 0.)
            break;
          if (segment.end.pressure > pressure)
            {
              pressure = segment.end.pressure;
              time     = segment.end_time;
            }
        }
      return time;
    }
  } // namespace



  // If that is not below its load it tips, by a finite angle however small the
  // load, which no error of the step tells: so the first step is as short as
  // the tolerance, and of one stage. Newton's method finds the way there from
  // larger loads, which more of the face bears; where it loses it, the step is
  // as short as it may be.
  template <int dim>
  bool Block<dim>::settle()
  {
    constexpr double less = 0.25;

    const auto solve = [&](const LoadFactors &factors, const double time) {
      begin_stage(control.end_of_step(), time);
      load_factors = factors;
      if (drive.is_unknown())
        begin_modes();
      impose_displacements();
      return solve_stage();
    };
    const double      loading = time_of_largest_load(programme);
    const LoadFactors largest = load_factors_at(programme, first_step, loading);
    LoadFactors       now =
      load_factors_at(programme, first_step, control.end_of_step());
    Vector guess = old_solution;
    double borne = 0.;
    for (double share = 1.; share * largest[0] > now[0] && !is_given_up;
         share *= less)
      {
        LoadFactors factors = largest;
        for (double &factor : factors)
          factor *= share;
        solution = guess;
        if (solve(factors, std::max(share * loading, control.step_size())))
          {
            guess = solution;
            borne = share * largest[0];
          }
      }
    solution = guess;
    if (!is_given_up && !solve(now, control.step_size()) && borne > now[0] &&
        control.n_rejected() == 0)
      {
        control.plan_anew(control.step_size() * borne / now[0]);
        solution = guess;
        now = load_factors_at(programme, first_step, control.end_of_step());
        solve(now, control.step_size());
      }
    return !is_given_up && newton.failure.empty() && finish_stage(1.);
  }



  // A face that is not flat may touch nowhere yet, and a block that nothing
  // holds would fall for ever. It is put down as a rigid body until it bears
  // its load; Newton's method spreads it from there.
  template <int dim>
  bool Block<dim>::bring_to_touch()
  {
    if (!parameters.surface.is_curved() || parameters.is_held_along_normal() ||
        contact_forces.l2_norm() > 0.)
      return false;
    Vector loads(right_hand_side);
    loads = 0.;
    add_loads(1., loads);
    const unsigned int normal = parameters.normal_axis();
    const double       sign   = parameters.outward_sign();
    const double       load   = sign * sum_by_component(loads)[normal];
    if (!(load > 0.))
      return false;
    const double approach = contact.rigid_approach(load, communicator);
    solution.zero_out_ghost_values();
    for (const auto dof : dofs_of_component[normal])
      solution(dof) += sign * approach;
    solution.update_ghost_values();
    return true;
  }



  // Of a block that is held, no force may act before it touches. What is
  // balanced then are the forces of its elements, whose round-off is that of
  // stiffness times displacement.
  template <int dim>
  double Block<dim>::least_force_scale() const
  {
    if (!parameters.surface.is_curved() || !parameters.is_held_along_normal())
      return 0.;
    constexpr double share = 1e-5; // far above round-off, far below a load
    const double     shortest =
      *std::min_element(parameters.size.begin(), parameters.size.begin() + dim);
    return share * parameters.young_modulus * solution.linfty_norm() *
           std::pow(shortest, dim - 2);
  }



  // Of all the files that have members: this is the last one.
  template class Block<2>;
  template class Block<3>;
} // namespace SlipStep
