// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/odd_rows.h>
#include <slipstep/measured_data/stick_slip.h>
#include <slipstep/measured_data/test_rows.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace SlipStep
{
  namespace
  {
    /// Between two extremes of friction.
    struct Leg
    {
      double      change;
      double      way;    ///< of the load point [mm]
      std::size_t n_rows; ///< from the one to the other
    };

    // Rises and falls in turn, larger than what noise makes, where the load
    // point goes one way; friction counts positive against the motion.
    std::vector<Leg> legs_of(const std::vector<double> &way,
                             const std::vector<double> &friction,
                             const double               least)
    {
      std::vector<Leg> legs;
      std::size_t      begin = 0, extreme = 0;
      bool             rises = true;
      for (std::size_t i = 1; i < friction.size(); ++i)
        {
          const double sign = rises ? 1. : -1.;
          if (sign * (friction[i] - friction[extreme]) >= 0.)
            extreme = i;
          else if (sign * (friction[extreme] - friction[i]) > least)
            {
              legs.push_back({friction[extreme] - friction[begin],
                              way[extreme] - way[begin],
                              extreme - begin});
              begin   = extreme;
              extreme = i;
              rises   = !rises;
            }
        }
      return legs;
    }
  } // namespace



  std::optional<StickSlip> find_stick_slip(const MeasuredTest &test,
                                           const double        noise)
  {
    constexpr double       least_share = 0.05, sure = 8.;
    constexpr double       sudden = 0.3, alike = 0.3;
    constexpr unsigned int least_falls = 4;

    const double least =
      std::max(sure * noise, least_share * usual_size(test.friction));
    std::vector<double> slopes, shares;
    const std::size_t   n = test.time.size();
    for (std::size_t begin = 0; begin + 1 < n;)
      {
        const double sign =
          test.displacement[begin + 1] > test.displacement[begin] ? 1. : -1.;
        std::size_t         end = begin;
        std::vector<double> way, friction;
        for (; end < n && (end == begin || sign * (test.displacement[end] -
                                                   test.displacement[end - 1]) >
                                             0.);
             ++end)
          {
            way.push_back(sign * test.displacement[end]);
            friction.push_back(sign * test.friction[end]);
          }
        const std::vector<Leg> legs = legs_of(way, friction, least);
        for (std::size_t i = 0; i + 1 < legs.size(); i += 2)
          {
            if (!(legs[i].change > least) || legs[i].n_rows < 2)
              continue;
            slopes.push_back(legs[i].change / legs[i].way);
            // From row to row, it may have taken no way at all.
            shares.push_back(
              legs[i + 1].n_rows > 1 ? legs[i + 1].way / legs[i].way : 0.);
          }
        begin = std::max(end - 1, begin + 1);
      }
    if (slopes.size() < least_falls || !(median(shares) < sudden))
      return {};
    const double        slope = median(slopes);
    std::vector<double> off;
    for (const double one : slopes)
      off.push_back(std::abs(one / slope - 1.));
    if (!(slope > 0.) || median(off) > alike)
      return {};
    return StickSlip{static_cast<unsigned int>(slopes.size()),
                     slope * median(test.pressure)};
  }
} // namespace SlipStep
