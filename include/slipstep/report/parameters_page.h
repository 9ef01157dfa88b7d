// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_parameters_page_h
#define slipstep_report_parameters_page_h

#include <slipstep/utilities/parameters.h>

#include <string>
#include <vector>

namespace SlipStep
{
  /// A page with a table of keys, defaults, what is allowed and meanings, and a
  /// field to search in them.
  /// @param only the paths to be shown, all if empty
  std::string parameters_page(const Parameters               &parameters,
                              const std::vector<std::string> &only);
} // namespace SlipStep

#endif
