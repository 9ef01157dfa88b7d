// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/linear_solver/multigrid_system.h>

namespace SlipStep
{
  template std::unique_ptr<TangentSystem<2>>
  make_multigrid_system(const BlockParameters &,
                        const dealii::DoFHandler<2> &,
                        const dealii::AffineConstraints<double> &);
} // namespace SlipStep
