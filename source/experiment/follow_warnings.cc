// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/follow_warnings.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  std::vector<std::string> follow_warnings(const MeasuredTest &test,
                                           const double        pressure,
                                           const bool          is_at_rest)
  {
    // Of what the record moves over, and of its usual friction.
    constexpr double noticed_way = 0.01, noticed_friction = 0.3;

    std::vector<std::string> result;
    const std::string        file = test.file.filename().string();
    const double             way  = distance_between(test, 0, 1);
    if (std::abs(test.pressure[0] / pressure - 1.) > 0.01 &&
        way > noticed_way * std::hypot(range_of(test.displacement),
                                       range_of(test.displacement_y)))
      result.push_back(
        file + ": the pressure of the first row is only reached after " +
        rounded_text(way, 3) +
        " mm of motion; 'press' to this pressure before "
        "'follow'");
    const std::vector<double> friction = sizes_of_friction(test);
    // The second row as well, so that no stray value counts.
    const double first = std::min(friction[0], friction[1]);
    if (is_at_rest && first > noticed_friction * median(friction))
      result.push_back(file + ": the record begins at a friction of " +
                       rounded_text(first, 3) +
                       ", as in the middle of a slide, but the simulated "
                       "contact begins at rest: 'slide' up to this friction "
                       "before 'follow'");
    return result;
  }
} // namespace SlipStep
