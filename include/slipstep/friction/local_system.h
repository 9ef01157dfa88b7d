// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_friction_local_system_h
#define slipstep_friction_local_system_h

#include <slipstep/friction/law.h>

#include <algorithm>

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
    double reach = 0.; // what slip may take at most: T, or more with a core

    // r_s at the point of the elastic path where r was smallest, and how it
    // depends on the traction increment and the trial strength.
    double               start_ratio = 0.;
    dealii::Tensor<1, 2> d_start_ratio_d_trial;
    double               d_start_ratio_d_strength  = 0.;
    double               d_trial_strength_d_normal = 0.;
    dealii::Tensor<1, 2> d_trial_strength_d_direction, d_trial_strength_d_way;

    double traction = 0.; // what slip leaves of the reach, the unknown;
                          // without a core |f_t|
    double   slip = 0.;
    double   coefficient;
    double   d_coefficient = 0.;
    double   strength      = 0.;
    Strength d_strength; // value not used; d_way of forward, with a core only
    double   ratio = 0.;
    NormalRatio  normal_ratio;
    FlowResidual flow;
    double       d_flow_d_slip = 0.; // by way of the rate alone
    double       d_residual    = 1.;

    // With an elastic core: f_t = centre + along * normal, where the slip is
    // along the normal and the trial is centre + offset * normal.
    ElasticCore          core; // at the start
    CoreEvolution        evolution;
    dealii::Tensor<1, 2> centre, normal;
    double               offset = 0.;
    double               along  = 0.;
    double               work   = 0.; // that becomes heat

    // Where slip is believed to go; m without a core.
    dealii::Tensor<1, 2> forward;
    double               forward_norm = 0.;

    void set_trial(const dealii::Tensor<1, 2> &traction)
    {
      trial      = traction;
      trial_norm = trial.norm();
      if (trial_norm > 0.)
        direction = trial / trial_norm;
      reach   = trial_norm;
      forward = direction;
    }

    double heat(const bool has_core) const
    {
      // Not negative but by round-off.
      return has_core ? std::max(work, 0.) : traction * slip;
    }
  };



  /// The circle with r = r_s through a traction.
  struct FrictionLaw::Similarity
  {
    double               ratio = 0.;
    dealii::Tensor<1, 2> normal; // zero in the core
  };

  /// First-order changes of what a local system has.
  struct FrictionLaw::CoreChange
  {
    double               normal_ratio = 0., strength = 0., ratio = 0.;
    dealii::Tensor<1, 2> centre, normal;
    double               along = 0., work = 0.;

    dealii::Tensor<1, 2> traction(const LocalSystem &local) const
    {
      return centre + along * local.normal + local.along * normal;
    }

    double residual(const LocalSystem &local, const double d_slip) const
    {
      return local.flow.d_ratio * ratio +
             local.flow.d_normal_ratio * normal_ratio +
             local.d_flow_d_slip * d_slip;
    }
  };
} // namespace SlipStep

#endif
