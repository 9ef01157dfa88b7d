// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_rows_header_h
#define tests_rows_header_h

#include <string>

/// First line of a measured test.
inline const std::string header =
  "time_s,displacement_mm,pressure_MPa,friction\n";

#endif
