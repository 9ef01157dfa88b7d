// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/state_numbers.h>

namespace SlipStep
{
  namespace
  {
    constexpr std::size_t n_traction = 2;
  }



  StateNumbers::StateNumbers(const FrictionLaw &law)
    : initial(law.initial_state())
    , members{{&ContactState::normal_traction, "normal_traction_MPa"},
              {&ContactState::strength, "strength_MPa"},
              {&ContactState::loading_ratio, "r"},
              {&ContactState::normal_ratio, "r_s"},
              {&ContactState::coefficient, "mu"},
              {&ContactState::slip_path, "slip_path_mm"},
              {&ContactState::slip_rate, "slip_rate_mm_per_s"},
              {&ContactState::dissipation, "dissipation_MPa_mm"}}
  {
    for (const ContactMemory &memory : law.memories())
      members.push_back(memory);
  }



  std::size_t StateNumbers::size() const
  {
    return n_traction + members.size();
  }



  const char *StateNumbers::name(const std::size_t i) const
  {
    return i == 0 ? "traction_1_MPa" :
           i == 1 ? "traction_2_MPa" :
                    members.at(i - n_traction).name;
  }



  ContactState StateNumbers::read(const double *numbers) const
  {
    ContactState state = initial;
    for (std::size_t i = 0; i < n_traction; ++i)
      state.traction[i] = *numbers++;
    for (const ContactMemory &member : members)
      state.*member.value = *numbers++;
    return state;
  }



  void StateNumbers::write(const ContactState &state, double *numbers) const
  {
    for (std::size_t i = 0; i < n_traction; ++i)
      *numbers++ = state.traction[i];
    for (const ContactMemory &member : members)
      *numbers++ = state.*member.value;
  }
} // namespace SlipStep
