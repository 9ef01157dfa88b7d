// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_stress_h
#define slipstep_solid_stress_h

#include <slipstep/solid/block_parameters.h>

namespace SlipStep
{
  /// Stress [MPa] of a gradient of the displacement. In 2-D, which is plane
  /// strain, the third normal stress is there as well.
  template <int dim>
  dealii::SymmetricTensor<2, 3>
  stress_of(const dealii::Tensor<2, dim> &gradient,
            const BlockParameters        &parameters)
  {
    dealii::SymmetricTensor<2, 3> stress;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        stress[i][j] =
          parameters.shear_modulus() * (gradient[i][j] + gradient[j][i]);
    for (unsigned int i = 0; i < 3; ++i)
      stress[i][i] += parameters.lame_lambda() * trace(gradient);
    return stress;
  }
} // namespace SlipStep

#endif
