// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/contact_point.h>

namespace SlipStep
{
  ContactPoint::ContactPoint(const FrictionLaw &law)
    : ContactPoint(law.initial_state())
  {}



  ContactPoint::ContactPoint(const ContactState &state)
    : committed_state(state)
    , start(state)
  {
    last.end = state;
  }



  ContactResponse
  ContactPoint::update(const FrictionLaw          &law,
                       const dealii::Tensor<1, 2> &slip_increment,
                       const double                normal_traction,
                       const double                time_step,
                       const dealii::Tensor<1, 2> &carried)
  {
    const auto from = [&](const StageStart &stage) {
      return law.update(
        stage, slip_increment, normal_traction, time_step, last.end);
    };
    if (carried == dealii::Tensor<1, 2>())
      last.response = from(start);
    else
      {
        StageStart elsewhere = start;
        law.carry(carried, elsewhere.state);
        last.response = from(elsewhere);
      }
    last.slip_increment = slip_increment;
    last.time_step      = time_step;
    return last.response;
  }



  void ContactPoint::begin_second_stage(const FrictionLaw &law)
  {
    first = last;
    start = law.second_stage(committed_state, first);
  }



  StepError ContactPoint::error(const FrictionLaw &law,
                                const double       compliance) const
  {
    return law.step_error(committed_state, first, start, last, compliance);
  }



  void ContactPoint::commit()
  {
    committed_state = last.end;
    start           = StageStart(committed_state);
  }



  void ContactPoint::revert()
  {
    last.end = committed_state;
    start    = StageStart(committed_state);
  }
} // namespace SlipStep
