// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_friction_state_numbers_h
#define slipstep_friction_state_numbers_h

#include <slipstep/friction/law.h>

#include <string>
#include <vector>

namespace SlipStep
{
  /// The state of a contact point as a row of numbers, for programs that keep
  /// states in arrays of their own.
  class StateNumbers
  {
  public:
    explicit StateNumbers(const FrictionLaw &law);

    std::size_t size() const;

    /// With its unit; the first two are the tangential traction.
    const char *name(const std::size_t i) const;

    ContactState read(const double *numbers) const;

    void write(const ContactState &state, double *numbers) const;

  private:
    struct Member
    {
      double ContactState::*value;
      const char           *name;
    };

    ContactState               initial;
    std::vector<Member>        members; ///< all but traction and memories
    std::vector<ContactMemory> memories;
  };
} // namespace SlipStep

#endif
