// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_contact_projection_h
#define slipstep_solid_contact_projection_h

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/lac/full_matrix.h>

#include <slipstep/friction/law.h>

#include <array>
#include <vector>

namespace SlipStep
{
  /// Carries the states at the Gauss points of a face of a cell to the points
  /// of its children and back.
  ///
  /// With p+1 Gauss points per direction the states are polynomials of degree p
  /// in each coordinate of the face. The children of a face take the values of
  /// this polynomial; a face that is made of its children takes the polynomial
  /// nearest to theirs (L2 projection). Both conserve the integrals of
  /// traction, normal traction, strength, slip path and dissipated energy, and
  /// the second after the first is the identity.
  ///
  /// Where the polynomial is no state that the law allows, it is scaled
  /// linearly about its mean by the largest factor for which it is (as Zhang
  /// and Shu 2010, J. Comput. Phys. 229, 3091-3120, keep densities positive):
  /// integrals stay, and a polynomial that is allowed is not touched. Traction,
  /// normal traction and strength are scaled together, which keeps their
  /// ratios; the other fields each by its own factor. The ratio r is computed
  /// anew, and r_s lowered to it where need be.
  ///
  /// @tparam dim of the block; its face has dim-1
  template <int dim>
  class ContactProjection
  {
  public:
    using States = std::vector<ContactState>;

    static constexpr unsigned int n_children = 1 << (dim - 1);

    /// @param degree p of the elements
    /// @param law says which states are allowed; kept as a reference
    ContactProjection(const unsigned int degree, const FrictionLaw &law);

    /// States of the children from those of their parent. Children are numbered
    /// lexicographically in the coordinates of the face.
    std::array<States, n_children> refine(const States &parent) const;

    /// States of a parent from those of its children.
    States coarsen(const std::array<States, n_children> &children) const;

    /// Number of points of a face.
    unsigned int n_points() const
    {
      return weights.size();
    }

  private:
    /// The fields that are polynomials, by the names in the source file.
    static constexpr unsigned int n_fields = 9 + ContactState::most_memories;
    using Fields                           = std::array<double, n_fields>;

    static Fields fields_of(const ContactState &state);
    States        admissible_states(std::vector<Fields> fields) const;

    bool is_admissible(const Fields &fields,
                       const double  least_normal_traction) const;
    void limit_tractions(std::vector<Fields> &fields) const;
    void limit_cores(std::vector<Fields> &fields) const;
    void limit_field(std::vector<Fields> &fields,
                     const unsigned int   field,
                     const double         lower,
                     const double         upper) const;

    const FrictionLaw          &law;
    const double                maximum_ratio;
    const std::array<double, 2> coefficient_range;
    const std::vector<double>   weights;

    /// Values at the points of a child from those of the parent, and the
    /// contribution of a child to its parent.
    std::array<dealii::FullMatrix<double>, n_children> to_child, to_parent;
  };
} // namespace SlipStep

#endif
