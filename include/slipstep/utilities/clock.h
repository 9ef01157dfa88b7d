// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_clock_h
#define slipstep_utilities_clock_h

#include <optional>
#include <string>
#include <string_view>

namespace SlipStep
{
  /// Reads the times that a clock shows, one after the other: "23:59:59.5",
  /// "11:59:59 pm", "2026-11-27T10:00:00,25+01:00", "27.11.2026 10:00:00".
  class Clock
  {
  public:
    /// @param date_order of dates as 3/4/2026 or 3-4-2026: "d/m" or "m/d"; "":
    ///   they are not read
    explicit Clock(const std::string &date_order = "")
      : date_order(date_order)
    {}

    /// @return seconds from the midnight before the first time; none if the
    ///   text is something else. Without a date, a clock that goes back by more
    ///   than half a day has passed midnight
    std::optional<double> seconds(const std::string_view text);

  private:
    std::string           date_order;
    std::optional<long>   first_day;
    std::optional<double> last; ///< [s] from its midnight
    long                  n_midnights = 0;
  };
} // namespace SlipStep

#endif
