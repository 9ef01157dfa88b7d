// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/supports.h>

#include <deal.II/base/function.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/numerics/vector_tools.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace SlipStep
{
  using namespace dealii;

  namespace
  {
    // For a driven face nothing is left of the motion of the frame. Where faces
    // meet, the driven face has the last word.
    template <int dim>
    void prescribe(const BlockParameters     &parameters,
                   const DoFHandler<dim>     &dof_handler,
                   const LoadFactors         &factors,
                   AffineConstraints<double> &constraints)
    {
      for (const bool driven_pass : {true, false})
        for (unsigned int f = 0; f < 2 * dim; ++f)
          {
            const FaceConditions &face  = parameters.faces[f];
            const Tensor<1, 3>    given = face.displacement(factors);
            ComponentMask         mask(dim, false);
            std::vector<double>   values(dim, 0.);
            for (unsigned int d = 0; d < dim; ++d)
              if (!driven_pass && face.is_prescribed[d])
                {
                  mask.set(d, true);
                  values[d] = given[d];
                }
            for (unsigned int i = 0; i < dim - 1; ++i)
              {
                const unsigned int axis = parameters.tangential_axis(i);
                if (driven_pass && face.is_driven)
                  mask.set(axis, true);
                values[axis] -= (driven_pass ? 0. : factors[frame_x + i]);
              }
            if (mask.n_selected_components() > 0)
              VectorTools::interpolate_boundary_values(
                dof_handler,
                f,
                Functions::ConstantFunction<dim>(values),
                constraints,
                mask);
          }
    }



    // A face stays flat if its normal displacements all equal one of them.
    template <int dim>
    void flatten(const BlockParameters     &parameters,
                 const DoFHandler<dim>     &dof_handler,
                 AffineConstraints<double> &constraints)
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
            master =
              Utilities::MPI::min(master, dof_handler.get_communicator());
            for (const auto dof : on_face)
              if (dof != master && !constraints.is_constrained(dof))
                {
                  constraints.add_line(dof);
                  constraints.add_entry(dof, master, 1.);
                }
          }
    }



    // An unknown, its prescribed value, and what it depends on.
    using Line =
      std::tuple<types::global_dof_index,
                 double,
                 std::vector<std::pair<types::global_dof_index, double>>>;

    std::vector<Line>
    lines_of(const std::vector<types::global_dof_index> &indices,
             const AffineConstraints<double>            &constraints)
    {
      std::vector<Line> lines;
      for (const auto index : indices)
        if (constraints.is_constrained(index))
          lines.emplace_back(index,
                             constraints.get_inhomogeneity(index),
                             *constraints.get_constraint_entries(index));
      return lines;
    }



    // A hanging node may depend on a node which itself hangs on a cell that
    // this rank does not see: what constrains an unknown is known to its owner
    // only.
    template <int dim>
    void ask_owners(const DoFHandler<dim>     &dof_handler,
                    AffineConstraints<double> &constraints)
    {
      const MPI_Comm  communicator = dof_handler.get_communicator();
      const IndexSet &owned        = dof_handler.locally_owned_dofs();
      std::set<types::global_dof_index> asked;
      for (;;)
        {
          IndexSet to_ask(owned.size());
          for (const auto &line : constraints.get_lines())
            for (const auto &entry : line.entries)
              if (!owned.is_element(entry.first) &&
                  constraints.get_local_lines().is_element(entry.first) &&
                  !constraints.is_constrained(entry.first) &&
                  asked.insert(entry.first).second)
                to_ask.add_index(entry.first);
          if (Utilities::MPI::max(to_ask.n_elements(), communicator) == 0)
            return;

          const auto owners =
            Utilities::MPI::compute_index_owner(owned, to_ask, communicator);
          std::map<unsigned int, std::vector<types::global_dof_index>>
                       questions;
          unsigned int i = 0;
          for (const auto index : to_ask)
            questions[owners[i++]].push_back(index);
          std::map<unsigned int, std::vector<Line>> answers;
          for (const auto &question :
               Utilities::MPI::some_to_some(communicator, questions))
            answers[question.first] = lines_of(question.second, constraints);
          for (const auto &answer :
               Utilities::MPI::some_to_some(communicator, answers))
            for (const Line &line : answer.second)
              {
                constraints.add_line(std::get<0>(line));
                constraints.add_entries(std::get<0>(line), std::get<2>(line));
                constraints.set_inhomogeneity(std::get<0>(line),
                                              std::get<1>(line));
              }
        }
    }
  } // namespace



  template <int dim>
  void constrain_hanging_nodes(const DoFHandler<dim>     &dof_handler,
                               const IndexSet            &relevant,
                               AffineConstraints<double> &constraints)
  {
    constraints.reinit(relevant);
    DoFTools::make_hanging_node_constraints(dof_handler, constraints);
    ask_owners(dof_handler, constraints);
    constraints.close();
  }



  template <int dim>
  void constrain_displacements(const BlockParameters     &parameters,
                               const DoFHandler<dim>     &dof_handler,
                               const IndexSet            &relevant,
                               const LoadFactors         &factors,
                               AffineConstraints<double> &constraints)
  {
    constraints.reinit(relevant);
    DoFTools::make_hanging_node_constraints(dof_handler, constraints);
    prescribe(parameters, dof_handler, factors, constraints);
    flatten(parameters, dof_handler, constraints);
    ask_owners(dof_handler, constraints);
    constraints.close();
  }



  void make_homogeneous(AffineConstraints<double> &constraints)
  {
    for (const auto &line : constraints.get_lines())
      constraints.set_inhomogeneity(line.index, 0.);
  }



  void move_to_masters(const AffineConstraints<double>            &constraints,
                       LinearAlgebra::distributed::Vector<double> &forces)
  {
    const IndexSet owned = forces.locally_owned_elements();
    for (const auto &line : constraints.get_lines())
      if (owned.is_element(line.index))
        {
          const double value = forces(line.index);
          forces(line.index) = 0.;
          for (const auto &entry : line.entries)
            forces(entry.first) += entry.second * value;
        }
    forces.compress(VectorOperation::add);
  }



  // Every rank that has a part of a flat face needs the one unknown to which
  // all others are tied, and whoever has a hanging node those on which it
  // depends; asking the constraints tells which.
  template <int dim>
  IndexSet relevant_dofs(const BlockParameters &parameters,
                         const DoFHandler<dim> &dof_handler)
  {
    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
    for (;;)
      {
        AffineConstraints<double> all, hanging;
        constrain_displacements(
          parameters, dof_handler, relevant, LoadFactors(), all);
        constrain_hanging_nodes(dof_handler, relevant, hanging);
        std::vector<types::global_dof_index> masters;
        for (const auto *constraints : {&all, &hanging})
          for (const auto &line : constraints->get_lines())
            for (const auto &entry : line.entries)
              if (!relevant.is_element(entry.first))
                masters.push_back(entry.first);
        if (Utilities::MPI::max(masters.size(),
                                dof_handler.get_communicator()) == 0)
          return relevant;
        std::sort(masters.begin(), masters.end());
        relevant.add_indices(masters.begin(),
                             std::unique(masters.begin(), masters.end()));
        relevant.compress();
      }
  }



  template IndexSet relevant_dofs(const BlockParameters &,
                                  const DoFHandler<2> &);
  template IndexSet relevant_dofs(const BlockParameters &,
                                  const DoFHandler<3> &);
  template void     constrain_hanging_nodes(const DoFHandler<2> &,
                                            const IndexSet &,
                                            AffineConstraints<double> &);
  template void     constrain_hanging_nodes(const DoFHandler<3> &,
                                            const IndexSet &,
                                            AffineConstraints<double> &);
  template void     constrain_displacements(const BlockParameters &,
                                            const DoFHandler<2> &,
                                            const IndexSet &,
                                            const LoadFactors &,
                                            AffineConstraints<double> &);
  template void     constrain_displacements(const BlockParameters &,
                                            const DoFHandler<3> &,
                                            const IndexSet &,
                                            const LoadFactors &,
                                            AffineConstraints<double> &);
} // namespace SlipStep
