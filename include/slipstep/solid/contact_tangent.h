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

  /// Of every point of the face quadrature of a contact cell, the number that
  /// counts along tangential_axis(0) first: deal.II turns some faces.
  /// @param n_1d points per direction
  template <int dim>
  std::vector<unsigned int>
  lexicographic_face_points(const unsigned int     n_1d,
                            const BlockParameters &parameters);
} // namespace SlipStep

#endif
