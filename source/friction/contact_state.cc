// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/exceptions.h>

#include <slipstep/friction/contact_state.h>

#include <cstring>

namespace SlipStep
{
  namespace
  {
    // Function-local, as effects register before main() in any order.
    std::vector<ContactMemory> &mutable_memories()
    {
      static std::vector<ContactMemory> memories;
      return memories;
    }
  } // namespace



  ContactMemory register_memory(ContactMemory memory)
  {
    std::vector<ContactMemory> &all = mutable_memories();
    AssertThrow(all.size() < ContactState::most_memories,
                dealii::ExcMessage("ContactState::most_memories is too small "
                                   "for '" +
                                   std::string(memory.name) + "'."));
    memory.slot = all.size();
    const auto place =
      std::find_if(all.begin(), all.end(), [&memory](const auto &other) {
        return std::strcmp(other.name, memory.name) >= 0;
      });
    AssertThrow(place == all.end() ||
                  std::strcmp(place->name, memory.name) != 0,
                dealii::ExcMessage("Two memories are named '" +
                                   std::string(memory.name) + "'."));
    all.insert(place, memory);
    return memory;
  }



  const std::vector<ContactMemory> &contact_memories()
  {
    return mutable_memories();
  }



  const ContactMemory &contact_memory(const std::string &name)
  {
    const std::vector<ContactMemory> &all = contact_memories();
    const auto                        found =
      std::find_if(all.begin(), all.end(), [&name](const auto &memory) {
        return memory.name == name;
      });
    AssertThrow(found != all.end(),
                dealii::ExcMessage("No memory is named '" + name + "'."));
    return *found;
  }



  StageStart::StageStart(const ContactState &state)
    : state(state)
    , path_start(state.traction)
    , path_base(state.traction)
    , normal_traction(state.normal_traction)
  {}
} // namespace SlipStep
