#include <slipstep/friction/contact_point.h>
#include <slipstep/friction/law.h>

namespace SlipStep
{
  ContactPoint::ContactPoint(const FrictionLaw &law)
    : ContactPoint(law.initial_state())
  {}



  ContactPoint::ContactPoint(const ContactState &state)
    : committed_state(state)
    , trial_state(state)
  {}



  ContactResponse
  ContactPoint::update(const FrictionLaw          &law,
                       const dealii::Tensor<1, 2> &slip_increment,
                       const double                normal_traction,
                       const double                time_step)
  {
    return law.update(
      committed_state, slip_increment, normal_traction, time_step, trial_state);
  }
} // namespace SlipStep
