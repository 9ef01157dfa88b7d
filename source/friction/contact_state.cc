// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/contact_state.h>

namespace SlipStep
{
  StageStart::StageStart(const ContactState &state)
    : state(state)
    , path_start(state.traction)
    , path_base(state.traction)
  {}
} // namespace SlipStep
