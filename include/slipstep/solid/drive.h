// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_drive_h
#define slipstep_solid_drive_h

#include <deal.II/base/tensor.h>

namespace SlipStep
{
  /// What the drive of a block has done where the programme pushes it, at the
  /// end of a step.
  struct Drive
  {
    /// Displacement that comes on top of that of the programme [mm].
    dealii::Tensor<1, 2> pushed;
    dealii::Tensor<1, 2> last_motion; ///< in the step [mm]
    double               path = 0.;   ///< so far, of what is pushed [mm]
    /// What it carries per nominal area of contact [MPa], now and when the
    /// segment of the programme began.
    dealii::Tensor<1, 2> load, load_before;
    double               pressure = 0.; ///< of the contact, likewise [MPa]

    /// For boost::serialization.
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &pushed &last_motion &path &load &load_before &pressure;
    }
  };
} // namespace SlipStep

#endif
