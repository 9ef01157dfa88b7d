#ifndef tests_solid_solver_problem_h
#define tests_solid_solver_problem_h

#include "block_test_tools.h"

#include <deal.II/distributed/tria.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>

#include <deal.II/grid/grid_generator.h>

#include <slipstep/solid/supports.h>
#include <slipstep/solid/tangent_system.h>

#include <random>

namespace SlipStep::Testing
{
  /// What the points of a contact face do.
  enum class ContactPattern
  {
    stick,
    mixed ///< open at one end, slipping in the middle, sticking at the other
  };

  /// The linear problem of a Newton step, without a block around it.
  template <int dim>
  class SolverProblem
  {
  public:
    /// @param n_refinements of the whole mesh with the subdivisions given
    /// @param n_local of the cells at the lower edge of the contact face after
    ///   that, once each
    SolverProblem(const Settings    &settings,
                  const unsigned int n_refinements,
                  const unsigned int n_local,
                  const MPI_Comm    &communicator = MPI_COMM_SELF)
      : parameters(read(settings))
      , triangulation(communicator)
      , fe(dealii::FE_Q<dim>(parameters.degree), dim)
      , dof_handler(triangulation)
      , quadrature(parameters.degree + 1)
    {
      dealii::Point<dim>        upper;
      std::vector<unsigned int> subdivisions(dim);
      for (unsigned int d = 0; d < dim; ++d)
        {
          upper[d]        = parameters.size[d];
          subdivisions[d] = parameters.subdivisions[d];
        }
      dealii::GridGenerator::subdivided_hyper_rectangle(
        triangulation, subdivisions, dealii::Point<dim>(), upper, true);
      triangulation.refine_global(n_refinements);
      for (unsigned int i = 0; i < n_local; ++i)
        {
          for (const auto &cell : triangulation.active_cell_iterators())
            if (cell->is_locally_owned() && cell->at_boundary(0) &&
                cell->at_boundary(parameters.contact_face))
              cell->set_refine_flag();
          triangulation.execute_coarsening_and_refinement();
        }
      dof_handler.distribute_dofs(fe);
      relevant = relevant_dofs(parameters, dof_handler);
      constrain_displacements(
        parameters, dof_handler, relevant, LoadFactors(), constraints);
    }

    /// Tangent as a block would give it.
    ContactTangent<dim> tangent(const ContactPattern pattern,
                                const double         normal_stiffness,
                                const double         tangential_stiffness) const
    {
      ContactTangent<dim>       result;
      dealii::FEFaceValues<dim> points(fe,
                                       quadrature,
                                       dealii::update_quadrature_points);
      const unsigned int        n = parameters.normal_axis();
      const unsigned int        t = parameters.tangential_axis(0);
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned() &&
            cell->at_boundary(parameters.contact_face))
          {
            points.reinit(cell, parameters.contact_face);
            result.push_back({cell, {}});
            for (const auto &point : points.get_quadrature_points())
              {
                const double place = point[t] / parameters.size[t];
                const bool   is_open =
                  pattern == ContactPattern::mixed && place < 0.2;
                const bool slips =
                  pattern == ContactPattern::mixed && place < 0.6;
                dealii::Tensor<2, dim> value;
                if (!is_open)
                  {
                    for (unsigned int d = 0; d < dim; ++d)
                      value[d][d] = (slips ? 0.7 : 1.) * tangential_stiffness;
                    value[n][n] = normal_stiffness;
                    if (slips)
                      {
                        value[t][t] *= 0.01;
                        value[t][n] =
                          0.11 * normal_stiffness * parameters.outward_sign();
                      }
                  }
                result.back().values.push_back(value);
              }
          }
      return result;
    }

    std::unique_ptr<TangentSystem<dim>> system(const SolverType type) const
    {
      if (type == SolverType::multigrid)
        return make_multigrid_system<dim>(parameters, dof_handler, constraints);
      return make_assembled_system<dim>(
        type, parameters, dof_handler, constraints, relevant, quadrature);
    }

    Vector zero() const
    {
      Vector vector;
      vector.reinit(dof_handler.locally_owned_dofs(),
                    relevant,
                    triangulation.get_communicator());
      return vector;
    }

    /// A right-hand side with all frequencies in it, the same for any number of
    /// unknowns per rank.
    Vector random() const
    {
      Vector vector = zero();
      for (const auto dof : dof_handler.locally_owned_dofs())
        if (!constraints.is_constrained(dof))
          {
            std::mt19937 generator(dof);
            vector(dof) = std::uniform_real_distribution<>(-1., 1.)(generator);
          }
      return vector;
    }

    const BlockParameters                             parameters;
    dealii::parallel::distributed::Triangulation<dim> triangulation;
    const dealii::FESystem<dim>                       fe;
    dealii::DoFHandler<dim>                           dof_handler;
    const dealii::QGauss<dim - 1>                     quadrature;
    dealii::IndexSet                                  relevant;
    dealii::AffineConstraints<double>                 constraints;

  private:
    static BlockParameters read(const Settings &settings)
    {
      const Parameters parameters = make_parameters(settings);
      return {parameters, parse_programme(parameters)};
    }
  };
} // namespace SlipStep::Testing

#endif
