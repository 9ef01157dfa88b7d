// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_face_action_h
#define slipstep_solid_face_action_h

#include <deal.II/base/tensor.h>

namespace SlipStep
{
  /// What acts on the block through a face: reactions of its supports and of
  /// the drive, its loads, and the contact. In 2-D per mm of thickness.
  struct FaceAction
  {
    dealii::Tensor<1, 3> force;  ///< [N]
    dealii::Tensor<1, 3> moment; ///< about the centre of the face [N mm]
  };
} // namespace SlipStep

#endif
