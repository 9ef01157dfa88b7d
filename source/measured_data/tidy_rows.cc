// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/odd_rows.h>
#include <slipstep/measured_data/sensor_zero.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/measured_data/tidy_rows.h>

#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace SlipStep
{
  namespace
  {
    /// Rows out of order by no more than this share of the duration are
    /// sorted: more is no matter of a logger that mixed up a few rows.
    constexpr double largest_disorder = 0.01;

    /// Of friction along a path [mm].
    struct Work
    {
      double done     = 0.; ///< against the motion
      double possible = 0.; ///< the same without signs
      /// Rows over which it is done, and those over which it drives.
      std::size_t n = 0, n_driving = 0;
    };

    Work work_along(const std::vector<double> &displacement,
                    const std::vector<double> &friction)
    {
      Work work;
      if (displacement.empty() || friction.empty())
        return work;
      // Measured positions tremble, and the tremble knows no direction.
      const std::vector<double> smooth =
        without_jitter(displacement, 0.005 * range_of(displacement));
      for (std::size_t i = 1; i < friction.size(); ++i)
        {
          const double done =
            0.5 * (friction[i] + friction[i - 1]) * (smooth[i] - smooth[i - 1]);
          work.done += done;
          work.possible += std::abs(done);
          work.n += done != 0.;
          work.n_driving += done < 0.;
        }
      return work;
    }

    Work operator+(const Work &a, const Work &b)
    {
      return {a.done + b.done,
              a.possible + b.possible,
              a.n + b.n,
              a.n_driving + b.n_driving};
    }

    /// Nearly throughout.
    bool drives(const Work &work)
    {
      return work.done < -0.5 * work.possible;
    }

    // A single row, of an error code or a spike, has no say.
    std::vector<double> bounded(std::vector<double> friction)
    {
      if (friction.empty())
        return friction;
      const double limit = 3. * usual_size(friction);
      for (double &value : friction)
        value = std::clamp(value, -limit, limit);
      return friction;
    }

    // As of sliding, but for its sign.
    bool is_mostly_constant(const std::vector<double> &friction)
    {
      constexpr double alike = 0.3, most = 0.6;

      std::vector<double> sizes;
      for (const double value : friction)
        sizes.push_back(std::abs(value));
      const double usual = median(sizes);
      return count_if(sizes, [&](const double size) {
               return std::abs(size - usual) <= alike * usual;
             }) > most * sizes.size();
    }

    /// The rows of a test, on their way to being in order.
    class RowsOfTest
    {
    public:
      RowsOfTest(MeasuredTest &test, const RowOrigin &origin)
        : test(test)
        , origin(origin)
        , filled(filled_channels(test))
        , kept(test.time.size())
      {
        std::iota(kept.begin(), kept.end(), 0);
      }

      void leave_out_gaps()
      {
        std::vector<bool> has_gap(kept.size(), false);
        for (const Channel *channel : filled)
          {
            const std::vector<double> &values = test.*(channel->values);
            for (std::size_t i = 0; i < values.size(); ++i)
              {
                if (std::isinf(values[i]))
                  origin.reject(i,
                                channel->name,
                                channel->name + " is not finite" +
                                  (channel->name.rfind("friction", 0) == 0 ?
                                     " (if it is a force divided by the normal "
                                     "load: is that load zero there?)" :
                                     ""));
                has_gap[i] = has_gap[i] || std::isnan(values[i]);
              }
          }
        const std::size_t n = std::count(has_gap.begin(), has_gap.end(), true);
        if (n == 0)
          return;
        std::vector<std::size_t> rows;
        for (std::size_t i = 0; i < has_gap.size(); ++i)
          if (!has_gap[i])
            rows.push_back(i);
        const std::size_t first =
          std::find(has_gap.begin(), has_gap.end(), true) - has_gap.begin();
        if (rows.size() < 2)
          for (const Channel *channel : filled)
            if (std::isnan((test.*(channel->values))[first]))
              origin.reject(first,
                            channel->name,
                            channel->name +
                              " has no value; a value is missing in " +
                              std::to_string(n) + " of " +
                              std::to_string(has_gap.size()) +
                              " rows, and a test needs two complete rows");
        tell_change("rows without a value, left out: " + std::to_string(n),
                    first);
        keep(rows);
      }

      void put_in_order()
      {
        const std::vector<double> &time = test.time;
        if (std::is_sorted(time.begin(), time.end()))
          return;
        std::vector<std::size_t> rows(time.size());
        std::iota(rows.begin(), rows.end(), 0);
        if (std::is_sorted(time.rbegin(), time.rend()))
          {
            tell_change("rows that stand newest first, turned round: all",
                        kept[0]);
            std::reverse(rows.begin(), rows.end());
            keep(rows);
            return;
          }

        std::size_t n = 0, first = 0;
        double      latest = time.front();
        for (std::size_t i = 1; i < time.size(); ++i)
          {
            if (time[i] < latest)
              first = n++ == 0 ? i : first;
            if (latest - time[i] > largest_disorder * range_of(time))
              origin.reject(kept[i],
                            "time",
                            "time goes backwards: " + rounded_text(time[i], 9) +
                              " s follows " + rounded_text(latest, 9) +
                              " s (a clock that was set back, or two tests in "
                              "one file?)");
            latest = std::max(latest, time[i]);
          }
        tell_change("rows out of the order of time, sorted: " +
                      std::to_string(n),
                    kept[first]);
        stable_sort(rows, [&](auto a, auto b) { return time[a] < time[b]; });
        keep(rows);
      }

      void average_repeated()
      {
        std::vector<std::size_t> rows;
        double                   largest_spread = 0.;
        std::size_t              n = 0, first = 0;
        for (std::size_t begin = 0, end = 0; begin < kept.size(); begin = end)
          {
            while (end < kept.size() && test.time[end] == test.time[begin])
              ++end;
            rows.push_back(begin);
            if (end == begin + 1)
              continue;
            first = n == 0 ? begin + 1 : first;
            n += end - begin - 1;
            const auto [least, most] =
              std::minmax_element(test.friction.begin() + begin,
                                  test.friction.begin() + end);
            largest_spread = std::max(largest_spread, *most - *least);
            for (const Channel *channel : filled)
              if (channel->name != "time")
                {
                  auto &values  = test.*(channel->values);
                  values[begin] = std::accumulate(values.begin() + begin,
                                                  values.begin() + end,
                                                  0.) /
                                  (end - begin);
                }
          }
        if (n == 0)
          return;
        tell_change("rows with the time of the row before, averaged: " +
                      std::to_string(n) + "; their friction differs by up to " +
                      rounded_text(largest_spread, 3),
                    kept[first]);
        keep(rows);
      }

      void check_pressure() const
      {
        for (std::size_t i = 0; i < kept.size(); ++i)
          {
            const double pressure = test.pressure[i];
            const bool   slides =
              test.friction[i] != 0. ||
              (!test.friction_y.empty() && test.friction_y[i] != 0.);
            if (pressure < 0.)
              origin.reject(kept[i],
                            "pressure",
                            "pressure is " + exact_text(pressure) +
                              " MPa, but compression counts positive (in a "
                              "map for import: -1*{column})");
            if (pressure == 0. && slides)
              origin.reject(kept[i],
                            "pressure",
                            "pressure is zero where friction is not: give the "
                            "friction of open contact as 0");
          }
        if (range_of(test.pressure) == 0. && test.pressure.front() == 0.)
          origin.reject(kept[0], "pressure", "pressure is zero throughout");
      }

      void check_sign_of_friction()
      {
        const Work along_x =
          work_along(test.displacement, bounded(test.friction));
        const Work along_y =
          work_along(test.displacement_y, bounded(test.friction_y));
        const Work  work = along_x + along_y;
        std::size_t row  = 0;
        while (test.friction[row] == 0. && row + 1 < kept.size())
          ++row;
        if (!drives(work))
          {
            check_friction_has_sign();
            // Not in a jump of a counter only, nor as a spring does.
            if (!warn_of_axis_that_drives(along_x, along_y, kept[row]) &&
                work.done < 0.5 * work.possible &&
                10 * work.n_driving > work.n &&
                is_mostly_constant(test.friction))
              warn("friction drives the motion in " +
                     rounded_text(50. * (1. - work.done / work.possible), 2) +
                     " % of its work: is the displacement an accumulated path, "
                     "which only grows, or does the force sensor have a zero "
                     "offset?",
                   kept[row]);
            return;
          }

        origin.reject(kept[row],
                      "friction",
                      "friction drives the motion instead of resisting it, "
                      "nearly throughout: is its sign, or that of the "
                      "displacement, to be reversed? Say so in a map of "
                      "slipstep import (Convention)");
      }

      /// Whether friction drives along one axis and resists along the other.
      bool warn_of_axis_that_drives(const Work       &along_x,
                                    const Work       &along_y,
                                    const std::size_t row)
      {
        // An ellipse lets a little of one axis drive.
        constexpr double clear = 0.1;

        if (drives(along_x) == drives(along_y) ||
            std::min(along_x.possible, along_y.possible) <=
              clear * (along_x + along_y).possible)
          return false;
        const std::string axis = drives(along_x) ? "x" : "y";
        warn("friction along " + axis +
               " drives the motion instead of resisting it, nearly "
               "throughout, and along the other axis it resists: is "
               "the sign of one of the columns of " +
               axis + " to be reversed?",
             row);
        return true;
      }

      void check_friction_has_sign() const
      {
        // Beside a motion along one axis the other only runs out.
        constexpr double runs_out = 0.2;

        const double widest =
          std::max(range_of(test.displacement), range_of(test.displacement_y));
        for (const bool is_y : {false, true})
          {
            const auto &motion = is_y ? test.displacement_y : test.displacement;
            const auto &friction = is_y ? test.friction_y : test.friction;
            if (motion.empty() || friction.empty() ||
                range_of(motion) < runs_out * widest)
              continue;
            const auto found =
              friction_of_one_sign(test.time, motion, friction);
            if (found.has_value())
              origin.reject(
                kept[0],
                is_y ? "friction_y" : "friction",
                "friction has the same sign forth and back, " +
                  rounded_text(found->forth, 3) + " and " +
                  rounded_text(found->back, 3) +
                  " on the average: has it lost its sign (in a map of slipstep "
                  "import: Convention/Friction sign = of the motion), or is a "
                  "zero of the sensor in it (Correction/Zero)?");
          }
      }

      std::size_t size() const
      {
        return kept.size();
      }

      /// @param first the row, of those kept
      void warn(const std::string &text, const std::size_t first)
      {
        test.warnings.push_back(name_in_messages(test) + ": " + text +
                                " (first: line " +
                                std::to_string(origin.line(first)) + ")");
      }

    private:
      // What was done to the rows stands in the comments, too.
      void tell_change(const std::string &text, const std::size_t first)
      {
        warn(text, first);
        std::string &note = test.notes["rows"];
        note += (note.empty() ? "" : "; ") + text;
      }

      /// Keep some rows, in that order.
      void keep(const std::vector<std::size_t> &rows)
      {
        keep_rows(test, rows);
        kept = chosen(kept, rows);
      }


      MeasuredTest                &test;
      const RowOrigin             &origin;
      std::vector<const Channel *> filled;
      /// Where each row stood at first.
      std::vector<std::size_t> kept;
    };
  } // namespace



  void tidy_rows(MeasuredTest &test, const RowOrigin &origin)
  {
    const std::size_t n_recorded = test.time.size();
    RowsOfTest        rows(test, origin);
    rows.leave_out_gaps();
    rows.put_in_order();
    rows.average_repeated();
    if (rows.size() < 2)
      throw InputError(name_in_messages(test) +
                       ": a test needs at least two rows of different time, " +
                       std::to_string(rows.size()) + " found" +
                       (n_recorded > rows.size() ?
                          " (of " + std::to_string(n_recorded) + " recorded)" :
                          ""));
    rows.check_pressure();
    rows.check_sign_of_friction();
    warn_of_odd_rows(test, [&](const std::string &text, const std::size_t row) {
      rows.warn(text, row);
    });
  }



  double share_of_resistance(const std::vector<double> &displacement,
                             const std::vector<double> &friction)
  {
    std::vector<double> known_displacement, known_friction;
    for (std::size_t i = 0; i < friction.size(); ++i)
      if (!std::isnan(displacement[i]) && !std::isnan(friction[i]))
        {
          known_displacement.push_back(displacement[i]);
          known_friction.push_back(friction[i]);
        }
    const Work work = work_along(known_displacement, bounded(known_friction));
    return work.possible > 0. ? work.done / work.possible : 0.;
  }
} // namespace SlipStep
