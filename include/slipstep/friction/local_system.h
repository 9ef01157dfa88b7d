// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_friction_local_system_h
#define slipstep_friction_local_system_h

#include <slipstep/friction/law.h>

namespace SlipStep
{
  /// The local system of one stage: what is given, the unknown slip, and
  /// everything that follows from the slip, with derivatives.
  struct FrictionLaw::LocalSystem
  {
    LocalSystem(const StageStart &stage,
                const double      time_step,
                const double      normal_traction)
      : stage(stage)
      , start(stage.state)
      , time_step(time_step)
      , normal_traction(normal_traction)
      , coefficient(start.coefficient)
    {}

    const StageStart   &stage;
    const ContactState &start;
    const double        time_step;
    const double        normal_traction;

    dealii::Tensor<1, 2> trial;           // f_t + alpha_t * slip increment
    double               trial_norm = 0.; // T
    dealii::Tensor<1, 2> direction;       // m = trial / T

    // r_s at the point of the elastic path where r was smallest, and how it
    // depends on the traction increment and the trial strength.
    double               start_ratio = 0.;
    dealii::Tensor<1, 2> d_start_ratio_d_trial;
    double               d_start_ratio_d_strength  = 0.;
    double               d_trial_strength_d_normal = 0.;
    dealii::Tensor<1, 2> d_trial_strength_d_direction;

    double       traction = 0.; // |f_t|, the unknown
    double       slip     = 0.;
    double       coefficient;
    double       d_coefficient = 0.;
    double       strength      = 0.;
    Strength     d_strength; // value not used
    double       ratio = 0.;
    NormalRatio  normal_ratio;
    FlowResidual flow;
    double       d_residual = 1.;
  };
} // namespace SlipStep

#endif
