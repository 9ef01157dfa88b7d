#include <slipstep/solid/supports.h>

#include <deal.II/base/function.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/numerics/vector_tools.h>

#include <algorithm>

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
                   const Tensor<1, 2>        &frame,
                   AffineConstraints<double> &constraints)
    {
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
  } // namespace



  template <int dim>
  void constrain_displacements(const BlockParameters     &parameters,
                               const DoFHandler<dim>     &dof_handler,
                               const IndexSet            &relevant,
                               const Tensor<1, 2>        &frame,
                               AffineConstraints<double> &constraints)
  {
    constraints.reinit(relevant);
    DoFTools::make_hanging_node_constraints(dof_handler, constraints);
    prescribe(parameters, dof_handler, frame, constraints);
    flatten(parameters, dof_handler, constraints);
    constraints.close();
  }



  // Every rank that has a part of a flat face needs the one unknown to which
  // all others are tied; asking the constraints tells which.
  template <int dim>
  IndexSet relevant_dofs(const BlockParameters &parameters,
                         const DoFHandler<dim> &dof_handler)
  {
    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
    AffineConstraints<double> probe;
    constrain_displacements(
      parameters, dof_handler, relevant, Tensor<1, 2>(), probe);
    std::vector<types::global_dof_index> masters;
    for (const auto &line : probe.get_lines())
      for (const auto &entry : line.entries)
        masters.push_back(entry.first);
    std::sort(masters.begin(), masters.end());
    relevant.add_indices(masters.begin(),
                         std::unique(masters.begin(), masters.end()));
    relevant.compress();
    return relevant;
  }



  template IndexSet relevant_dofs(const BlockParameters &,
                                  const DoFHandler<2> &);
  template IndexSet relevant_dofs(const BlockParameters &,
                                  const DoFHandler<3> &);
  template void     constrain_displacements(const BlockParameters &,
                                            const DoFHandler<2> &,
                                            const IndexSet &,
                                            const Tensor<1, 2> &,
                                            AffineConstraints<double> &);
  template void     constrain_displacements(const BlockParameters &,
                                            const DoFHandler<3> &,
                                            const IndexSet &,
                                            const Tensor<1, 2> &,
                                            AffineConstraints<double> &);
} // namespace SlipStep
