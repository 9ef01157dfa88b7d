// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_linear_solver_conjugate_residuals_h
#define slipstep_solid_linear_solver_conjugate_residuals_h

#include <deal.II/base/mpi.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <slipstep/utilities/exceptions.h>

#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <vector>

namespace SlipStep
{
  /// Generalised conjugate residuals: in every iteration the residual norm is
  /// the smallest that corrections so far can make it.
  ///
  /// The iterates are those of GMRES with a preconditioner from the right. The
  /// preconditioned vectors are kept, though, so that n iterations cost n
  /// applications of preconditioner and matrix, where deal.II's GMRES needs
  /// one more of each: a quarter of its time in a Newton step with three. Both
  /// bases are kept in single precision, and the residual is computed anew
  /// after every reduction by a million.
  class ConjugateResiduals
  {
  public:
    using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

    /// Iterate from zero until the residual norm is below @p tolerance.
    /// @param x only its locally owned entries are written
    /// @param residual, correction scratch, distributed as the matrix wants it
    /// @param most iterations
    /// @return number of iterations
    /// @throws RunError if that is not reached
    template <typename Matrix, typename Preconditioner>
    unsigned int solve(const Matrix         &matrix,
                       const Preconditioner &preconditioner,
                       Vector               &x,
                       const Vector         &b,
                       Vector               &residual,
                       Vector               &correction,
                       const double          tolerance,
                       const unsigned int    most)
    {
      x = 0.;
      residual.copy_locally_owned_data_from(b);
      image.reinit(residual, true);
      unsigned int n     = 0;
      double       norm  = residual.l2_norm();
      const double start = norm;
      while (norm > tolerance && n < most)
        {
          const double goal = std::max(tolerance, most_reduction * norm);
          unsigned int k    = 0;
          for (; norm > goal && n < most && k < largest_basis; ++k, ++n)
            norm =
              extend_basis(matrix, preconditioner, residual, correction, k);
          add_corrections(x, k);
          if (norm > tolerance && n < most)
            {
              correction.copy_locally_owned_data_from(x);
              matrix.vmult(image, correction);
              residual.copy_locally_owned_data_from(b);
              residual -= image;
              norm = residual.l2_norm();
            }
        }
      if (!(norm <= tolerance))
        {
          std::ostringstream message;
          message << std::setprecision(2) << "after " << n
                  << " iterations the residual is " << norm / start
                  << " of what it was first, " << tolerance / start
                  << " were asked for";
          throw RunError(message.str());
        }
      return n;
    }

  private:
    using FloatVector = dealii::LinearAlgebra::distributed::Vector<float>;

    static constexpr unsigned int largest_basis  = 30;
    static constexpr double       most_reduction = 1e-6;

    // A Z = Q R with orthonormal columns of Q, of which the residual is made
    // free.
    template <typename Matrix, typename Preconditioner>
    double extend_basis(const Matrix         &matrix,
                        const Preconditioner &preconditioner,
                        Vector               &residual,
                        Vector               &correction,
                        const unsigned int    k)
    {
      if (k == corrections.size())
        {
          corrections.emplace_back();
          corrections.back().reinit(residual, true);
          images.emplace_back(corrections.back());
        }
      preconditioner.vmult(correction, residual);
      corrections[k].copy_locally_owned_data_from(correction);
      matrix.vmult(image, correction);
      for (unsigned int i = 0; i < k; ++i)
        {
          factor[i][k] = product(image, images[i]);
          add(image, -factor[i][k], images[i]);
        }
      factor[k][k] = image.l2_norm();
      image /= factor[k][k];
      images[k].copy_locally_owned_data_from(image);
      shares[k] = product(residual, images[k]);
      add(residual, -shares[k], images[k]);
      return residual.l2_norm();
    }

    // Several sums at once, as one would wait for itself in every addition.
    static double product(const Vector &a, const FloatVector &b)
    {
      std::array<double, 8> sums{};
      const double         *x = a.begin();
      const float          *y = b.begin();
      const unsigned int    n = a.locally_owned_size();
      unsigned int          i = 0;
      for (; i + sums.size() <= n; i += sums.size())
        for (unsigned int j = 0; j < sums.size(); ++j)
          sums[j] += x[i + j] * y[i + j];
      double sum = 0.;
      for (; i < n; ++i)
        sum += x[i] * y[i];
      for (const double s : sums)
        sum += s;
      return dealii::Utilities::MPI::sum(sum, a.get_mpi_communicator());
    }

    static void add(Vector &a, const double factor, const FloatVector &b)
    {
      for (unsigned int i = 0; i < a.locally_owned_size(); ++i)
        a.local_element(i) += factor * b.local_element(i);
    }

    // Z y with R y = Q^T b.
    void add_corrections(Vector &x, const unsigned int k)
    {
      for (unsigned int i = k; i-- > 0;)
        {
          double value = shares[i];
          for (unsigned int j = i + 1; j < k; ++j)
            value -= factor[i][j] * shares[j];
          shares[i] = value / factor[i][i];
          add(x, shares[i], corrections[i]);
        }
    }

    using Numbers = std::array<double, largest_basis>;

    std::vector<FloatVector>           corrections; // Z
    std::vector<FloatVector>           images;      // Q
    Vector                             image;       // the newest
    std::array<Numbers, largest_basis> factor;      // R
    Numbers                            shares;      // Q^T b, then y
  };
} // namespace SlipStep

#endif
