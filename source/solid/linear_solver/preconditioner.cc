// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/linear_solver/preconditioner.h>

#include <slipstep/utilities/exceptions.h>

#include <deal.II/base/index_set.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/mapping_q1.h>

#include <deal.II/lac/trilinos_precondition.h>

#include <Amesos.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_Import.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_MultiVector.h>
#include <Epetra_Vector.h>

#include <iostream>
#include <map>

namespace SlipStep
{
  using namespace dealii;

  namespace
  {
    // All rows are gathered on the first rank and factorised there: shared
    // among several, the order of MUMPS' sums depends on which message comes
    // first, and no run could be repeated bit for bit.
    class DirectPreconditioner : public Preconditioner
    {
    public:
      virtual void
      initialize(const TrilinosWrappers::SparseMatrix &matrix) override
      {
        const Epetra_CrsMatrix &distributed = matrix.trilinos_matrix();
        const Epetra_Comm      &comm        = distributed.Comm();
        const int               n           = distributed.NumGlobalRows();
        is_first_rank                       = comm.MyPID() == 0;
        const Epetra_Map on_first_rank(n, is_first_rank ? n : 0, 0, comm);
        to_first_rank =
          std::make_unique<Epetra_Import>(on_first_rank, distributed.RowMap());
        Epetra_CrsMatrix gathered(Copy, on_first_rank, 0);
        gathered.Import(distributed, *to_first_rank, Insert);
        gathered.FillComplete();
        check(comm, is_first_rank ? factorise(gathered) : 0);
      }

      virtual void vmult(Vector &x, const Vector &b) const override
      {
        const Epetra_BlockMap &map = to_first_rank->SourceMap();
        Epetra_Vector          distributed_x(View, map, x.begin());
        const Epetra_Vector    distributed_b(View,
                                          map,
                                          const_cast<double *>(b.begin()));
        Epetra_Vector          gathered_x(to_first_rank->TargetMap());
        Epetra_Vector          gathered_b(to_first_rank->TargetMap());
        gathered_b.Import(distributed_b, *to_first_rank, Insert);
        int error = 0;
        if (is_first_rank)
          {
            Epetra_Vector own_x(View, own->RowMap(), gathered_x.Values());
            Epetra_Vector own_b(View, own->RowMap(), gathered_b.Values());
            problem.SetLHS(&own_x);
            problem.SetRHS(&own_b);
            error = solver->Solve();
          }
        check(map.Comm(), error);
        distributed_x.Export(gathered_x, *to_first_rank, Insert);
      }

    private:
      // The same matrix without knowledge of other ranks.
      int factorise(const Epetra_CrsMatrix &gathered)
      {
        solver.reset();
        const int n = gathered.NumMyRows();
        own         = std::make_unique<Epetra_CrsMatrix>(
          Copy,
          Epetra_Map(n, 0, Epetra_MpiComm(MPI_COMM_SELF)),
          gathered.MaxNumEntries());
        std::vector<int>    columns(gathered.MaxNumEntries());
        std::vector<double> values(gathered.MaxNumEntries());
        for (int row = 0; row < n; ++row)
          {
            int n_entries = 0;
            gathered.ExtractGlobalRowCopy(
              row, columns.size(), n_entries, values.data(), columns.data());
            own->InsertGlobalValues(row,
                                    n_entries,
                                    values.data(),
                                    columns.data());
          }
        own->FillComplete();
        problem.SetOperator(own.get());
        solver.reset(Amesos().Create("Amesos_Mumps", problem));
        // Of what an exception will tell, Amesos writes lines of its own.
        std::streambuf *const written = std::cerr.rdbuf(nullptr);
        int                   error   = solver->SymbolicFactorization();
        if (error == 0)
          error = solver->NumericFactorization();
        std::cerr.rdbuf(written);
        return error;
      }

      static void check(const Epetra_Comm &comm, int error)
      {
        comm.Broadcast(&error, 1, 0);
        if (error != 0)
          throw RunError("the factorisation of the tangent failed (error " +
                         std::to_string(error) + " of Amesos and MUMPS)");
      }

      bool                               is_first_rank = true;
      std::unique_ptr<Epetra_Import>     to_first_rank;
      std::unique_ptr<Epetra_CrsMatrix>  own;
      mutable Epetra_LinearProblem       problem;
      std::unique_ptr<Amesos_BaseSolver> solver;
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
