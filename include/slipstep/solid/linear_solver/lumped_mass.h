// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_linear_solver_lumped_mass_h
#define slipstep_solid_linear_solver_lumped_mass_h

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe.h>

#include <vector>

namespace SlipStep
{
  /// What a stage of a step makes of the body (Inertia): its part of the
  /// tangent is stiffness times the stiffness matrix plus inertia times the
  /// mass matrix.
  struct BodyFactors
  {
    double stiffness = 1.; ///< no unit
    double inertia   = 0.; ///< [1/s^2]

    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &stiffness &inertia;
    }
  };

  /// Which share of the mass of a cell moves with each of its unknowns, per
  /// component of the displacement: the integral of the shape function over the
  /// unit cell.
  ///
  /// That is the mass matrix in the quadrature of Gauss and Lobatto whose
  /// points the nodes are, diagonal and exact for polynomials of degree 2p - 1,
  /// so that the order of the elements stays what it is; Cohen and others
  /// (2001), SIAM J. Numer. Anal. 38, 2047. All shares are positive.
  template <int dim>
  std::vector<double> shares_of_mass(const dealii::FiniteElement<dim> &fe)
  {
    const dealii::QGauss<dim> quadrature(fe.degree + 1);
    std::vector<double>       shares(fe.dofs_per_cell, 0.);
    for (unsigned int i = 0; i < shares.size(); ++i)
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        shares[i] +=
          fe.shape_value(i, quadrature.point(q)) * quadrature.weight(q);
    return shares;
  }
} // namespace SlipStep

#endif
