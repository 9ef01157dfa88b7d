#include <slipstep/solid/block.h>

#include <slipstep/utilities/exceptions.h>

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>

#include <deal.II/grid/grid_generator.h>

#include <deal.II/numerics/vector_tools.h>

#include <algorithm>
#include <cmath>
#include <sstream>

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
                    const MPI_Comm        &communicator)
    : parameters(parameters)
    , programme(programme)
    , communicator(communicator)
    , triangulation(communicator)
    , fe(FE_Q<dim>(parameters.degree), dim)
    , dof_handler(triangulation)
    , contact(parameters, law)
    , control(control)
  {
    make_grid();
    setup_unknowns();
    find_groups_of_unknowns();
    contact.reinit(dof_handler);
    assemble_loads();
    choose_solver();
  }



  // @sect3{Mesh and unknowns}

  // The box has one coarse cell per subdivision. Its faces are numbered as
  // deal.II does (left, right, ...), which is also how the case file's
  // conditions are stored.
  template <int dim>
  void Block<dim>::make_grid()
  {
    Point<dim>                upper;
    std::vector<unsigned int> subdivisions(dim);
    for (unsigned int d = 0; d < dim; ++d)
      {
        upper[d]        = parameters.size[d];
        subdivisions[d] = parameters.subdivisions[d];
      }
    GridGenerator::subdivided_hyper_rectangle(
      triangulation, subdivisions, Point<dim>(), upper, true);
  }



  // A rank stores the unknowns of its own cells and of their neighbours. If a
  // face is flat, every rank that has a part of it also needs the one unknown
  // to which all others are tied; asking the constraints tells which.
  template <int dim>
  void Block<dim>::setup_unknowns()
  {
    dof_handler.distribute_dofs(fe);
    DoFTools::extract_locally_relevant_dofs(dof_handler, relevant_dofs);
    AffineConstraints<double> probe;
    prescribe_displacements(Tensor<1, 2>(), probe);
    std::vector<types::global_dof_index> masters;
    for (const auto &line : probe.get_lines())
      for (const auto &entry : line.entries)
        masters.push_back(entry.first);
    std::sort(masters.begin(), masters.end());
    relevant_dofs.add_indices(masters.begin(),
                              std::unique(masters.begin(), masters.end()));
    relevant_dofs.compress();

    prescribe_displacements(Tensor<1, 2>(), homogeneous_constraints);
    for (const auto &line : homogeneous_constraints.get_lines())
      homogeneous_constraints.set_inhomogeneity(line.index, 0.);

    for (Vector *vector : {&solution,
                           &old_solution,
                           &older_solution,
                           &constant_load,
                           &unit_pressure_load,
                           &unbalanced,
                           &old_unbalanced,
                           &forces,
                           &right_hand_side})
      vector->reinit(dof_handler.locally_owned_dofs(),
                     relevant_dofs,
                     communicator);
  }



  // @sect3{Supports}

  // Displacements are prescribed in space, but the unknown is relative to the
  // frame of the drive: along the contact plane the displacement of the frame
  // is subtracted. For a driven face nothing is left. Where faces meet, the
  // driven face has the last word.
  template <int dim>
  void Block<dim>::prescribe_displacements(
    const Tensor<1, 2>        &frame,
    AffineConstraints<double> &constraints) const
  {
    constraints.reinit(relevant_dofs);
    for (const bool driven_pass : {true, false})
      for (unsigned int f = 0; f < 2 * dim; ++f)
        {
          const FaceConditions &face = parameters.faces[f];
          ComponentMask         mask(dim, false);
          std::vector<double>   values(dim, 0.);
          for (unsigned int d = 0; d < dim; ++d)
            if (!driven_pass && face.is_prescribed[d])
              {
                mask.set(d, true);
                values[d] = face.displacement[d];
              }
          for (unsigned int i = 0; i < dim - 1; ++i)
            {
              const unsigned int axis = parameters.tangential_axis(i);
              if (driven_pass && face.is_driven)
                mask.set(axis, true);
              values[axis] -= (driven_pass ? 0. : frame[i]);
            }
          if (mask.n_selected_components() > 0)
            VectorTools::interpolate_boundary_values(
              dof_handler,
              f,
              Functions::ConstantFunction<dim>(values),
              constraints,
              mask);
        }
    make_flat_faces(constraints);
    constraints.close();
  }



  // A face stays flat if its normal displacements all equal one of them.
  template <int dim>
  void Block<dim>::make_flat_faces(AffineConstraints<double> &constraints) const
  {
    for (unsigned int f = 0; f < 2 * dim; ++f)
      if (parameters.faces[f].is_flat)
        {
          ComponentMask mask(dim, false);
          mask.set(f / 2, true);
          IndexSet on_face =
            DoFTools::extract_boundary_dofs(dof_handler, mask, {f});
          types::global_dof_index master = numbers::invalid_dof_index;
          for (const auto dof : on_face &dof_handler.locally_owned_dofs())
            if (!constraints.is_constrained(dof))
              {
                master = dof;
                break;
              }
          master = Utilities::MPI::min(master, communicator);
          for (const auto dof : on_face)
            if (dof != master && !constraints.is_constrained(dof))
              {
                constraints.add_line(dof);
                constraints.add_entry(dof, master, 1.);
              }
        }
  }



  // Forces at supported unknowns are reactions; sums over all unknowns of a
  // component are resultants.
  template <int dim>
  void Block<dim>::find_groups_of_unknowns()
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        ComponentMask mask(dim, false);
        mask.set(d, true);
        DoFTools::extract_dofs(dof_handler, mask)
          .fill_index_vector(dofs_of_component[d]);
      }
    for (unsigned int d = 0; d < dim; ++d)
      for (const auto dof : dofs_of_component[d])
        if (const auto *entries =
              homogeneous_constraints.get_constraint_entries(dof))
          if (entries->empty())
            supported_dofs[d].push_back(dof);
  }



  // @sect3{Loads}

  // Tractions are dead loads on the undeformed faces, as small strains allow:
  // two vectors hold them once and for all, one for what is constant, one for a
  // pressure of 1 MPa that the programme scales.
  template <int dim>
  void Block<dim>::assemble_loads()
  {
    FEFaceValues<dim>      fe_values(fe,
                                contact.quadrature(),
                                update_values | update_JxW_values |
                                  update_normal_vectors);
    dealii::Vector<double> constant(fe.dofs_per_cell), unit(fe.dofs_per_cell);
    std::vector<types::global_dof_index> dofs(fe.dofs_per_cell);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
            {
              const FaceConditions &face =
                parameters.faces[cell->face(f)->boundary_id()];
              fe_values.reinit(cell, f);
              constant = unit = 0.;
              for (const unsigned int q : fe_values.quadrature_point_indices())
                for (const unsigned int i : fe_values.dof_indices())
                  {
                    const unsigned int d =
                      fe.system_to_component_index(i).first;
                    const double phi =
                      fe_values.shape_value(i, q) * fe_values.JxW(q);
                    constant(i) += face.traction[d] * phi;
                    if (face.has_programme_pressure)
                      unit(i) -= fe_values.normal_vector(q)[d] * phi;
                  }
              cell->get_dof_indices(dofs);
              constant_load.add(dofs, constant);
              unit_pressure_load.add(dofs, unit);
            }
    constant_load.compress(VectorOperation::add);
    unit_pressure_load.compress(VectorOperation::add);
  }



  template <int dim>
  void Block<dim>::choose_solver()
  {
    const SolverType type = parameters.solver != SolverType::automatic ?
                              parameters.solver :
                            dof_handler.n_dofs() < 20000 ? SolverType::direct :
                                                           SolverType::amg;
    system                = make_assembled_system<dim>(type,
                                        parameters,
                                        dof_handler,
                                        homogeneous_constraints,
                                        relevant_dofs,
                                        communicator);
  }



  // @sect3{The programme, step by step}

  // Every step ends in one of three ways: Newton's method fails and the step is
  // cut; the friction law finds the step too coarse and it is repeated smaller;
  // or it is accepted, the contact points commit their states, and the
  // displacements move one place back.
  template <int dim>
  void Block<dim>::run(BlockOutput<dim>                              *output,
                       const std::function<void(const HistoryRow &)> &observe)
  {
    old_loading = programme.at(0.);
    while (!control.is_finished())
      {
        loading = programme.at(control.end_of_step());
        predict();
        if (!solve_step())
          {
            solution = old_solution;
            control.cut(reason_of_failure());
            continue;
          }

        const ContactTotals totals    = contact.totals(communicator);
        const double        step_size = control.step_size();
        const double        area      = std::max(totals.area, 1e-300);
        if (!control.accept(totals.error / area, totals.limit_load / area))
          {
            solution = old_solution;
            continue;
          }

        HistoryRow row;
        row.time      = control.time();
        row.step_size = step_size;
        accept_step(row);
        observe(row);
        check_contact(totals);
        old_step = step_size;
        if (output != nullptr)
          output->write_if_due(dof_handler,
                               solution,
                               old_loading.displacement,
                               contact,
                               row.time,
                               control.is_first_of_statement(),
                               control.is_finished());
      }
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
        const double factor = control.step_size() / old_step;
        solution.sadd(1. + factor, -factor, older_solution);
      }
    AffineConstraints<double> constraints;
    prescribe_displacements(loading.displacement, constraints);
    constraints.distribute(solution);
    solution.update_ghost_values();
  }



  // @sect3{Newton's method}

  // Per iteration: forces that are out of balance, tangent of the contact face,
  // one linear system, and as much of the update as lowers the residual. The
  // linear system is solved a little better than the iteration needs, so that
  // the number of iterations is that of Newton's method, and results do not
  // depend on how the work is divided.
  template <int dim>
  bool Block<dim>::solve_step()
  {
    residual_norms.clear();
    failure.clear();
    n_newton = n_linear = 0;
    Vector update(right_hand_side);

    double norm = compute_residual();
    for (;; ++n_newton)
      {
        residual_norms.push_back(norm / force_scale);
        if (!std::isfinite(norm))
          {
            failure = "the forces are not finite";
            return false;
          }
        // At least one iteration, so that every step is an equilibrium of its
        // own and not a guess that happens to be good enough.
        if (n_newton > 0 && norm <= parameters.newton_tolerance * force_scale)
          return true;
        if (n_newton == parameters.newton_iterations)
          {
            std::ostringstream message;
            message << "Newton's method did not converge in " << n_newton
                    << " iterations: the forces are out of balance by "
                    << norm / force_scale
                    << " of the contact force, allowed are "
                    << parameters.newton_tolerance;
            failure = message.str();
            return false;
          }

        system->linearise(contact);
        try
          {
            const unsigned int iterations =
              system->solve(update,
                            right_hand_side,
                            std::max(1e-13 * norm,
                                     0.05 * parameters.newton_tolerance *
                                       force_scale));
            n_linear += iterations;
            n_linear_total += iterations;
          }
        catch (const RunError &error)
          {
            failure = error.what();
            return false;
          }
        ++n_newton_total;
        homogeneous_constraints.distribute(update);

        norm = line_search(update, norm);
      }
  }



  // Halve the update until the residual falls. If it never does, the whole
  // update is the best guess at the other side of a kink.
  template <int dim>
  double Block<dim>::line_search(const Vector &update, const double old_norm)
  {
    const Vector start(solution);
    const auto   residual_after = [&](const double share) {
      solution = start;
      solution.add(share, update);
      solution.update_ghost_values();
      return compute_residual();
    };

    const double converged = parameters.newton_tolerance * force_scale;
    for (double share = 1.; share > 0.05; share /= 2.)
      {
        const double norm = residual_after(share);
        if (norm < (1. - 1e-4 * share) * old_norm || norm <= converged)
          return norm;
      }
    return residual_after(1.);
  }



  // Internal minus external forces. They are summed first for all unknowns,
  // supported or not, since the sums over supports are their reactions. For
  // Newton's method the entries of constrained unknowns are then moved to the
  // unknowns that they depend on.
  template <int dim>
  double Block<dim>::compute_residual()
  {
    contact.update(solution,
                   old_solution,
                   loading.displacement - old_loading.displacement,
                   control.step_size());
    unbalanced = 0.;
    contact.add_forces(unbalanced);
    unbalanced.compress(VectorOperation::add);
    force_scale = unbalanced.l2_norm();

    system->add_elastic_forces(solution, unbalanced);
    unbalanced.compress(VectorOperation::add);
    unbalanced.add(-1., constant_load, -loading.pressure, unit_pressure_load);
    force_scale =
      std::max({force_scale,
                constant_load.l2_norm(),
                std::abs(loading.pressure) * unit_pressure_load.l2_norm(),
                1e-300});

    right_hand_side = 0.;
    right_hand_side.add(-1., unbalanced);
    for (const auto &line : homogeneous_constraints.get_lines())
      if (dof_handler.locally_owned_dofs().is_element(line.index))
        {
          const double value = -unbalanced(line.index);
          right_hand_side(line.index) -= value;
          for (const auto &entry : line.entries)
            right_hand_side(entry.first) += entry.second * value;
        }
    right_hand_side.compress(VectorOperation::add);
    return right_hand_side.l2_norm();
  }



  // @sect3{An accepted step}

  // The states of the contact points are committed, and the work of the drive
  // and of the loads is added up by the trapezoidal rule. What the block stores
  // plus what friction has dissipated should equal it; the difference is the
  // error of backward Euler, which takes the friction force at the end of the
  // step for the whole of it.
  template <int dim>
  void Block<dim>::accept_step(HistoryRow &row)
  {
    const ContactTotals totals = contact.totals(communicator);
    contact.commit();
    add_external_work();

    const double load = totals.normal_load;
    for (unsigned int i = 0; i < 2; ++i)
      (i == 0 ? row.friction : row.friction_y) =
        load > 0. ? totals.tangential_load[i] / load : 0.;
    row.displacement    = loading.displacement[0];
    row.displacement_y  = loading.displacement[1];
    row.pressure        = load / parameters.nominal_contact_area();
    row.normal_load     = load;
    row.tangential_load = totals.tangential_load[0];
    row.loading_ratio   = totals.loading_ratio;
    row.normal_ratio    = totals.normal_ratio;
    row.coefficient     = totals.coefficient;
    row.slip_fraction = totals.area > 0. ? totals.slip_area / totals.area : 0.;
    row.dissipated_energy = totals.dissipated;
    row.stored_energy     = totals.stored + elastic_energy();
    row.external_work     = external_work;
    row.newton_iterations = n_newton;
    row.linear_iterations = n_linear;

    older_solution = old_solution;
    old_solution   = solution;
    old_solution.update_ghost_values();
    old_loading = loading;
  }



  // Sum of the entries that belong to each displacement component: because
  // shape functions sum to one, the resultant of the forces.
  template <int dim>
  Tensor<1, dim> Block<dim>::sum_by_component(const Vector &vector) const
  {
    Tensor<1, dim> sums;
    for (unsigned int d = 0; d < dim; ++d)
      for (const auto dof : dofs_of_component[d])
        sums[d] += vector(dof);
    return Utilities::MPI::sum(sums, communicator);
  }



  // Reactions and loads do work on displacements in space: those in the frame
  // plus the motion of the frame. A face that is held in space moves against
  // the frame, and its reactions do none.
  template <int dim>
  void Block<dim>::add_external_work()
  {
    const Tensor<1, 2> motion = loading.displacement - old_loading.displacement;
    Tensor<1, dim>     frame_motion;
    for (unsigned int i = 0; i < dim - 1; ++i)
      frame_motion[parameters.tangential_axis(i)] = motion[i];
    double work = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      for (const auto dof : supported_dofs[d])
        work += 0.5 * (old_unbalanced(dof) + unbalanced(dof)) *
                (solution(dof) - old_solution(dof) + frame_motion[d]);
    external_work += Utilities::MPI::sum(work, communicator);
    old_unbalanced = unbalanced;

    forces = constant_load;
    forces.add((old_loading.pressure + loading.pressure) / 2.,
               unit_pressure_load);
    external_work += forces * solution - forces * old_solution;
    external_work += sum_by_component(forces) * frame_motion;

    // Global balance: elastic forces have no resultant, so contact forces are
    // the loads plus all reactions; `unbalanced` holds nothing but reactions.
    forces = 0.;
    contact.add_forces(forces);
    forces.compress(VectorOperation::add);
    const double normal_load =
      std::abs(sum_by_component(forces)[parameters.normal_axis()]);
    forces.add(-1., constant_load, -loading.pressure, unit_pressure_load);
    for (const auto &line : homogeneous_constraints.get_lines())
      if (line.entries.empty() &&
          dof_handler.locally_owned_dofs().is_element(line.index))
        forces(line.index) -= unbalanced(line.index);
    if (normal_load > 0.)
      largest_imbalance =
        std::max(largest_imbalance,
                 sum_by_component(forces).norm() / normal_load);
  }



  // u . K u / 2. The motion of the frame stores nothing.
  template <int dim>
  double Block<dim>::elastic_energy()
  {
    forces = 0.;
    system->add_elastic_forces(solution, forces);
    forces.compress(VectorOperation::add);
    return 0.5 * (forces * solution);
  }



  // @sect3{When it goes wrong}

  // A block without contact is free to move, so there is nothing left to
  // compute.
  template <int dim>
  void Block<dim>::check_contact(const ContactTotals &totals)
  {
    largest_normal_load    = std::max(largest_normal_load, totals.normal_load);
    contact_share          = totals.area / parameters.nominal_contact_area();
    smallest_contact_share = std::min(smallest_contact_share, contact_share);
    if (totals.normal_load <= 1e-6 * largest_normal_load)
      {
        std::ostringstream message;
        message << "no contact pressure is left at t = " << control.time()
                << " s: the block has come off the plane";
        throw RunError(message.str());
      }

    const double smallest_side =
      *std::min_element(parameters.size.begin(), parameters.size.begin() + dim);
    const double motion = solution.linfty_norm();
    if (motion > 0.05 * smallest_side)
      {
        std::ostringstream message;
        message << "points of the block have moved by " << motion
                << " mm with respect to the drive, which is too much for small "
                   "strains and rotations";
        failure = message.str();
        throw RunError("At t = " + std::to_string(control.time()) + " s " +
                       reason_of_failure());
      }
  }



  // The state of the contact tells more than the algebra.
  template <int dim>
  std::string Block<dim>::reason_of_failure() const
  {
    std::ostringstream message;
    if (largest_normal_load > 0. && contact_share < 0.6)
      message << "the block tips over: only "
              << std::round(100. * contact_share)
              << " % of its face is still in contact (" << failure << ")";
    else
      message << failure;
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
    if (smallest_contact_share < 0.99)
      summary.warnings = {
        "part of the contact face lifted off the plane: at worst " +
        std::to_string(std::lround(100. * smallest_contact_share)) +
        " % of it stayed in contact (friction turns a block that is high for "
        "its length)"};
  }



  template class Block<2>;
  template class Block<3>;
} // namespace SlipStep
