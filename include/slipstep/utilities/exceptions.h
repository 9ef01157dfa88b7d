// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_exceptions_h
#define slipstep_utilities_exceptions_h

#include <stdexcept>
#include <string>

namespace SlipStep
{
  /// The input (case file, option, data file) is wrong: reported in one or two
  /// lines on stderr, exit code 2. The message names the place (`file:line` or
  /// key), the value, what is allowed, and the nearest known name if there is
  /// one.
  class InputError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /// A run that was set up correctly could not be finished: exit code 1. The
  /// message gives the reason in words; results written so far are kept.
  class RunError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };
} // namespace SlipStep

#endif
