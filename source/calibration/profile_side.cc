// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/calibration/profile_side.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace SlipStep
{
  namespace
  {
    constexpr double unbounded = std::numeric_limits<double>::infinity();
  } // namespace



  // The root of the rise is nearly linear in the distance, unless a parameter
  // has no influence for a while: then the middle serves better.
  RiseEnd follow_rise(const std::function<double(const double)> &rise,
                      const double                               first_distance,
                      const double                               room)
  {
    double lower = 0., lower_root = 0., upper = unbounded, upper_root = 0.;
    double distance = first_distance;
    int    n_lower = 0, n_upper = 0; // in a row
    bool   is_open = !(room > 0.);
    for (unsigned int n = 0; n < 20 && !is_open; ++n)
      {
        const double value = rise(distance);
        const double root  = std::sqrt(std::max(value, 0.));
        if (std::abs(value - 1.) < 0.03 && (value >= 1. || distance < room))
          {
            // To the crossing, straight through the nearer neighbour: where an
            // influence begins, the rise is far steeper than a parabola.
            const bool is_upper_nearer =
              upper_root < unbounded && upper - distance < distance - lower;
            const double x = is_upper_nearer ? upper : lower;
            const double y = is_upper_nearer ? upper_root : lower_root;
            const double part =
              root == y ? 0. : std::clamp((1. - root) / (root - y), -0.5, 0.5);
            return {distance + part * (distance - x), false};
          }
        if (value < 1.)
          {
            is_open    = distance >= room;
            lower      = distance;
            lower_root = root;
            n_upper    = 0;
            ++n_lower;
          }
        else
          {
            upper      = distance;
            upper_root = root;
            n_lower    = 0;
            ++n_upper;
          }
        if (upper == unbounded)
          distance =
            std::min(room,
                     distance * std::clamp(1. / std::max(root, 1e-9), 1.3, 4.));
        else if (upper_root == unbounded || std::max(n_lower, n_upper) > 1)
          distance = (lower + upper) / 2.;
        else
          distance =
            lower + (upper - lower) *
                      std::clamp((1. - lower_root) / (upper_root - lower_root),
                                 0.05,
                                 0.95);
      }
    // Contradicted is only what was simulated: where the law refuses what lies
    // beyond, or the search ends, the interval is open at the last value.
    const bool is_contradicted = upper < unbounded && upper_root < unbounded;
    return {is_contradicted ? upper : lower, !is_contradicted};
  }



  ProfileSide::ProfileSide(const Refit           &refit,
                           const Fitted          &optimum,
                           const Eigen::VectorXd &slopes,
                           const std::size_t      parameter,
                           const double           threshold,
                           const int              sign,
                           const std::chrono::steady_clock::time_point deadline)
    : refit(refit)
    , optimum(optimum)
    , parameter(parameter)
    , sign(sign)
    , threshold(threshold)
    , deadline(deadline)
    , start(optimum.scaled[parameter])
    , room(sign > 0 ? 1. - start : start)
    , slopes(slopes)
  {
    fitted[0.] = {0., optimum.scaled};
  }



  // What ends with the time is no minimum.
  ProfileSide::Fitted ProfileSide::in_time(const std::vector<double> &from)
  {
    const auto throw_if_late = [&]() {
      if (std::chrono::steady_clock::now() > deadline)
        throw OutOfTime();
    };
    throw_if_late();
    const Fitted result = refit(from);
    throw_if_late();
    return result;
  }



  // The others fitted: from where they go to first order, and, before that
  // contradicts the distance, from where they are at the nearest one.
  ProfileSide::Fitted ProfileSide::fit_at(const double distance)
  {
    std::vector<double> from = optimum.scaled;
    for (std::size_t i = 0; i < from.size(); ++i)
      from[i] = std::clamp(from[i] + sign * distance * slopes(i), 0., 1.);
    from[parameter]     = start + sign * distance;
    const Fitted result = in_time(from);
    if (result.misfit < optimum.misfit + threshold || from.size() == 1)
      return result;
    const auto nearest = std::min_element(
      fitted.begin(), fitted.end(), [&](const auto &a, const auto &b) {
        return std::abs(a.first - distance) < std::abs(b.first - distance);
      });
    std::vector<double> again = nearest->second.scaled;
    again[parameter]          = start + sign * distance;
    const Fitted other        = in_time(again);
    return other.misfit < result.misfit || !std::isfinite(result.misfit) ?
             other :
             result;
  }



  // Of the misfit, relative to the threshold, with all others fitted.
  double ProfileSide::rise(const double distance)
  {
    if (was_no_optimum())
      return unbounded;
    const Fitted result = fit_at(distance);
    const double rise   = (result.misfit - optimum.misfit) / threshold;
    if (!std::isfinite(rise))
      return unbounded;
    fitted[distance] = {rise, result.scaled};
    if (rise < std::min(-0.01, least_rise))
      {
        least_rise = rise;
        better     = result.scaled;
      }
    for (std::size_t i = 0; i < result.scaled.size() && distance > 0.; ++i)
      slopes(i) = sign * (result.scaled[i] - optimum.scaled[i]) / distance;
    return rise;
  }



  // Whether the search closed in on a jump from one optimum of the others to
  // another one.
  bool ProfileSide::jumps_at_end() const
  {
    constexpr double close = 1e-2, much = 0.3;

    const auto beyond = first_beyond();
    if (beyond == fitted.end() || beyond == fitted.begin())
      return false;
    const auto before = std::prev(beyond);
    return beyond->first - before->first < close * beyond->first &&
           beyond->second.misfit - before->second.misfit > much;
  }



  std::map<double, ProfileSide::Fitted>::const_iterator
  ProfileSide::first_beyond() const
  {
    return std::find_if(fitted.begin(), fitted.end(), [](const auto &point) {
      return point.second.misfit >= 1.;
    });
  }



  // A jump is no end: what lies beyond is fitted again from this side of it.
  // Where it jumps again and again nobody knows the end.
  void ProfileSide::follow(const double first_distance)
  {
    constexpr unsigned int most_attempts = 4;

    double first = std::min(room, std::max(first_distance, 1e-9));
    for (unsigned int n = 0; n < most_attempts; ++n)
      {
        const RiseEnd found =
          follow_rise([this](const double distance) { return rise(distance); },
                      first,
                      room);
        is_open = found.is_open;
        end     = start + sign * found.distance;
        if (!jumps_at_end() || was_no_optimum())
          return;
        const auto beyond = first_beyond();
        first             = std::min(room, 1.1 * beyond->first);
        fitted.erase(beyond, fitted.end());
      }
    is_open = true;
  }



  void ProfileSide::look_at(const std::vector<double> &shares)
  {
    for (const double share : shares)
      rise(share * std::abs(end - start));
  }



  void ProfileSide::add_to(ProfileInterval &interval) const
  {
    (sign < 0 ? interval.lower : interval.upper)                 = end;
    (sign < 0 ? interval.is_lower_open : interval.is_upper_open) = is_open;
    for (const auto &[distance, point] : fitted)
      if (distance > 0.)
        interval.profile.emplace_back(start + sign * distance, point.misfit);
    std::sort(interval.profile.begin(), interval.profile.end());
  }
} // namespace SlipStep
