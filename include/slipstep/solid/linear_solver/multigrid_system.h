// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_linear_solver_multigrid_system_h
#define slipstep_solid_linear_solver_multigrid_system_h

// For the units that make_multigrid_system() is compiled in, and for tests:
// they may be built with wider SIMD types than the library, see
// cmake/WideSimd.cmake. Class templates of the library whose members depend on
// the width, but whose names do not, get names of their own. Whatever else is
// instantiated here has the width in its name.
#include <deal.II/base/config.h>

#define SLIPSTEP_JOIN(name, width) name##OfWidth##width
#define SLIPSTEP_OF_WIDTH(name, width) SLIPSTEP_JOIN(name, width)
#define MGTwoLevelTransfer                                                     \
  SLIPSTEP_OF_WIDTH(MGTwoLevelTransfer, DEAL_II_VECTORIZATION_WIDTH_IN_BITS)
#define MGTwoLevelTransferImplementation                                       \
  SLIPSTEP_OF_WIDTH(MGTwoLevelTransferImplementation,                          \
                    DEAL_II_VECTORIZATION_WIDTH_IN_BITS)

// Kernels for degrees chosen at run time, of which only the mapping needs a
// few.
#define FE_EVAL_FACTORY_DEGREE_MAX 2

#include <deal.II/base/mpi.h>

#include <deal.II/lac/vector_memory.h>

#include <deal.II/multigrid/mg_transfer_global_coarsening.h>

#include <deal.II/matrix_free/evaluation_template_face_factory.templates.h>
// In deal.II 9.4 both files have the same include guard.
#undef dealii_matrix_free_evaluation_template_factory_templates_h
#include <deal.II/matrix_free/evaluation_template_factory.templates.h>
#include <deal.II/matrix_free/evaluation_template_factory_hanging_nodes.templates.h>
#include <deal.II/matrix_free/mapping_info.templates.h>
#include <deal.II/matrix_free/matrix_free.templates.h>
#include <deal.II/matrix_free/shape_info.templates.h>

#include <deal.II/multigrid/mg_transfer_global_coarsening.templates.h>

#include <slipstep/solid/linear_solver/assembled_matrix.h>
#include <slipstep/solid/linear_solver/conjugate_residuals.h>
#include <slipstep/solid/linear_solver/elastic_operator.templates.h>
#include <slipstep/solid/linear_solver/multigrid_levels.h>
#include <slipstep/solid/linear_solver/preconditioner.h>
#include <slipstep/solid/linear_solver/smoother.h>
#include <slipstep/solid/linear_solver/tangent_system.h>
#include <slipstep/utilities/exceptions.h>

namespace SlipStep
{
  /// Conjugate residuals with matrix-free products, preconditioned by one
  /// V-cycle of geometric multigrid in single precision.
  ///
  /// Elastic diagonals are computed once per mesh; the contact tangent is
  /// renewed on all levels with every linearisation. Smoothers (Smoother) have
  /// its definite_part() only, but smooth the residual of all of it, before and
  /// after the coarser levels: so the cycle is stable for every coefficient of
  /// friction, and consistent.
  /// @tparam Simd names the width, so that two can live in one program
  template <int dim, int degree, typename Simd = dealii::VectorizedArray<float>>
  class MultigridSystem : public TangentSystem<dim>
  {
  public:
    MultigridSystem(const BlockParameters                   &parameters,
                    const dealii::DoFHandler<dim>           &dof_handler,
                    const dealii::AffineConstraints<double> &constraints);

    virtual void add_elastic_forces(const Vector &displacement,
                                    Vector       &forces) const override;

    virtual void linearise(const ContactTangent<dim> &tangent,
                           const BodyFactors         &body) override;

    virtual unsigned int
    solve(Vector &x, const Vector &b, const double tolerance) override;

    virtual std::size_t memory_consumption() const override;

    /// One V-cycle, as the solver wants it.
    void vmult(Vector &x, const Vector &b) const;

  private:
    using FloatVector = dealii::LinearAlgebra::distributed::Vector<float>;
    using LevelMatrix = ElasticOperator<dim, degree, float>;
    using Transfer    = dealii::MGTwoLevelTransfer<dim, FloatVector>;

    /// All levels but the coarsest.
    struct Level
    {
      std::unique_ptr<LevelMatrix> matrix;
      Smoother<LevelMatrix>        smoother;
      Transfer                     transfer; ///< to the next coarser level
      mutable FloatVector          x, b, residual;
    };

