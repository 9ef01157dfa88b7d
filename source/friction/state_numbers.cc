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
    , memories(law.memories())
  {}



  std::size_t StateNumbers::size() const
  {
    return n_traction + members.size() + memories.size();
  }



  const char *StateNumbers::name(const std::size_t i) const
  {
    const std::size_t first_memory = n_traction + members.size();
    return i == 0           ? "traction_1_MPa" :
           i == 1           ? "traction_2_MPa" :
           i < first_memory ? members[i - n_traction].name :
                              memories.at(i - first_memory).name;
  }



  ContactState StateNumbers::read(const double *numbers) const
  {
    ContactState state = initial;
    for (std::size_t i = 0; i < n_traction; ++i)
      state.traction[i] = *numbers++;
    for (const Member &member : members)
      state.*member.value = *numbers++;
    for (const ContactMemory &memory : memories)
      state[memory] = *numbers++;
    return state;
  }



  void StateNumbers::write(const ContactState &state, double *numbers) const
  {
    for (std::size_t i = 0; i < n_traction; ++i)
      *numbers++ = state.traction[i];
    for (const Member &member : members)
      *numbers++ = state.*member.value;
    for (const ContactMemory &memory : memories)
      *numbers++ = state[memory];
  }
} // namespace SlipStep
