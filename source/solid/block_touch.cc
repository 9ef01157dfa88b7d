// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/block.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  using namespace dealii;

  // @sect3{First touch}

  // A face that is not flat may touch nowhere yet, and a block that nothing
  // holds would fall for ever. It is put down as a rigid body until it bears
  // its load; Newton's method spreads it from there.
  template <int dim>
  bool Block<dim>::bring_to_touch()
  {
    if (!parameters.surface.is_curved() || parameters.is_held_along_normal() ||
        contact_forces.l2_norm() > 0.)
      return false;
    Vector loads(right_hand_side);
    loads = 0.;
    add_loads(1., loads);
    const unsigned int normal = parameters.normal_axis();
    const double       sign   = parameters.outward_sign();
    const double       load   = sign * sum_by_component(loads)[normal];
    if (!(load > 0.))
      return false;
    const double approach = contact.rigid_approach(load, communicator);
    solution.zero_out_ghost_values();
    for (const auto dof : dofs_of_component[normal])
      solution(dof) += sign * approach;
    solution.update_ghost_values();
    return true;
  }



  // Of a block that is held, no force may act before it touches. What is
  // balanced then are the forces of its elements, whose round-off is that of
  // stiffness times displacement.
  template <int dim>
  double Block<dim>::least_force_scale() const
  {
    if (!parameters.surface.is_curved() || !parameters.is_held_along_normal())
      return 0.;
    constexpr double share = 1e-5; // far above round-off, far below a load
    const double     shortest =
      *std::min_element(parameters.size.begin(), parameters.size.begin() + dim);
    return share * parameters.young_modulus * solution.linfty_norm() *
           std::pow(shortest, dim - 2);
  }



#ifndef SLIPSTEP_UNITY_BUILD
  template bool   Block<2>::bring_to_touch();
  template bool   Block<3>::bring_to_touch();
  template double Block<2>::least_force_scale() const;
  template double Block<3>::least_force_scale() const;
#endif
} // namespace SlipStep
