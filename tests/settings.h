// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_settings_h
#define tests_settings_h

#include <slipstep/utilities/parameters.h>

#include <string>
#include <utility>
#include <vector>

namespace SlipStep::Testing
{
  /// Paths of parameters and their values.
  using Settings = std::vector<std::pair<std::string, std::string>>;

  /// Of two values of the same parameter the second holds.
  inline Settings operator+(Settings first, const Settings &second)
  {
    first.insert(first.end(), second.begin(), second.end());
    return first;
  }

  inline void set_all(const Settings    &settings,
                      Parameters        &parameters,
                      const std::string &section = "")
  {
    for (const auto &setting : settings)
      parameters.set(section + setting.first, setting.second, "test");
  }
} // namespace SlipStep::Testing

#endif
