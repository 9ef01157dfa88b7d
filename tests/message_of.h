// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_message_of_h
#define tests_message_of_h

#include <slipstep/utilities/exceptions.h>

#include <string>

/// With which words an action is refused; "" if it is not.
template <typename Error = SlipStep::InputError, typename Action>
std::string message_of(const Action &action)
{
  try
    {
      action();
    }
  catch (const Error &error)
    {
      return error.what();
    }
  return "";
}

#endif
