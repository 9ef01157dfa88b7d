#ifndef slipstep_solid_conjugate_residuals_h
#define slipstep_solid_conjugate_residuals_h

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
  /// one more of each: a quarter of its time in a Newton step with three. They
  /// are kept in single precision, in which multigrid works.
  class ConjugateResiduals
  {
  public:
    using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

    /// Iterate from zero until the residual norm is below @p tolerance.
    /// @param residual the right-hand side; on return b - A x
    /// @param most iterations
    /// @return number of iterations
    /// @throws RunError if that is not reached
    template <typename Matrix, typename Preconditioner>
    unsigned int solve(const Matrix         &matrix,
                       const Preconditioner &preconditioner,
                       Vector               &x,
                       Vector               &residual,
                       const double          tolerance,
                       const unsigned int    most)
    {
      x                  = 0.;
      unsigned int n     = 0;
      double       norm  = residual.l2_norm();
      const double start = norm;
      while (norm > tolerance && n < most)
        {
          unsigned int k = 0;
          for (; norm > tolerance && n < most && k < largest_basis; ++k, ++n)
            norm = extend_basis(matrix, preconditioner, residual, k);
          add_corrections(x, k);
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
    static constexpr unsigned int largest_basis = 30;

    // A Z = Q R with orthonormal columns of Q, of which the residual is made
    // free.
    template <typename Matrix, typename Preconditioner>
    double extend_basis(const Matrix         &matrix,
                        const Preconditioner &preconditioner,
                        Vector               &residual,
                        const unsigned int    k)
    {
      if (k == corrections.size())
        {
          corrections.emplace_back();
          corrections.back().reinit(residual, true);
          images.emplace_back(residual);
          correction.reinit(residual, true);
        }
      Vector &image = images[k];
      preconditioner.vmult(correction, residual);
      corrections[k].copy_locally_owned_data_from(correction);
      matrix.vmult(image, correction);
      double product = k == 0 ? image * image : image * images[0];
      for (unsigned int i = 0; i < k; ++i)
        {
          factor[i][k] = product;
          product      = image.add_and_dot(-product,
                                      images[i],
                                      i + 1 < k ? images[i + 1] : image);
        }
      factor[k][k] = std::sqrt(product);
      image /= factor[k][k];
      shares[k] = image * residual;
      return std::sqrt(residual.add_and_dot(-shares[k], image, residual));
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
          for (unsigned int j = 0; j < x.locally_owned_size(); ++j)
            x.local_element(j) += shares[i] * corrections[i].local_element(j);
        }
    }

    using Numbers = std::array<double, largest_basis>;

    using FloatVector = dealii::LinearAlgebra::distributed::Vector<float>;

    std::vector<FloatVector>           corrections; // Z
    Vector                             correction;  // the newest
    std::vector<Vector>                images;      // Q
    std::array<Numbers, largest_basis> factor;      // R
    Numbers                            shares;      // Q^T b, then y
  };
} // namespace SlipStep

#endif
