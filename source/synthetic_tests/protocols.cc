// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/synthetic_tests/hidden_effects.h>
#include <slipstep/synthetic_tests/protocols.h>

#include <slipstep/utilities/text.h>

#include <boost/math/constants/constants.hpp>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace Planting
  {
    namespace
    {
      /// Speeds [mm/s] and pressures [MPa] of a campaign.
      struct Levels
      {
        double slow, low, middle, high, fast;
        double usual, light, heavy;
      };

      /// Round numbers, as in a laboratory.
      double rounded(const double value)
      {
        return std::stod(rounded_text(value, 2));
      }

      Levels draw_levels_of_loading(Random &random)
      {
        const auto draw = [&](const double least, const double most) {
          return rounded(log_uniform(random, least, most));
        };
        return {draw(0.005, 0.015),
                draw(0.02, 0.05),
                draw(0.1, 0.3),
                draw(0.8, 2.),
                draw(5., 10.),
                draw(4., 7.),
                draw(1.5, 2.5),
                draw(11., 18.)};
      }

      std::string level(const double value, const std::string &unit)
      {
        return rounded_text(value, 3) + ' ' + unit;
      }

      /// Builds the legs of one protocol.
      class Script
      {
      public:
        Script(const std::string &kind,
               const double       pressure,
               const double       angle = 0.)
          : protocol{kind, pressure, angle, {}}
          , pressure(pressure)
        {}

        Script &slide(const double speed, const double length)
        {
          protocol.legs.push_back({speed, length / std::abs(speed), pressure});
          return *this;
        }

        Script &rest(const double duration)
        {
          protocol.legs.push_back({0., duration, pressure});
          return *this;
        }

        /// While it slides, or at rest.
        Script &
        press(const double wanted, const double speed, const double duration)
        {
          pressure = wanted;
          protocol.legs.push_back({speed, duration, pressure});
          return *this;
        }

        operator Protocol() const
        {
          return protocol;
        }

      private:
        Protocol protocol;
        double   pressure;
      };



      Protocol plain_slide(const double speed,
                           const double pressure,
                           const double length,
                           const double angle = 0.)
      {
        return Script("slide " + level(speed, "mm/s") + ", " +
                        level(pressure, "MPa") +
                        (angle == 0. ? "" : ", at " + level(angle, "deg")),
                      pressure,
                      angle)
          .slide(speed, length);
      }



      Protocol speed_steps(const std::vector<double> &speeds,
                           const double               pressure)
      {
        Script script("speed steps, " + level(pressure, "MPa"), pressure);
        for (std::size_t i = 0; i < speeds.size(); ++i)
          script.slide(speeds[i], i == 0 ? 8. : 4.);
        return script;
      }



      Protocol rests(const double               speed,
                     const double               pressure,
                     const std::vector<double> &durations)
      {
        Script script("slide-hold-slide " + level(speed, "mm/s") + ", " +
                        level(pressure, "MPa"),
                      pressure);
        script.slide(speed, 12.);
        for (const double duration : durations)
          script.rest(duration).slide(speed, 5.);
        return script;
      }



      // Up and down while it slides, each change within a time [s].
      Protocol pressure_steps(const double               speed,
                              const double               pressure,
                              const std::vector<double> &pressures,
                              const double               duration = 1.)
      {
        Script script("pressure steps " + level(speed, "mm/s"), pressure);
        script.slide(speed, 8.);
        for (const double wanted : pressures)
          script.press(wanted, speed, duration).slide(speed, 4.);
        return script;
      }



      Protocol pressure_ramp(const double speed,
                             const double pressure,
                             const double end_pressure,
                             const double length)
      {
        return Script("pressure ramp " + level(speed, "mm/s"), pressure)
          .slide(speed, 2.)
          .press(end_pressure, speed, length / speed);
      }



      // Every rung is pressed at rest.
      Protocol pressure_ladder(const double               speed,
                               const std::vector<double> &pressures)
      {
        Script script("pressure ladder " + level(speed, "mm/s"),
                      pressures.front());
        script.slide(speed, 6.);
        for (std::size_t i = 1; i < pressures.size(); ++i)
          script.press(pressures[i], 0., 2.).slide(speed, 3.);
        return script;
      }



      Protocol
      reversals(const double speed, const double pressure, const double length)
      {
        Script script("reversals " + level(speed, "mm/s") + ", " +
                        level(pressure, "MPa"),
                      pressure);
        for (int stroke = 0; stroke < 5; ++stroke)
          script.slide(stroke % 2 == 0 ? speed : -speed, length);
        return script;
      }



      Protocol slides_with_pauses(const double speed,
                                  const double pressure,
                                  const double pause)
      {
        Script script("long slides with pauses " + level(speed, "mm/s") + ", " +
                        level(pressure, "MPa"),
                      pressure);
        for (int slide = 0; slide < 3; ++slide)
          {
            if (slide > 0)
              script.rest(pause);
            script.slide(speed, 60.);
          }
        return script;
      }



      std::vector<Protocol> first(const unsigned int    n,
                                  std::vector<Protocol> protocols)
      {
        protocols.resize(n);
        return protocols;
      }
    } // namespace



    std::vector<Protocol> draw_protocols(const unsigned int n,
                                         const unsigned int edition,
                                         Random            &random)
    {
      const bool   is_first = edition < 2;
      const Levels v        = draw_levels_of_loading(random);
      const double p        = v.usual;
      const double length   = std::round(uniform(random, 15., 25.));
      const double rest     = rounded(log_uniform(random, 10., 30.));
      return first(n,
                   {plain_slide(v.middle, p, length),
                    slides_with_pauses(v.fast, p, rest),
                    speed_steps({v.low, v.middle, v.high, v.middle, v.low}, p),
                    rests(v.middle, p, {rest, 10. * rest, 100. * rest}),
                    pressure_steps(v.middle,
                                   v.light,
                                   {p, v.heavy, p, v.light},
                                   is_first ? 1. : 0.01),
                    plain_slide(v.middle, p, length, 90.),
                    reversals(v.middle, p, 4.),
                    plain_slide(v.slow, p, 0.6 * length),
                    plain_slide(v.high, p, 2. * length),
                    plain_slide(v.middle, v.heavy, length),
                    is_first ?
                      plain_slide(v.middle, v.light, length) :
                      pressure_ramp(v.middle, v.light, v.heavy, length),
                    plain_slide(v.high, p, length, is_first ? 30. : 45.),
                    pressure_ladder(v.high, {1.5, 3., 6., 10., 15., 20.}),
                    plain_slide(v.fast, v.heavy, 3. * length),
                    plain_slide(v.middle, v.heavy, length, 60.),
                    rests(v.high, p, {3. * rest, 30. * rest, 0.3 * rest}),
                    plain_slide(v.low, v.light, length),
                    reversals(v.high, v.heavy, 8.),
                    speed_steps({v.slow, v.high, v.slow, v.fast}, v.heavy),
                    plain_slide(v.low, p, 2. * length)});
    }



    std::vector<Protocol> draw_narrow_protocols(const unsigned int n,
                                                Random            &random)
    {
      const Levels v      = draw_levels_of_loading(random);
      const double p      = v.usual;
      const double q      = rounded(1.6 * p);
      const double slow   = v.middle;
      const double fast   = rounded(5. * slow);
      const double length = std::round(uniform(random, 15., 25.));
      return first(n, {plain_slide(slow, p, length),
                       plain_slide(fast, p, length),
                       plain_slide(slow, q, length),
                       plain_slide(fast, q, length),
                       speed_steps({slow, fast, slow}, p),
                       pressure_steps(slow, p, {q, p, q}),
                       plain_slide(fast, p, 2. * length),
                       plain_slide(slow, q, 2. * length),
                       speed_steps({fast, slow, fast}, q),
                       pressure_steps(fast, q, {p, q, p}),
                       plain_slide(slow, p, 2. * length),
                       plain_slide(fast, q, 2. * length),
                       speed_steps({slow, fast, slow}, q),
                       pressure_steps(fast, p, {q, p, q}),
                       speed_steps({fast, slow, fast}, p),
                       pressure_steps(slow, q, {p, q, p}),
                       plain_slide(slow, p, 0.5 * length),
                       plain_slide(fast, p, 0.5 * length),
                       plain_slide(slow, q, 0.5 * length),
                       plain_slide(fast, q, 0.5 * length)});
    }



    namespace
    {
      unsigned int n_rows_of(const Leg &leg, const std::size_t n_legs)
      {
        const double all  = 170.;
        const double mean = all / n_legs;
        // Changes of the pressure are short.
        if (leg.duration <= 2.)
          return std::max(8., std::min(mean, 12.));
        return leg.speed == 0. ? 15 : std::max(20., 1.1 * mean);
      }

      /// Shares of a leg's time at which its rows are: three in ten in its
      /// first tenth of a millimetre, or twentieth of its time.
      std::vector<double> shares_of(const Leg &leg, const unsigned int n)
      {
        const double length = std::abs(leg.speed) * leg.duration;
        const double dense  = std::min(0.05, length > 0. ? 0.1 / length : 0.05);
        const unsigned int  n_dense = std::lround(0.3 * n);
        std::vector<double> shares;
        for (unsigned int i = 1; i <= n_dense; ++i)
          shares.push_back(dense * i / n_dense);
        for (unsigned int i = 1; i <= n - n_dense; ++i)
          shares.push_back(dense + (1. - dense) * i / (n - n_dense));
        return shares;
      }
    } // namespace



    MeasuredTest motion_of(const Protocol &protocol)
    {
      const double angle =
        protocol.angle * boost::math::constants::degree<double>();
      const bool is_along_x = protocol.angle == 0.;
      const bool is_along_y = protocol.angle == 90.;

      MeasuredTest test;
      double       time = 0., way = 0., pressure = protocol.pressure;
      const auto add_row = [&](const double t, const double s, const double p) {
        test.time.push_back(t);
        test.displacement.push_back(is_along_y ? 0. : s * std::cos(angle));
        if (!is_along_x)
          test.displacement_y.push_back(s * std::sin(angle));
        test.pressure.push_back(p);
      };
      add_row(time, way, pressure);
      for (const Leg &leg : protocol.legs)
        {
          for (const double share :
               shares_of(leg, n_rows_of(leg, protocol.legs.size())))
            add_row(time + share * leg.duration,
                    way + share * leg.duration * leg.speed,
                    pressure + share * (leg.pressure - pressure));
          time += leg.duration;
          way += leg.duration * leg.speed;
          pressure = leg.pressure;
        }
      test.friction.assign(test.time.size(), 0.);
      if (!is_along_x)
        test.friction_y.assign(test.time.size(), 0.);
      return test;
    }
  } // namespace Planting
} // namespace SlipStep