    void setup_level(const unsigned int level);
    void cycle(const unsigned int level) const;
    void solve_coarsest() const;

    MultigridLevels<dim>                 levels;
    ElasticOperator<dim, degree, double> matrix;
    std::vector<Level>                   smoothed; ///< [0] has vectors only
    unsigned int                         n_smoothings = 1;

    const unsigned int              normal_axis;
    const bool                      coarse_is_factorised;
    AssembledMatrix<dim>            coarse_matrix;
    std::unique_ptr<Preconditioner> coarse_solver;
    mutable Vector                  coarse_x, coarse_b;
    mutable Vector                  fine_x, fine_b; ///< of the matrix
    ConjugateResiduals              solver;
  };



  template <int dim, int degree, typename Simd>
  MultigridSystem<dim, degree, Simd>::MultigridSystem(
    const BlockParameters                   &parameters,
    const dealii::DoFHandler<dim>           &dof_handler,
    const dealii::AffineConstraints<double> &constraints)
    : levels(parameters, dof_handler)
    , matrix(parameters, dof_handler, constraints, true)
    , smoothed(levels.n_levels())
    , normal_axis(parameters.normal_axis())
    , coarse_is_factorised(levels[0].dof_handler->n_dofs() < 10000)
    , coarse_matrix(parameters,
                    *levels[0].dof_handler,
                    levels[0].constraints,
                    levels[0].relevant,
                    levels.face_quadrature())
    , coarse_solver(coarse_is_factorised ?
                      make_direct_preconditioner() :
                      make_amg_preconditioner<dim>(*levels[0].dof_handler))
  {
    matrix.release_setup_data();
    const auto &coarsest = levels[0];
    coarse_x.reinit(coarsest.dof_handler->locally_owned_dofs(),
                    coarsest.relevant,
                    dof_handler.get_communicator());
    coarse_b.reinit(coarse_x);
    smoothed[0].x.reinit(coarsest.dof_handler->locally_owned_dofs(),
                         coarsest.relevant,
                         dof_handler.get_communicator());
    smoothed[0].b.reinit(smoothed[0].x);
    for (unsigned int l = 1; l < levels.n_levels(); ++l)
      {
        smoothed[l].matrix =
          std::make_unique<LevelMatrix>(parameters,
                                        *levels[l].dof_handler,
                                        levels[l].float_constraints,
                                        false);
        setup_level(l);
        levels.release_setup_data(l - 1);
      }
    levels.release_setup_data(levels.n_levels() - 1);
    dealii::GrowingVectorMemory<FloatVector>::release_unused_memory();
  }



  template <int dim, int degree, typename Simd>
  void MultigridSystem<dim, degree, Simd>::setup_level(const unsigned int l)
  {
    Level &level = smoothed[l];
    level.matrix->initialize_dof_vector(level.x);
    level.b.reinit(level.x);
    level.residual.reinit(level.x);
    level.smoother.initialize(*level.matrix, levels[l].constraints, level.x);
    level.transfer.reinit(*levels[l].dof_handler,
                          *levels[l - 1].dof_handler,
                          levels[l].float_constraints,
                          levels[l - 1].float_constraints);
  }



  template <int dim, int degree, typename Simd>
  void MultigridSystem<dim, degree, Simd>::linearise(
    const ContactTangent<dim> &tangent,
    const BodyFactors         &body)
  {
    n_smoothings = smoothings_for(
      dealii::Utilities::MPI::max(largest_coefficient(tangent, normal_axis),
                                  levels[0].triangulation->get_communicator()));
    levels.set_tangent(tangent);
    matrix.set_contact(tangent, false);
    matrix.set_body(body);
    for (unsigned int l = 1; l < levels.n_levels(); ++l)
      {
        smoothed[l].matrix->set_contact(levels[l].tangent, true);
        smoothed[l].matrix->set_body(body);
        smoothed[l].smoother.renew(*smoothed[l].matrix);
      }
    coarse_matrix.set_tangent(coarse_is_factorised ?
                                levels[0].tangent :
                                definite_part(levels[0].tangent, normal_axis),
                              body);
    coarse_solver->initialize(coarse_matrix.matrix());
  }



