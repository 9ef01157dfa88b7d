// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_law_library_parsed_law_h
#define tests_law_library_parsed_law_h

#include <slipstep/law_library/slipstep_friction.h>

#include <stdexcept>
#include <string>
#include <vector>

/// A law of a text of its section Friction, and a point of it.
struct ParsedLaw
{
  explicit ParsedLaw(const std::string &text)
    : law(slipstep_law_parse(("subsection Friction\n" + text + "end\n").c_str(),
                             message,
                             sizeof(message)))
  {
    if (law == nullptr)
      throw std::runtime_error(message);
    state.resize(slipstep_state_size(law));
    slipstep_initial_state(law, state.data());
  }

  ~ParsedLaw()
  {
    slipstep_law_free(law);
  }

  ParsedLaw(const ParsedLaw &)            = delete;
  ParsedLaw &operator=(const ParsedLaw &) = delete;

  char                message[300] = "";
  slipstep_law *const law;
  std::vector<double> state;
};

#endif
