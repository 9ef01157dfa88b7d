// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_solid_solver_problem_h
#define tests_solid_solver_problem_h

#include "block_test_tools.h"

#include <deal.II/distributed/tria.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>

#include <deal.II/grid/grid_generator.h>

#include <slipstep/solid/supports.h>
#include <slipstep/solid/linear_solver/tangent_system.h>

#include <random>

namespace SlipStep::Testing
{
  /// What the points of a contact face do.
  enum class ContactPattern
  {
    stick,
    mixed,   ///< open at one end, slipping in the middle, sticking at the other
    slip,    ///< everywhere along the first axis
    turning, ///< each point in a direction of its own, on which strength
             ///< depends
    weakening ///< slipping, the less strong the farther
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
    /// @param coefficient of friction, where points slip
    ContactTangent<dim> tangent(const ContactPattern pattern,
                                const double         normal_stiffness,
                                const double         tangential_stiffness,
                                const double         coefficient = 0.11) const
    {
      ContactTangent<dim>       result;
      dealii::FEFaceValues<dim> points(fe,
                                       quadrature,
                                       dealii::update_quadrature_points);
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned() &&
            cell->at_boundary(parameters.contact_face))
          {
            points.reinit(cell, parameters.contact_face);
            result.push_back({cell, {}});
            for (const auto &point : points.get_quadrature_points())
              result.back().values.push_back(tangent_at(point,
                                                        pattern,
                                                        normal_stiffness,
                                                        tangential_stiffness,
                                                        coefficient));
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
    // Slip keeps a hundredth of the stiffness in its direction m and most of
    // it across; a strength that depends on direction couples m with what is
    // across, one that falls with slip takes the stiffness along m away.
    dealii::Tensor<2, dim> tangent_at(const dealii::Point<dim> &point,
                                      const ContactPattern      pattern,
                                      const double normal_stiffness,
                                      const double tangential_stiffness,
                                      const double coefficient) const
    {
      const unsigned int n     = parameters.normal_axis();
      const unsigned int t     = parameters.tangential_axis(0);
      const double       place = point[t] / parameters.size[t];
      const bool         mixed = pattern == ContactPattern::mixed;

      dealii::Tensor<2, dim> value;
      if (mixed && place < 0.2)
        return value;
      for (unsigned int d = 0; d < dim; ++d)
        value[d][d] = tangential_stiffness;
      if (mixed ? place < 0.6 : pattern != ContactPattern::stick)
        {
          dealii::Tensor<1, dim> m, across;
          m[t] = 1.;
          if (pattern == ContactPattern::turning)
            {
              const double angle = 40. * place + 1.;
              m[t] = dim == 3 ? std::cos(angle) : angle < 20. ? 1. : -1.;
              if (dim == 3)
                {
                  const unsigned int s = parameters.tangential_axis(1);
                  m[s]                 = std::sin(angle);
                  across[t]            = -m[s];
                  across[s]            = m[t];
                }
            }
          const double along = pattern == ContactPattern::weakening ?
                                 -200. * coefficient :
                                 0.007 * tangential_stiffness;
          value = 0.7 * (value - tangential_stiffness * outer_product(m, m)) +
                  along * outer_product(m, m) +
                  coefficient * normal_stiffness * parameters.outward_sign() *
                    outer_product(m, normal_vector()) -
                  0.3 * tangential_stiffness * outer_product(m, across);
        }
      for (unsigned int d = 0; d < dim; ++d)
        value[n][d] = 0.;
      value[n][n] = normal_stiffness;
      return value;
    }

    dealii::Tensor<1, dim> normal_vector() const
    {
      dealii::Tensor<1, dim> normal;
      normal[parameters.normal_axis()] = 1.;
      return normal;
    }

    static BlockParameters read(const Settings &settings)
    {
      const Parameters parameters = make_parameters(settings);
      return {parameters, parse_programme(parameters)};
    }
  };
} // namespace SlipStep::Testing

#endif