  template <int dim, int degree, typename Simd>
  void MultigridSystem<dim, degree, Simd>::cycle(const unsigned int l) const
  {
    if (l == 0)
      return solve_coarsest();
    const Level &level = smoothed[l];
    level.smoother.vmult(level.x, level.b);
    for (unsigned int i = 1; i < n_smoothings; ++i)
      level.smoother.step(*level.matrix, level.x, level.b, level.residual);
    level.matrix->residual(level.residual, level.x, level.b);
    smoothed[l - 1].b = 0.f;
    level.transfer.restrict_and_add(smoothed[l - 1].b, level.residual);
    cycle(l - 1);
    level.transfer.prolongate_and_add(level.x, smoothed[l - 1].x);
    for (unsigned int i = 0; i < n_smoothings; ++i)
      level.smoother.step(*level.matrix, level.x, level.b, level.residual);
  }



  template <int dim, int degree, typename Simd>
  void MultigridSystem<dim, degree, Simd>::solve_coarsest() const
  {
    coarse_b.copy_locally_owned_data_from(smoothed[0].b);
    levels[0].constraints.set_zero(coarse_b);
    coarse_solver->vmult(coarse_x, coarse_b);
    smoothed[0].x.copy_locally_owned_data_from(coarse_x);
  }



  template <int dim, int degree, typename Simd>
  void MultigridSystem<dim, degree, Simd>::vmult(Vector       &x,
                                                 const Vector &b) const
  {
    smoothed.back().b.copy_locally_owned_data_from(b);
    cycle(smoothed.size() - 1);
    x.copy_locally_owned_data_from(smoothed.back().x);
  }



  template <int dim, int degree, typename Simd>
  unsigned int MultigridSystem<dim, degree, Simd>::solve(Vector       &x,
                                                         const Vector &b,
                                                         const double tolerance)
  {
    matrix.initialize_dof_vector(fine_x);
    matrix.initialize_dof_vector(fine_b);
    try
      {
        return solver.solve(
          matrix, *this, x, b, fine_b, fine_x, tolerance, 100);
      }
    catch (const RunError &error)
      {
        throw RunError(std::string("geometric multigrid did not converge: ") +
                       error.what());
      }
  }



  template <int dim, int degree, typename Simd>
  void MultigridSystem<dim, degree, Simd>::add_elastic_forces(
    const Vector &displacement,
    Vector       &forces) const
  {
    matrix.initialize_dof_vector(fine_x, 1);
    matrix.initialize_dof_vector(fine_b, 1);
    fine_x.copy_locally_owned_data_from(displacement);
    matrix.plain_vmult(fine_b, fine_x);
    for (unsigned int i = 0; i < fine_b.locally_owned_size(); ++i)
      forces.local_element(i) += fine_b.local_element(i);
  }



  template <int dim, int degree, typename Simd>
  std::size_t MultigridSystem<dim, degree, Simd>::memory_consumption() const
  {
    std::size_t sum = matrix.memory_consumption();
    for (unsigned int l = 1; l < smoothed.size(); ++l)
      sum += smoothed[l].matrix->memory_consumption() +
             smoothed[l].transfer.memory_consumption() +
             8 * smoothed[l].x.memory_consumption();
    return sum;
  }



  /// The system of the degree that the elements have, from @p degree upwards.
  template <int dim, int degree>
  std::unique_ptr<TangentSystem<dim>> make_multigrid_system_of_degree(
    const BlockParameters                   &parameters,
    const dealii::DoFHandler<dim>           &dof_handler,
    const dealii::AffineConstraints<double> &constraints)
  {
    if constexpr (degree < BlockParameters::largest_degree)
      if (dof_handler.get_fe().degree > degree)
        return make_multigrid_system_of_degree<dim, degree + 1>(parameters,
                                                                dof_handler,
                                                                constraints);
    return std::make_unique<MultigridSystem<dim, degree>>(parameters,
                                                          dof_handler,
                                                          constraints);
  }



  template <int dim>
  std::unique_ptr<TangentSystem<dim>>
  make_multigrid_system(const BlockParameters                   &parameters,
                        const dealii::DoFHandler<dim>           &dof_handler,
                        const dealii::AffineConstraints<double> &constraints)
  {
    return make_multigrid_system_of_degree<dim, 1>(parameters,
                                                   dof_handler,
                                                   constraints);
  }
} // namespace SlipStep

#endif
