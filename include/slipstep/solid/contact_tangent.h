// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_contact_tangent_h
#define slipstep_solid_contact_tangent_h

#include <deal.II/base/tensor.h>

#include <deal.II/grid/tria.h>

#include <slipstep/solid/block_parameters.h>

#include <vector>

namespace SlipStep
{
  /// Linearised contact on one cell face of the contact face.
  template <int dim>
  struct FaceTangent
  {
    /// A locally owned cell.
    typename dealii::Triangulation<dim>::active_cell_iterator cell;
    /// d traction on the plane / d displacement at the quadrature points
    /// [MPa/mm], in the order of the face quadrature; in general unsymmetric.
    std::vector<dealii::Tensor<2, dim>> values;
  };

  /// Linearised contact on all locally owned cell faces of the contact face.
  template <int dim>
  using ContactTangent = std::vector<FaceTangent<dim>>;

  /// The symmetric positive semidefinite part of a tangent, for smoothers.
  ///
  /// With rows and columns (n, t) the tangent of a point is
  /// @f[
  ///   \mathbf T =
  ///   \begin{pmatrix} k & 0 \\ \mathbf c & \mathbf A \end{pmatrix},
  ///   \qquad k = \alpha_n \ge 0, \quad
  ///   \mathbf c = k\,\partial\mathbf f_t/\partial f_n, \quad
  ///   |\mathbf c| \to \mu k,\ \mathbf m\cdot\mathbf A \to 0
  ///   \text{ in full slip along } \mathbf m .
  /// @f]
  /// Its symmetric part has there, in the plane of n and @f$\mathbf m@f$, the
  /// determinant @f$-\mu^2k^2/4@f$ and the eigenvalues
  /// @f$k\,(1\pm\sqrt{1+\mu^2})/2@f$, one of them negative: a Chebyshev
  /// polynomial amplifies what belongs to it, once the block's own stiffness
  /// cannot make up for it. What is taken instead,
  /// @f[
  ///   \mathbf S = \begin{pmatrix} k & 0 \\ 0 & |\mathbf A| \end{pmatrix},
  ///   \qquad |\mathbf A| = (\mathbf A^T\mathbf A)^{1/2} ,
  /// @f]
  /// is symmetric, and no eigenvalue of it is negative, whatever k,
  /// @f$\mathbf c@f$ and @f$\mathbf A@f$ are; nor is one of a sum of such
  /// matrices with positive weights. Without coupling of n and t, which stays
  /// in the residual, it is as stiff as the tangent: @f$\mathbf A = \mathbf
  /// U|\mathbf A|@f$ with a rotation @f$\mathbf U@f$, so that all singular
  /// values of @f$\mathbf A|\mathbf A|^{-1}@f$ are one. That matters where
  /// strength depends on direction or falls with slip or speed: then the
  /// symmetric part of @f$\mathbf A@f$ may be indefinite, too. Where
  /// @f$\mathbf A@f$ is symmetric and semidefinite, @f$|\mathbf A| =
  /// \mathbf A@f$.
  template <int dim>
  dealii::Tensor<2, dim> definite_part(const dealii::Tensor<2, dim> &tangent,
                                       const unsigned int normal_axis);

  /// That of every point.
  template <int dim>
  ContactTangent<dim> definite_part(ContactTangent<dim> tangent,
                                    const unsigned int  normal_axis)
  {
    for (FaceTangent<dim> &face : tangent)
      for (auto &value : face.values)
        value = definite_part(value, normal_axis);
    return tangent;
  }

  /// Of every point of the face quadrature of a contact cell, the number that
  /// counts along tangential_axis(0) first: deal.II turns some faces.
  /// @param n_1d points per direction
  template <int dim>
  std::vector<unsigned int>
  lexicographic_face_points(const unsigned int     n_1d,
                            const BlockParameters &parameters);
} // namespace SlipStep

#endif
