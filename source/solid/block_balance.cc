// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/block.h>

#include <slipstep/utilities/exceptions.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace SlipStep
{
  using namespace dealii;

  // Sum of the entries that belong to each displacement component: because
  // shape functions sum to one, the resultant of the forces.
  template <int dim>
  Tensor<1, dim> Block<dim>::sum_by_component(const Vector &vector) const
  {
    Tensor<1, dim> sums;
    const auto     first = vector.get_partitioner()->local_range().first;
    for (unsigned int d = 0; d < dim; ++d)
      for (const auto dof : dofs_of_component[d])
        sums[d] += vector.local_element(dof - first);
    return Utilities::MPI::sum(sums, communicator);
  }



  // Reactions and loads do work on displacements in space: those in the frame
  // plus the motion of the frame. A face that is held in space moves against
  // the frame, and its reactions do none.
  template <int dim>
  double Block<dim>::work_of_stage()
  {
    const Tensor<1, dim> frame_motion = frame_motion_in_stage();
    double               work         = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      for (const auto dof : supported_dofs[d])
        work += unbalanced(dof) *
                (solution(dof) - stage_solution(dof) + frame_motion[d]);
    // Of a load that comes down as material wears away the friction pays.
    work = Utilities::MPI::sum(work - contact.wear_work(), communicator) +
           drive.work_beyond(force_on_drive(unbalanced));

    Vector &loads = right_hand_side;
    loads         = 0.;
    add_loads(1., loads);
    return work + loads * solution - loads * stage_solution +
           sum_by_component(loads) * frame_motion;
  }



  template <int dim>
  void Block<dim>::check_balance_of_forces()
  {
    // Global balance: elastic forces have no resultant, so contact forces and
    // those of inertia are the loads plus all reactions; `unbalanced` holds
    // nothing but reactions.
    Vector &forces = right_hand_side;
    forces         = 0.;
    contact_forces.add_to(1., forces);
    const double normal_load =
      std::abs(sum_by_component(forces)[parameters.normal_axis()]);
    add_loads(-1., forces);
    inertia.add_forces(
      solution, stage_solution, frame_motion_in_stage(), stage_time, forces);
    for (const auto &line : homogeneous_constraints.get_lines())
      if (line.entries.empty() &&
          dof_handler.locally_owned_dofs().is_element(line.index))
        forces(line.index) -= unbalanced(line.index);
    if (normal_load > 0.)
      largest_imbalance =
        std::max(largest_imbalance,
                 sum_by_component(forces).norm() / normal_load);
  }



  // u . K u / 2, where K u is what the residual says of it, unless there is
  // more in it. The motion of the frame stores nothing.
  template <int dim>
  double Block<dim>::elastic_energy()
  {
    Vector &forces = right_hand_side;
    if (inertia.exists())
      {
        forces = 0.;
        system->add_elastic_forces(solution, forces);
        forces.compress(VectorOperation::add);
      }
    else
      {
        forces = unbalanced;
        contact_forces.add_to(-1., forces);
        add_loads(1., forces);
      }
    return 0.5 * (forces * solution);
  }



  // @sect3{When it goes wrong}

  // A block without contact is free to move, so there is nothing left to
  // compute, unless it is held and has yet to touch.
  template <int dim>
  void Block<dim>::check_contact(const ContactTotals &totals)
  {
    largest_normal_load = std::max(largest_normal_load, totals.normal_load);
    contact_share       = totals.area / parameters.nominal_contact_area();
    // What a flat face has not reached by then is open as well.
    largest_contact_share = parameters.surface.is_curved() ?
                              std::max(largest_contact_share, contact_share) :
                              1.;
    if (largest_contact_share - contact_share > opening.share &&
        control.time() > parameters.time_of_first_wave())
      opening = {largest_contact_share - contact_share, control.time()};
    const bool has_yet_to_touch =
      parameters.surface.is_curved() && parameters.is_held_along_normal() &&
      largest_normal_load == 0. && !control.is_finished();
    // With a density a block may come off the plane and return.
    const bool is_off = totals.normal_load <= 1e-6 * largest_normal_load &&
                        !has_yet_to_touch && !parameters.is_dynamic();
    if (is_off || (control.is_finished() && largest_normal_load == 0.))
      {
        std::ostringstream message;
        message << "no contact pressure is left at t = " << control.time()
                << (largest_normal_load > 0. ?
                      " s: the block has come off the plane" :
                      " s: the block has not touched the plane");
        throw RunError(message.str());
      }

    // Along a side of the block the motion is measured by that side: a thin
    // strip may be stretched by more than its height, but not rise as much, and
    // the load on a high block must stay above its foot.
    for (unsigned int d = 0; d < dim; ++d)
      {
        double motion = 0.;
        for (const auto dof : dofs_of_component[d])
          motion = std::max(motion, std::abs(solution(dof)));
        motion = Utilities::MPI::max(motion, communicator);
        if (motion <= 0.05 * parameters.size[d])
          continue;
        std::ostringstream message;
        message << "points of the block have moved by " << motion
                << " mm along "
                << "xyz"[d]
                << " with respect to the drive, which is too much for small "
                   "strains and rotations";
        failure = message.str();
        throw RunError("At t = " + std::to_string(control.time()) + " s " +
                       reason_of_failure());
      }
  }



  // The state of the contact tells more than the algebra, unless that has a
  // remedy of its own.
  template <int dim>
  std::string Block<dim>::reason_of_failure() const
  {
    std::ostringstream message;
    if (largest_normal_load > 0. && contact_share < 0.6 &&
        !parameters.surface.is_curved())
      message << "the block tips over: only "
              << std::round(100. * contact_share)
              << " % of its face is still in contact (" << failure << ")";
    else if (control.time() == 0. &&
             failure.find("'set Solver = automatic'") == std::string::npos)
      message << "not even the beginning of the loads is in equilibrium: they "
                 "lift the block or tip it over, or, if they do hold it on the "
                 "plane, more Block/Newton iterations than "
              << parameters.newton_iterations
              << " or, where round-off is in the way, a larger Block/Newton "
                 "tolerance may help ("
              << failure << ")";
    else if (drive.is_unknown() && drive.mass() == 0. && !inertia.exists())
      message << drive.reason_of_failure() << " (" << failure << ")";
    else
      message << failure << remedy_of_jumps();
    return message.str();
  }



  // Between stick and slip there is no equilibrium then, however short the
  // step.
  template <int dim>
  std::string Block<dim>::remedy_of_jumps() const
  {
    const Segment &now     = programme.segment_at(control.end_of_step());
    const auto    &effects = contact.friction_law().effects();
    if (opening.share > 1e-9 &&
        std::find(effects.begin(), effects.end(), "adhesion") != effects.end())
      return "; where the face lifts off, its bonds (effect adhesion) break at "
             "once, and there may be no equilibrium between";
    if (inertia.exists() || now.end.velocity.norm() == 0.)
      return "";
    return "; where friction falls with slip or speed a block this soft may "
           "jump, which a Block/Density lets it do, or viscous friction "
           "(effect viscous) slow down";
  }



  namespace
  {
    // Subdivisions that cannot be halved leave a coarsest mesh for multigrid
    // which is factorised in every Newton step; others nearby can. "" if it is
    // small enough.
    std::string warning_of_subdivisions(const BlockParameters &parameters)
    {
      const auto   begin = parameters.subdivisions.begin();
      const auto   end   = begin + parameters.dimension;
      unsigned int most = 1, factor = 1; // powers of 2
      while (2 * most <= std::min(*std::min_element(begin, end), 8u))
        most *= 2;
      const auto is_divisible = [&](const unsigned int n) {
        return n % (2 * factor) == 0;
      };
      while (std::all_of(begin, end, is_divisible))
        factor *= 2;
      double             n_coarse = parameters.dimension;
      std::ostringstream present, better;
      for (auto n = begin; n != end; ++n)
        {
          n_coarse *= 1. + *n / factor;
          present << (n == begin ? "" : ", ") << *n;
          better << (n == begin ? "" : ", ") << (*n + most / 2) / most * most;
        }
      if (n_coarse < 3000. || factor >= most)
        return "";
      return "the subdivisions " + present.str() +
             " cannot be halved often enough for multigrid: its coarsest mesh "
             "has " +
             std::to_string(std::lround(n_coarse)) +
             " unknowns, and they are solved directly in every iteration; "
             "'set Subdivisions = " +
             better.str() +
             "' in section Block is "
             "cheaper";
    }
  } // namespace



  // The edge of a contact with a gap moves, and so does the mesh: what is less
  // than 1 % of the face is not worth a word there.
  template <int dim>
  std::string Block<dim>::warning_of_opening() const
  {
    const bool is_curved = parameters.surface.is_curved();
    if (is_curved && opening.share < 0.01)
      return "";
    std::ostringstream message;
    message << "part of the contact face lifted off the plane: at worst "
            << std::setprecision(3) << 100. * opening.share << " % of it "
            << (is_curved ? "had touched and " : "")
            << "was open, at t = " << std::setprecision(6) << opening.time
            << " s (";
    if (is_curved)
      message << "less pressure or friction leaves a gap open again";
    else if (inertia.exists())
      message << "waves lift a block with density, or friction turns it; "
                 "slower statements or a 'Damping time' calm waves";
    else
      message << "friction turns a block that is high for its length, or what "
                 "holds and pulls its faces lifts it";
    message << ')';
    return message.str();
  }



  template <int dim>
  void Block<dim>::fill(Summary &summary) const
  {
    summary.dimension         = dim;
    summary.cells             = triangulation.n_global_active_cells();
    summary.dofs              = dof_handler.n_dofs();
    summary.ranks             = Utilities::MPI::n_mpi_processes(communicator);
    summary.steps             = control.n_accepted();
    summary.rejected_steps    = control.n_rejected();
    summary.newton_iterations = n_newton_total;
    summary.linear_iterations = n_linear_total;
    summary.mesh_error        = tolerance.summary();
    summary.warnings.clear();
    const Segment &first = programme.segments().front();
    if (load_cases[gradual].force.l2_norm() > 0. &&
        first.end.velocity.norm() > 0.)
      summary.warnings.push_back(
        "loads of the faces grow during the first statement of the programme, "
        "while the block slides; 'hold 1 s' before it, or 'at once' behind the "
        "load, lets them act before it slides");
    if (load_cases[programme_pressure].force.l2_norm() == 0. &&
        std::any_of(programme.segments().begin(),
                    programme.segments().end(),
                    [](const Segment &now) { return now.end.pressure > 0.; }))
      summary.warnings.push_back(
        "the programme presses, but no face has 'pressure programme': only the "
        "other loads of section Block/Faces press the block on the plane");
    constexpr double noticed = 0.005;
    if (std::abs(strength_error) > noticed)
      {
        std::ostringstream message;
        message << "the contact points see the map Contact/Strength too "
                << (strength_error > 0. ? "high" : "low") << ", by "
                << std::setprecision(2) << 100. * std::abs(strength_error)
                << " % on average: they are too far apart for it; more "
                   "Block/Subdivisions, with borders of cells where the map "
                   "jumps, tell it better";
        summary.warnings.push_back(message.str());
      }
    // Round-off of sums of areas opens nothing.
    if (opening.share > 1e-9)
      {
        summary.opening = opening;
        if (const std::string warning = warning_of_opening(); !warning.empty())
          summary.warnings.push_back(warning);
      }
    const std::string solver_warning = warning_of_solver();
    if (!solver_warning.empty())
      summary.warnings.push_back(solver_warning);
    if (parameters.solver_for(dof_handler.n_dofs()) == SolverType::multigrid)
      {
        const std::string warning = warning_of_subdivisions(parameters);
        if (!warning.empty())
          summary.warnings.push_back(warning);
      }
    if (most_cells_wanted > 0.)
      summary.warnings.push_back(
        "the mesh reached the limit set in section Block/Adaptivity: at worst " +
        std::to_string(std::llround(most_cells_wanted)) +
        " more cells were wanted than are allowed");
    if (!summary.missed_tolerance().empty())
      summary.warnings.push_back(summary.missed_tolerance() + ": " +
                                 tolerance.remedy());
    if (largest_jump > 1e-3)
      {
        std::ostringstream message;
        message << "the friction force jumped by up to " << std::setprecision(2)
                << 100. * largest_jump
                << " % when the mesh changed (see refinement.csv); a smaller "
                   "'Tolerance' in section Block/Adaptivity or more "
                   "subdivisions make it smoother";
        summary.warnings.push_back(message.str());
      }
  }



#ifndef SLIPSTEP_UNITY_BUILD
  template class Block<2>;
  template class Block<3>;
#endif
} // namespace SlipStep
