// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/block.h>

#include <slipstep/solid/supports.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/text.h>

#include <deal.II/fe/fe_q.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  using namespace dealii;

  // @sect3{Construction}

  // All decisions have been made when the parameters were read. The elements
  // are continuous, of degree p in each of the displacement components; the
  // contact points sit at the Gauss points of the contact face, with p+1 points
  // per direction.
  template <int dim>
  Block<dim>::Block(const BlockParameters &parameters,
                    const FrictionLaw     &law,
                    const Programme       &programme,
                    const StepControl     &control,
                    const MPI_Comm        &communicator,
                    const Machine         &machine)
    : parameters(parameters)
    , programme(programme)
    , communicator(communicator)
    , triangulation(communicator,
                    Triangulation<dim>::none,
                    parallel::distributed::Triangulation<
                      dim>::mesh_reconstruction_after_repartitioning)
    , fe(FE_Q<dim>(parameters.degree), dim)
    , dof_handler(triangulation)
    , contact(parameters, law)
    , inertia(parameters)
    , first_step(control.step_size())
    , control(control)
    , drive(machine, programme, parameters.nominal_contact_area())
    , marker(parameters)
    , tolerance(parameters.refinement)
  {
    make_grid();
    setup_system();
    old_solution.update_ghost_values();
    if (is_put_down())
      this->control.plan_anew(control.wanted_error() *
                              programme.segments().front().end_time);
  }



  // @sect3{The programme, step by step}

  // Every step ends in one of four ways: Newton's method fails and the step is
  // cut; the friction law finds the step too coarse and it is repeated smaller;
  // the solution asks for a finer mesh and the step is repeated on it; or it is
  // accepted, the contact points commit their states, and the displacements
  // move one place back.
  template <int dim>
  void Block<dim>::run(BlockOutput<dim>                              *output,
                       const std::function<void(const HistoryRow &)> &observe,
                       const std::function<void()> &between_steps,
                       const std::function<bool()> &gives_up_step)
  {
    this->gives_up_step   = gives_up_step;
    const auto make_again = [&]() {
      solution = old_solution;
      if (between_steps)
        between_steps();
    };
    const SlidingPath path(programme);
    old_loading              = programme.at(control.time());
    old_loading.displacement = drive.state().slip;
    while (!control.is_finished())
      {
        if (!make_step())
          {
            if (is_given_up)
              forget_iterations();
            else
              control.cut(reason_of_failure());
            make_again();
            continue;
          }

        const ContactTotals totals     = contact.totals(communicator);
        const double        start      = control.time();
        const double        step_size  = control.step_size();
        const double        start_path = path.at(start) + drive.pushed_path();
        const StepError     error      = error_of_step(totals);
        if (control.would_accept(error.measure()) && adapt_to_trial(output))
          continue;
        const bool is_first = control.is_first_of_segment();
        if (!control.accept(error, remedy_of_jumps()))
          {
            make_again();
            continue;
          }
        if (is_first && drive.is_unknown() && !inertia.exists())
          control.note_lost_swing(drive.lost_swing(drive_springs,
                                                   totals.limit_load),
                                  start);

        const HistoryRow row = accept_step(totals, step_size);
        observe(row);
        check_contact(totals);
        if (output != nullptr)
          output->write_if_due(dof_handler,
                               solution,
                               old_loading.displacement,
                               contact,
                               load_factors,
                               {start,
                                row.time,
                                start_path,
                                path.at(row.time) + drive.pushed_path(),
                                control.n_accepted(),
                                control.is_first_of_statement(),
                                control.is_finished()});
        adapt_after_step(output);
        if (control.is_first_of_statement())
          begin_with_first_solver();
        if (between_steps)
          between_steps();
      }
  }



  // On a new mesh the contact finds another equilibrium at once, however short
  // the step; the step's length was fine before.
  template <int dim>
  StepError Block<dim>::error_of_step(const ContactTotals &totals)
  {
    StepError error;
    if (!is_put_down())
      {
        const double weight =
          programme.weight_of_error(control.time(), control.end_of_step());
        error        = contact.step_error(communicator);
        error.at_end = std::max(
          {error.at_end * weight,
           inertia.exists() ? error_of_motion(totals) :
                              drive.error(drive_springs, totals.limit_load)});
        error.of_line *= weight;
        error.at_end = std::max(error.at_end, error_of_wear(totals));
      }
    if (mesh_is_new)
      error.limit_to(control.wanted_error());
    return error;
  }



  // Where the approach of a face is held instead of its load, wear takes the
  // pressure away, which no contact point sees as an error of its own: its load
  // is given to it. By how much the two orders differ follows from the worn
  // depths at the ends of the stages; block and contact give way in series.
  template <int dim>
  double Block<dim>::error_of_wear(const ContactTotals &totals) const
  {
    constexpr double gamma = TwoStages::gamma;
    if (!wears_at_held_approach() || !(totals.normal_load > 0.))
      return 0.;
    const double bend =
      std::abs((1. - gamma) * worn_depth_at_start +
               gamma * mean_worn_depth(totals) - worn_depth_of_stage) /
      (gamma * (1. - gamma));
    const double stiffness =
      1. /
      (parameters.size[parameters.normal_axis()] / parameters.young_modulus +
       1. / contact.friction_law().normal_stiffness());
    return stiffness * bend * parameters.nominal_contact_area() /
           totals.normal_load;
  }



  template <int dim>
  bool Block<dim>::wears_at_held_approach() const
  {
    return contact.friction_law().wear_rate() > 0. &&
           parameters.is_held_along_normal();
  }



  // @sect3{Two stages}

  // A step is made of two implicit stages (TwoStages), each in equilibrium. The
  // second starts where displacements, motion of the frame and histories would
  // be if they went on as in the first. Work is the integral of power by the
  // same scheme.
  template <int dim>
  bool Block<dim>::make_step()
  {
    constexpr double gamma = TwoStages::gamma, carry = TwoStages::carry;

    contact.revert();
    is_given_up = false;
    trial_work = trial_damped_energy = 0.;
    newton.n_iterations = newton.n_linear = 0;
    stage_solution                        = old_solution;
    stage_frame                           = old_loading.displacement;
    drive.begin_step(control.time(), control.is_first_of_segment());
    inertia.begin_step();
    if (is_put_down())
      return settle();
    const double begin = control.time(), step_size = control.step_size();
    begin_stage(begin + gamma * step_size, gamma * step_size);
    if (drive.is_unknown())
      begin_modes();
    predict();
    if (!finish_stage(carry))
      return false;
    if (wears_at_held_approach())
      worn_depth_of_stage = mean_worn_depth(contact.totals(communicator));

    contact.begin_second_stage();
    stage_solution.sadd(1. - carry, carry, solution);
    stage_solution.update_ghost_values();
    drive.begin_second_stage();
    inertia.begin_second_stage();
    const Tensor<1, 2> motion = loading.displacement - stage_frame;
    stage_frame += carry * motion;
    begin_stage(control.end_of_step(), gamma * step_size);
    solution.sadd(1. / gamma, 1. - 1. / gamma, old_solution);
    if (drive.is_unknown())
      move_frame_to(old_loading.displacement + 1. / gamma * motion);
    impose_displacements();
    return finish_stage(1.);
  }



  template <int dim>
  BlockState<dim> Block<dim>::state() const
  {
    return {dof_handler,
            old_solution,
            parameters.template in_plane<dim>(old_loading.displacement),
            contact,
            drive,
            control,
            tolerance.summary(),
            mesh_changes,
            newton.residual_norms,
            largest_imbalance};
  }



  template <int dim>
  void Block<dim>::begin_stage(const double end_time, const double time_step)
  {
    loading      = programme.at(end_time);
    load_factors = load_factors_at(programme, first_step, end_time);
    stage_time   = time_step;
    drive.begin_stage(end_time, time_step);
    move_frame_to(drive.displacement(0.));
  }



  template <int dim>
  void Block<dim>::add_loads(const double factor, Vector &vector) const
  {
    for (unsigned int k = 0; k < n_load_parts; ++k)
      load_cases[k].force.add_to(factor * load_factors[k], vector);
  }



  template <int dim>
  bool Block<dim>::finish_stage(const double weight)
  {
    if (!solve_stage())
      return false;
    drive.end_stage(loading.displacement, force_on_drive(unbalanced));
    if (drive.is_faster_than_waves() && !inertia.exists())
      {
        // Or what sticks is soft, and pushed that fast.
        const ContactTotals totals = contact.totals(communicator);
        if (totals.slip_area > 0.99 * totals.area)
          {
            newton.failure = "the block would slip faster than its waves "
                             "travel";
            return false;
          }
      }
    trial_work += weight * work_of_stage();
    if (inertia.exists())
      {
        inertia.end_stage(solution,
                          stage_solution,
                          frame_motion_in_stage(),
                          stage_time);
        trial_damped_energy += weight * damped_energy_of_stage();
      }
    return true;
  }



  // @sect3{First guess}

  // The displacements go on as in the last step, except where the programme has
  // a kink.
  template <int dim>
  void Block<dim>::predict()
  {
    solution = old_solution;
    if (!control.is_first_of_segment() && old_step > 0.)
      {
        const double factor = stage_time / old_step;
        solution.sadd(1. + factor, -factor, older_solution);
        if (drive.is_unknown())
          move_frame_to(drive.displacement(factor));
      }
    impose_displacements();
  }



  template <int dim>
  void Block<dim>::impose_displacements()
  {
    constrain(solution);
    for (unsigned int k = 0; k < n_load_parts; ++k)
      load_cases[k].displacement.add_to(load_factors[k], solution);
    solution.update_ghost_values();
  }



  // @sect3{Newton's method}

  // Per iteration: forces that are out of balance, tangent of the contact face,
  // one linear system (more of them where the drive is pushed), and as much of
  // the update as lowers the residual.
  template <int dim>
  bool Block<dim>::solve_stage()
  {
    newton.residual_norms.clear();
    newton.failure.clear();
    newton.n_uphill = 0;
    Vector       update(right_hand_side);
    Tensor<1, 2> motion;

    double norm = compute_residual();
    if (bring_to_touch())
      norm = compute_residual();
    for (unsigned int n = 0;; ++n)
      {
        newton.residual_norms.push_back(norm / newton.force_scale);
        if (!std::isfinite(norm))
          {
            newton.failure = "the forces are not finite";
            return false;
          }
        // At least one iteration, so that every step is an equilibrium of its
        // own and not a guess that happens to be good enough.
        if (n > 0 && (norm <= wanted_norm() || only_round_off_is_left()))
          return true;
        if (n == parameters.newton_iterations)
          {
            newton.failure = "Newton's method did not converge in " +
                             std::to_string(n) +
                             " iterations: the forces are out of balance by " +
                             short_text(norm / newton.force_scale, 6) +
                             " of the contact force, allowed are " +
                             short_text(newton_tolerance(), 6);
            return false;
          }

        is_given_up = gives_up_step && gives_up_step();
        if (is_given_up)
          return false;
        try
          {
            count_linear_iterations(
              solve_linear_system(update, linear_tolerance(norm)));
            constrain(update);
            if (drive.is_unknown())
              motion = move_drive(update);
          }
        catch (const RunError &error)
          {
            newton.failure = error.what();
            return false;
          }
        ++newton.n_iterations;
        ++n_newton_total;

        norm = line_search(update, motion, norm);
      }
  }



  // A share e of the load out of balance moves a block that is far softer than
  // its contact by e p H / E, which a contact that sticks again feels as
  // alpha_t times that: no more than a part of what steps may err.
  template <int dim>
  double Block<dim>::newton_tolerance() const
  {
    constexpr double   part = 0.02, digits = 1e-12;
    const FrictionLaw &law = contact.friction_law();
    const double       share =
      part * control.wanted_error() * law.static_coefficient() *
      parameters.young_modulus /
      (parameters.size[parameters.normal_axis()] * law.tangential_stiffness());
    return std::min(parameters.newton_tolerance, std::max(share, digits));
  }



  // What counts as balanced. The shorter a step, the larger the forces of
  // inertia into which the round-off of displacements turns, and no iteration
  // takes that away.
  template <int dim>
  double Block<dim>::wanted_norm() const
  {
    const double of_drive =
      drive.is_unknown() ? newton.drive_weight * drive.round_off() : 0.;
    return std::max(
      {newton_tolerance() * newton.force_scale,
       of_drive,
       inertia.round_off(solution, loading.displacement.norm(), stage_time)});
  }



  // Those of a step that is made again after a stop count then.
  template <int dim>
  void Block<dim>::forget_iterations()
  {
    n_newton_total -= newton.n_iterations;
    n_linear_total -= newton.n_linear;
  }



  // Forces in a very stiff or a tilting block are differences of large numbers.
  // Close to its end Newton's method gains digits quickly; where it gains none
  // there are none.
  template <int dim>
  bool Block<dim>::only_round_off_is_left() const
  {
    const std::size_t n = newton.residual_norms.size();
    return n > 2 && newton.residual_norms[n - 1] <= 10. * newton_tolerance() &&
           newton.residual_norms[n - 1] > 0.5 * newton.residual_norms[n - 2];
  }



  // An inexact Newton method: an iteration with the exact tangent leaves some
  // ten times the square of the relative residual, so nothing is gained by
  // solving the linear system much better than that; nor much below what is
  // wanted in the end.
  template <int dim>
  double Block<dim>::linear_tolerance(const double norm) const
  {
    const double forcing = std::min(0.01, 5. * norm / newton.force_scale);
    return std::max({1e-13 * norm, forcing * norm, 0.5 * wanted_norm()});
  }



  // The whole update is the best guess at the other side of a kink. Between
  // kinks it goes round and round, and a little of it finds the way out; never
  // the same share, nor the same way in the next try of a step.
  template <int dim>
  double Block<dim>::share_of_uphill_update()
  {
    constexpr double golden = 0.6180339887498949, most = 0.03, range = 10.;

    const unsigned int k = newton.n_uphill++, n_tries = control.n_tries();
    if (k == 0 && n_tries % 2 == 0)
      return 1.;
    return most * std::pow(range, -std::fmod((k + n_tries) * golden, 1.));
  }



  // Halve the update until the residual falls, if it ever does.
  template <int dim>
  double Block<dim>::line_search(const Vector       &update,
                                 const Tensor<1, 2> &motion,
                                 const double        old_norm)
  {
    double     taken          = 0.;
    const auto residual_after = [&](const double share) {
      solution.add(share - taken, update);
      move_frame_to(loading.displacement + (share - taken) * motion);
      taken = share;
      solution.update_ghost_values();
      return compute_residual();
    };

    for (double share = 1.; share > 0.05; share /= 2.)
      {
        const double norm = residual_after(share);
        if (norm < (1. - 1e-4 * share) * old_norm || norm <= wanted_norm())
          return norm;
      }
    return residual_after(share_of_uphill_update());
  }



  // Internal minus external forces, those of inertia included. They are summed
  // first for all unknowns, supported or not, since the sums over supports are
  // their reactions; forces at hanging nodes belong to the nodes on which they
  // hang. For Newton's method the entries of all constrained unknowns are then
  // moved to the unknowns that they depend on.
  template <int dim>
  double Block<dim>::compute_residual()
  {
    contact.update(solution,
                   stage_solution,
                   loading.displacement - stage_frame,
                   stage_time);
    is_linearised = false;
    unbalanced    = 0.;
    contact.add_forces(unbalanced);
    unbalanced.compress(VectorOperation::add);
    contact_forces     = FaceVector(unbalanced);
    newton.force_scale = contact_forces.l2_norm();
    // The force of the drive is a sum over nodes, as that of the contact.
    if (drive.is_unknown())
      newton.drive_weight =
        newton.force_scale / std::max(unbalanced.l1_norm(), 1e-300);

    system->add_elastic_forces(strained_displacement(), unbalanced);
    unbalanced.compress(VectorOperation::add);
    newton.force_scale = std::max(newton.force_scale,
                                  inertia.add_forces(solution,
                                                     stage_solution,
                                                     frame_motion_in_stage(),
                                                     stage_time,
                                                     unbalanced));
    add_loads(-1., unbalanced);
    move_to_masters(hanging_constraints, unbalanced);
    newton.force_scale = std::max(newton.force_scale, 1e-300);
    for (unsigned int k = 0; k < n_load_parts; ++k)
      newton.force_scale =
        std::max(newton.force_scale,
                 std::abs(load_factors[k]) * load_cases[k].force.l2_norm());
    newton.force_scale = std::max(newton.force_scale, least_force_scale());

    right_hand_side = 0.;
    right_hand_side.add(-1., unbalanced);
    move_to_masters(homogeneous_constraints, right_hand_side);
    return std::hypot(right_hand_side.l2_norm(),
                      newton.drive_weight * force_missing_on_drive().norm());
  }



  // @sect3{An accepted step}

  // The states of the contact points are committed, and the work of the drive
  // and of the loads is added up. What the block stores plus what friction has
  // dissipated should equal it; the difference is an error of the time steps,
  // of second order.
  template <int dim>
  HistoryRow Block<dim>::accept_step(const ContactTotals &totals,
                                     const double         step_size)
  {
    old_step    = step_size;
    mesh_is_new = false;
    if (is_marked)
      tolerance.add(control.time(), last_marked);
    contact.commit();
    worn_depth_at_start = mean_worn_depth(totals);
    external_work += trial_work;
    damped_energy += trial_damped_energy;
    inertia.accept();
    check_balance_of_forces();
    note_lean(totals);
    drive.accept(totals.normal_load / parameters.nominal_contact_area());

    HistoryRow row;
    row.time          = control.time();
    row.step_size     = step_size;
    const double load = totals.normal_load;
    // What round-off leaves of a load that was taken off has no friction.
    constexpr double round_off = 1e-9;
    for (unsigned int i = 0; i < 2; ++i)
      (i == 0 ? row.friction : row.friction_y) =
        load > round_off * largest_normal_load ?
          totals.tangential_load[i] / load :
          0.;
    row.displacement    = drive.load_point()[0];
    row.displacement_y  = drive.load_point()[1];
    row.pressure        = load / parameters.nominal_contact_area();
    row.normal_load     = load;
    row.tangential_load = totals.tangential_load[0];
    row.loading_ratio   = totals.loading_ratio;
    row.normal_ratio    = totals.normal_ratio;
    row.coefficient     = totals.coefficient;
    row.slip_fraction = totals.area > 0. ? totals.slip_area / totals.area : 0.;
    row.dissipated_energy = totals.dissipated + damped_energy;
    const double kinetic  = inertia.kinetic_energy();
    row.kinetic_energy    = kinetic + drive.kinetic_energy();
    row.stored_energy =
      totals.stored + elastic_energy() + drive.stored_energy() + kinetic;
    row.external_work     = external_work;
    row.newton_iterations = newton.n_iterations;
    row.linear_iterations = newton.n_linear;
    row.slip              = totals.slip;
    row.memories          = totals.memories;

    older_solution = old_solution;
    old_solution   = solution;
    old_solution.update_ghost_values();
    old_loading = loading;
    return row;
  }
} // namespace SlipStep
