#include <slipstep/solid/tangent_system.h>

#include <slipstep/solid/preconditioner.h>
#include <slipstep/utilities/exceptions.h>

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_values.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <map>

namespace SlipStep
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    class AssembledSystem : public TangentSystem<dim>
    {
    public:
      AssembledSystem(const SolverType                 type,
                      const BlockParameters           &parameters,
                      const DoFHandler<dim>           &dof_handler,
                      const AffineConstraints<double> &constraints,
                      const IndexSet                  &relevant_dofs,
                      const MPI_Comm                  &communicator)
        : dof_handler(dof_handler)
        , constraints(constraints)
        , preconditioner(type == SolverType::direct ?
                           make_direct_preconditioner() :
                           make_amg_preconditioner<dim>(dof_handler))
      {
        compute_cell_matrices(parameters);
        make_sparsity(relevant_dofs, communicator);
        assemble_elastic_matrix();
      }

      virtual void add_elastic_forces(const Vector &displacement,
                                      Vector       &forces) const override;

      virtual void linearise(const ContactFace<dim> &contact) override;

      virtual unsigned int
      solve(Vector &x, const Vector &b, const double tolerance) override;

    private:
      void compute_cell_matrices(const BlockParameters &parameters);
      void make_sparsity(const IndexSet &relevant_dofs,
                         const MPI_Comm &communicator);
      void assemble_elastic_matrix();

      const DoFHandler<dim>           &dof_handler;
      const AffineConstraints<double> &constraints;

      // Cells of a box are copies of each other up to a factor of 2 per level.
      std::map<int, FullMatrix<double>> cell_matrix_of_level;

      TrilinosWrappers::SparseMatrix elastic_matrix;
      TrilinosWrappers::SparseMatrix matrix;

      std::unique_ptr<Preconditioner> preconditioner;
      bool                            preconditioner_is_usable = false;
      unsigned int                    n_iterations_when_fresh  = 0;
    };



    // K_ij = int lambda div(phi_i) div(phi_j) + 2 mu eps(phi_i) : eps(phi_j),
    // in 2-D plane strain.
    template <int dim>
    void AssembledSystem<dim>::compute_cell_matrices(
      const BlockParameters &parameters)
    {
      const double E = parameters.young_modulus, nu = parameters.poisson_ratio;
      const double lambda = E * nu / ((1. + nu) * (1. - 2. * nu));
      const double mu     = E / (2. * (1. + nu));

      const FiniteElement<dim>        &fe = dof_handler.get_fe();
      const QGauss<dim>                quadrature(fe.degree + 1);
      const FEValuesExtractors::Vector displacements(0);
      FEValues<dim>                    fe_values(fe,
                              quadrature,
                              update_gradients | update_JxW_values);
      const unsigned int               n = fe.dofs_per_cell;
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->is_locally_owned() &&
            cell_matrix_of_level.count(cell->level()) == 0)
          {
            fe_values.reinit(cell);
            FullMatrix<double> cell_matrix(n, n);
            for (const unsigned int q : fe_values.quadrature_point_indices())
              for (unsigned int i = 0; i < n; ++i)
                for (unsigned int j = 0; j < n; ++j)
                  cell_matrix(i, j) +=
                    (lambda * fe_values[displacements].divergence(i, q) *
                       fe_values[displacements].divergence(j, q) +
                     2. * mu *
                       (fe_values[displacements].symmetric_gradient(i, q) *
                        fe_values[displacements].symmetric_gradient(j, q))) *
                    fe_values.JxW(q);
            cell_matrix_of_level[cell->level()] = cell_matrix;
          }
    }



    template <int dim>
    void AssembledSystem<dim>::make_sparsity(const IndexSet &relevant_dofs,
                                             const MPI_Comm &communicator)
    {
      DynamicSparsityPattern sparsity(relevant_dofs);
      DoFTools::make_sparsity_pattern(dof_handler,
                                      sparsity,
                                      constraints,
                                      false);
      SparsityTools::distribute_sparsity_pattern(
        sparsity,
        dof_handler.locally_owned_dofs(),
        communicator,
        relevant_dofs);
      elastic_matrix.reinit(dof_handler.locally_owned_dofs(),
                            dof_handler.locally_owned_dofs(),
                            sparsity,
                            communicator);
    }



    template <int dim>
    void AssembledSystem<dim>::assemble_elastic_matrix()
    {
      std::vector<types::global_dof_index> dofs(
        dof_handler.get_fe().dofs_per_cell);
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            cell->get_dof_indices(dofs);
            constraints.distribute_local_to_global(
              cell_matrix_of_level.at(cell->level()), dofs, elastic_matrix);
          }
      elastic_matrix.compress(VectorOperation::add);
      matrix.reinit(elastic_matrix);
    }



    template <int dim>
    void AssembledSystem<dim>::add_elastic_forces(const Vector &displacement,
                                                  Vector       &forces) const
    {
      const unsigned int     n = dof_handler.get_fe().dofs_per_cell;
      dealii::Vector<double> local(n), local_forces(n);
      std::vector<types::global_dof_index> dofs(n);
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            cell->get_dof_values(displacement, local);
            cell_matrix_of_level.at(cell->level()).vmult(local_forces, local);
            cell->get_dof_indices(dofs);
            forces.add(dofs, local_forces);
          }
    }



    template <int dim>
    void AssembledSystem<dim>::linearise(const ContactFace<dim> &contact)
    {
      matrix.copy_from(elastic_matrix);

      const FiniteElement<dim> &fe        = dof_handler.get_fe();
      FEFaceValues<dim>         fe_values = contact.make_fe_values(fe);
      const unsigned int        n         = fe.dofs_per_cell;
      FullMatrix<double>        local(n, n);
      std::vector<types::global_dof_index> dofs(n);
      for (const auto &cell_face : contact.cell_faces())
        {
          fe_values.reinit(cell_face.cell, cell_face.face);
          local = 0.;
          for (unsigned int q = 0; q < cell_face.points.size(); ++q)
            for (unsigned int i = 0; i < n; ++i)
              if (const double phi_i = fe_values.shape_value(i, q))
                for (unsigned int j = 0; j < n; ++j)
                  local(i, j) +=
                    phi_i *
                    cell_face.points[q]
                      .tangent[fe.system_to_component_index(i).first]
                              [fe.system_to_component_index(j).first] *
                    fe_values.shape_value(j, q) * fe_values.JxW(q);
          cell_face.cell->get_dof_indices(dofs);
          constraints.distribute_local_to_global(local, dofs, matrix);
        }
      matrix.compress(VectorOperation::add);
    }



    // The preconditioner of an earlier tangent serves as long as it is nearly
    // as good as it was for its own: making a new one costs many iterations.
    template <int dim>
    unsigned int AssembledSystem<dim>::solve(Vector       &x,
                                             const Vector &b,
                                             const double  tolerance)
    {
      Vector     residual(b);
      const auto iterate = [&]() {
        SolverControl control(preconditioner_is_usable ?
                                n_iterations_when_fresh + 10 :
                                200,
                              tolerance);
        SolverGMRES<Vector> solver(
          control, typename SolverGMRES<Vector>::AdditionalData(50, true));
        x = 0.;
        solver.solve(matrix, x, b, *preconditioner);

        // The factors of a singular tangent can deceive GMRES: ask the matrix.
        matrix.vmult(residual, x);
        residual.sadd(-1., 1., b);
        const double norm = residual.l2_norm();
        if (!(norm <= 10. * tolerance))
          throw SolverControl::NoConvergence(control.last_step(), norm);
        return control.last_step();
      };

      if (preconditioner_is_usable)
        try
          {
            return iterate();
          }
        catch (const SolverControl::NoConvergence &)
          {
            preconditioner_is_usable = false;
          }

      try
        {
          preconditioner->initialize(matrix);
          n_iterations_when_fresh  = iterate();
          preconditioner_is_usable = true;
          return n_iterations_when_fresh;
        }
      catch (const SolverControl::NoConvergence &failure)
        {
          throw RunError("the linear solver did not converge in " +
                         std::to_string(failure.last_step) + " iterations");
        }
    }
  } // namespace



  template <int dim>
  std::unique_ptr<TangentSystem<dim>>
  make_assembled_system(const SolverType                 type,
                        const BlockParameters           &parameters,
                        const DoFHandler<dim>           &dof_handler,
                        const AffineConstraints<double> &constraints,
                        const IndexSet                  &relevant_dofs,
                        const MPI_Comm                  &communicator)
  {
    return std::make_unique<AssembledSystem<dim>>(
      type, parameters, dof_handler, constraints, relevant_dofs, communicator);
  }



  template std::unique_ptr<TangentSystem<2>>
  make_assembled_system(const SolverType,
                        const BlockParameters &,
                        const DoFHandler<2> &,
                        const AffineConstraints<double> &,
                        const IndexSet &,
                        const MPI_Comm &);
  template std::unique_ptr<TangentSystem<3>>
  make_assembled_system(const SolverType,
                        const BlockParameters &,
                        const DoFHandler<3> &,
                        const AffineConstraints<double> &,
                        const IndexSet &,
                        const MPI_Comm &);
} // namespace SlipStep
