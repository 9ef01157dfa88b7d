// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_linear_solver_smoother_h
#define slipstep_solid_linear_solver_smoother_h

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/diagonal_matrix.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/precondition.h>

#include <slipstep/solid/contact_tangent.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace SlipStep
{
  /// Smoother of a level of MultigridSystem: Chebyshev polynomials of degree 5
  /// of the Jacobi-preconditioned operator.
  ///
  /// The bounds of eigenvalues are those of the elastic operator, found once
  /// per mesh; the diagonal grows with the contact tangent as the operator
  /// does.
  /// @tparam Matrix an ElasticOperator in single precision
  template <typename Matrix>
  class Smoother
  {
  public:
    using Vector = dealii::LinearAlgebra::distributed::Vector<float>;

    /// @param matrix without contact; its setup data is released
    /// @param constraints of the level, for the first vector of the bounds'
    /// estimate only
    /// @param like a vector of the level, overwritten
    void initialize(Matrix                                  &matrix,
                    const dealii::AffineConstraints<double> &constraints,
                    Vector                                  &like);

    /// After the tangent of the matrix has changed.
    void renew(const Matrix &matrix);

    /// The first smoothing, which starts from zero.
    void vmult(Vector &x, const Vector &b) const
    {
      chebyshev.vmult(x, b);
    }

    /// A further one.
    /// @param residual overwritten
    void step(const Matrix &matrix,
              Vector       &x,
              const Vector &b,
              Vector       &residual) const
    {
      matrix.residual(residual, x, b);
      chebyshev.vmult(correction, residual);
      x += correction;
    }

  private:
    using Jacobi = dealii::DiagonalMatrix<Vector>;

    std::shared_ptr<Jacobi>                               jacobi;
    dealii::PreconditionChebyshev<Matrix, Vector, Jacobi> chebyshev;
    float          largest_eigenvalue = 1.f; ///< its bound
    mutable Vector correction;
  };



  template <typename Matrix>
  void Smoother<Matrix>::initialize(
    Matrix                                  &matrix,
    const dealii::AffineConstraints<double> &constraints,
    Vector                                  &like)
  {
    correction.reinit(like);
    matrix.compute_diagonals();
    matrix.release_setup_data();
    jacobi = std::make_shared<Jacobi>();
    jacobi->get_vector().reinit(like);
    matrix.get_inverse_diagonal(jacobi->get_vector(), 1.);

    typename decltype(chebyshev)::AdditionalData settings;
    settings.preconditioner      = jacobi;
    settings.degree              = 5;
    settings.smoothing_range     = 20.;
    settings.eig_cg_n_iterations = 15;
    settings.constraints.copy_from(constraints);
    chebyshev.initialize(matrix, settings);
    settings.max_eigenvalue =
      chebyshev.estimate_eigenvalues(like).max_eigenvalue_estimate;
    settings.eig_cg_n_iterations = 0;
    largest_eigenvalue           = settings.max_eigenvalue;
    settings.constraints.clear();
    chebyshev.initialize(matrix, settings);
  }



  template <typename Matrix>
  void Smoother<Matrix>::renew(const Matrix &matrix)
  {
    matrix.get_inverse_diagonal(jacobi->get_vector(), largest_eigenvalue);
  }



  /// The largest coefficient of friction in a tangent of this rank: what a unit
  /// of normal stiffness moves the tangential traction by.
  template <int dim>
  double largest_coefficient(const ContactTangent<dim> &tangent,
                             const unsigned int         normal_axis)
  {
    double largest = 0.;
    for (const FaceTangent<dim> &face : tangent)
      for (const auto &value : face.values)
        if (const double normal = value[normal_axis][normal_axis])
          for (unsigned int d = 0; d < dim; ++d)
            if (d != normal_axis)
              largest =
                std::max(largest, std::abs(value[d][normal_axis] / normal));
    return largest;
  }



  /// A smoothing leaves mu times the coupling of normal and tangential
  /// tractions by the block, up to a half: for more than mu = 1 that is a bad
  /// smoother, and two or three of them are a good one.
  inline unsigned int smoothings_for(const double coefficient)
  {
    return coefficient <= 1.01 ? 1 : coefficient <= 1.51 ? 2 : 3;
  }
} // namespace SlipStep

#endif
