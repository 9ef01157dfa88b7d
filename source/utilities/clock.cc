// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/clock.h>

#include <boost/date_time/gregorian/gregorian_types.hpp>

#include <algorithm>
#include <cmath>
#include <regex>
#include <stdexcept>
#include <utility>

namespace SlipStep
{
  namespace
  {
    constexpr double day_length = 86400.; // [s]

    // None if the order is not known, or there is no such day.
    std::optional<long> day_number(const std::cmatch &date,
                                   const std::string &order)
    {
      int first = std::stoi(date[1]), second = std::stoi(date[3]),
          last = std::stoi(date[4]);
      if (date[1].length() == 4)
        std::swap(first, last);
      else if (date[2] != "." && order.empty())
        return {};
      else if (date[2] != "." && order == "m/d")
        std::swap(first, second);
      try
        {
          return boost::gregorian::date(last < 100 ? 2000 + last : last,
                                        second,
                                        first)
            .day_number();
        }
      catch (const std::out_of_range &)
        {
          return {};
        }
    }
  } // namespace



  std::optional<double> Clock::seconds(const std::string_view text)
  {
    static const std::regex form(
      R"((?:(\d\d?|\d{4})([-./])(\d\d?)\2(\d{4}|\d\d?)(?:T|,? +))?)"
      R"((\d{1,4}):(\d\d):(\d\d)(?:[.,:](\d{1,9}))?)"
      R"((?: ?([AaPp])\.?[Mm]\.?)?(?:Z| ?([+-])(\d\d):?(\d\d))?)");
    std::cmatch part;
    if (text.find(':') == std::string_view::npos ||
        !std::regex_match(text.data(), text.data() + text.size(), part, form))
      return {};
    const auto number = [&](const unsigned int i) {
      return part[i].length() > 0 ? std::stod(part[i]) : 0.;
    };
    const bool has_date = part[1].matched, has_halves = part[9].matched;
    double     hours = number(5);
    if (number(6) > 59. || number(7) > 60. ||
        hours > (has_halves ? 12. :
                 has_date   ? 23. :
                              HUGE_VAL))
      return {};
    if (has_halves)
      hours =
        std::fmod(hours, 12.) + (part[9] == "p" || part[9] == "P" ? 12. : 0.);
    const double zone =
      (part[10] == "-" ? -1. : 1.) * (3600. * number(11) + 60. * number(12));
    const double now = 3600. * hours + 60. * number(6) + number(7) +
                       number(8) / std::pow(10., part[8].length()) - zone;
    if (has_date)
      {
        const auto day = day_number(part, date_order);
        if (!day.has_value())
          return {};
        first_day   = first_day.value_or(*day);
        n_midnights = *day - *first_day;
      }
    else if (last.value_or(now) - now > day_length / 2.)
      ++n_midnights;
    last = now;
    return day_length * n_midnights + now;
  }
} // namespace SlipStep
