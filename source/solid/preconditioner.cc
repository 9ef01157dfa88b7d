#include <slipstep/solid/preconditioner.h>

#include <deal.II/base/index_set.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/mapping_q1.h>

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_solver.h>

#include <Epetra_MultiVector.h>

#include <map>

namespace SlipStep
{
  using namespace dealii;

  namespace
  {
    class DirectPreconditioner : public Preconditioner
    {
    public:
      virtual void
      initialize(const TrilinosWrappers::SparseMatrix &matrix) override
      {
        solver = std::make_unique<TrilinosWrappers::SolverDirect>(
          control,
          TrilinosWrappers::SolverDirect::AdditionalData(false,
                                                         "Amesos_Mumps"));
        solver->initialize(matrix);
      }

      virtual void vmult(Vector &x, const Vector &b) const override
      {
        solver->solve(x, b);
      }

    private:
      mutable SolverControl                           control;
      std::unique_ptr<TrilinosWrappers::SolverDirect> solver;
    };



    template <int dim>
    class AMGPreconditioner : public Preconditioner
    {
    public:
      explicit AMGPreconditioner(const DoFHandler<dim> &dof_handler)
        : dof_handler(dof_handler)
      {
        DoFTools::map_dofs_to_support_points(MappingQ1<dim>(),
                                             dof_handler,
                                             support_points);
        for (unsigned int component = 0; component < dim; ++component)
          {
            ComponentMask mask(dim, false);
            mask.set(component, true);
            for (const auto dof : DoFTools::extract_dofs(dof_handler, mask))
              component_of_dof[dof] = component;
          }
      }

      virtual void
      initialize(const TrilinosWrappers::SparseMatrix &matrix) override
      {
        TrilinosWrappers::PreconditionAMG::AdditionalData data;
        data.elliptic              = true;
        data.higher_order_elements = dof_handler.get_fe().degree > 1;
        data.smoother_sweeps       = 2;
        data.aggregation_threshold = 0.02;

        Teuchos::ParameterList              parameter_list;
        std::unique_ptr<Epetra_MultiVector> constant_modes;
        data.set_parameters(parameter_list, constant_modes, matrix);
        const Epetra_MultiVector modes =
          rigid_body_modes(matrix.trilinos_matrix().OperatorDomainMap());
        parameter_list.set("null space: type", "pre-computed");
        parameter_list.set("null space: dimension", modes.NumVectors());
        parameter_list.set("null space: vectors", modes.Values());
        parameter_list.set("PDE equations", dim);
        amg.initialize(matrix, parameter_list);
      }

      virtual void vmult(Vector &x, const Vector &b) const override
      {
        amg.vmult(x, b);
      }

    private:
      // Translations, then rotations: e_i x (coordinates), in 2-D only about
      // the third axis.
      Epetra_MultiVector rigid_body_modes(const Epetra_Map &map) const
      {
        const unsigned int n_modes = (dim == 3 ? 6 : 3);
        Epetra_MultiVector modes(map, n_modes);
        for (int i = 0; i < map.NumMyElements(); ++i)
          {
            const types::global_dof_index dof =
              TrilinosWrappers::global_index(map, i);
            const unsigned int component = component_of_dof.at(dof);
            const Point<dim>  &x         = support_points.at(dof);
            modes[component][i]          = 1.;
            for (unsigned int r = 0; r < n_modes - dim; ++r)
              {
                const unsigned int a = (dim == 3 ? (r + 1) % 3 : 0);
                const unsigned int b = (dim == 3 ? (r + 2) % 3 : 1);
                modes[dim + r][i]    = (component == a ? -x[b] :
                                        component == b ? x[a] :
                                                         0.);
              }
          }
        return modes;
      }

      const DoFHandler<dim>                          &dof_handler;
      std::map<types::global_dof_index, Point<dim>>   support_points;
      std::map<types::global_dof_index, unsigned int> component_of_dof;
      TrilinosWrappers::PreconditionAMG               amg;
    };
  } // namespace



  std::unique_ptr<Preconditioner> make_direct_preconditioner()
  {
    return std::make_unique<DirectPreconditioner>();
  }



  template <int dim>
  std::unique_ptr<Preconditioner>
  make_amg_preconditioner(const DoFHandler<dim> &dof_handler)
  {
    return std::make_unique<AMGPreconditioner<dim>>(dof_handler);
  }



  template std::unique_ptr<Preconditioner>
  make_amg_preconditioner(const DoFHandler<2> &);
  template std::unique_ptr<Preconditioner>
  make_amg_preconditioner(const DoFHandler<3> &);
} // namespace SlipStep
