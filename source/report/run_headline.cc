// SPDX-License-Identifier: LGPL-2.1-or-later

// The headline of a report: what it says is chosen by the kind of test.

#include <slipstep/report/run_results.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace SlipStep
{
  namespace
  {
    std::string comparison(const double lowest, const double highest)
    {
      const std::string low = fixed_text(lowest, 1);
      if (low == fixed_text(highest, 1))
        return std::abs(lowest) < 0.05 ?
                 "equal to " :
                 fixed_text(std::abs(lowest), 1) + " % " +
                   (lowest < 0. ? "below " : "above ");
      return "within " +
             fixed_text(std::max(std::abs(lowest), std::abs(highest)), 1) +
             " % of ";
    }

    std::string from_to(const std::string &low, const std::string &high)
    {
      return low == high ? low : low + " to " + high;
    }

    /// What may vary from slide to slide, or a quantity over it.
    struct Aspect
    {
      std::function<double(const ResultRow &)> value;
      std::string (*in_words)(const double);

      std::string text(const ResultRow &row) const
      {
        return in_words(value(row));
      }
    };

    std::string four_decimals(const double value)
    {
      return fixed_text(value, 4);
    }

    const Aspect speed_aspect    = {of_slide(&SlideSummary::speed),
                                    [](const double speed) {
                                   return "at " + speed_text(speed);
                                 }};
    const Aspect pressure_aspect = {of_slide(&SlideSummary::pressure),
                                    [](const double pressure) {
                                      return "at " + short_text(pressure) +
                                             " MPa";
                                    }};
    const Aspect rest_aspect     = {of_slide(&SlideSummary::rest),
                                    [](const double rest) {
                                  return "after " + short_text(rest, 6) + " s";
                                }};
    const Aspect kinetic_aspect  = {of_slide(&SlideSummary::kinetic),
                                    four_decimals};
    const Aspect peak_aspect = {of_slide(&SlideSummary::peak), four_decimals};

    /// First of the smallest, and last of the largest.
    std::pair<ResultRow, ResultRow> extremes(const ResultRows &rows,
                                             const Aspect     &aspect)
    {
      const auto found =
        std::minmax_element(rows.begin(),
                            rows.end(),
                            [&](const ResultRow &a, const ResultRow &b) {
                              return aspect.value(a) < aspect.value(b);
                            });
      return {*found.first, *found.second};
    }

    bool varies(const ResultRows &rows, const Aspect &aspect)
    {
      const auto ends = extremes(rows, aspect);
      return aspect.value(ends.second) - aspect.value(ends.first) >
             1e-3 * std::abs(aspect.value(ends.second));
    }

    std::string range(const ResultRows &rows, const Aspect &aspect)
    {
      const auto ends = extremes(rows, aspect);
      return from_to(aspect.text(ends.first), aspect.text(ends.second));
    }

    /// "Kinetic friction rises from 0.1 at 1 mm/min to 0.12 at 50 mm/min"
    std::string trend(const std::string &what,
                      const ResultRows  &rows,
                      const Aspect      &quantity,
                      const Aspect      &over)
    {
      const auto        ends  = extremes(rows, over);
      const auto        found = extremes(rows, quantity);
      const std::string first = quantity.text(ends.first);
      const std::string last  = quantity.text(ends.second);
      const std::string low   = quantity.text(found.first);
      const std::string high  = quantity.text(found.second);
      if (low == high)
        return what + " is " + low + " " + over.text(ends.first) + " as " +
               over.text(ends.second);
      const bool is_rise =
        quantity.value(ends.first) < quantity.value(ends.second);
      if (low == (is_rise ? first : last) && high == (is_rise ? last : first))
        return what + (is_rise ? " rises" : " falls") + " from " + first + " " +
               over.text(ends.first) + " to " + last + " " +
               over.text(ends.second);
      return what + " is " + first + " " + over.text(ends.first) + ", " + last +
             " " + over.text(ends.second) + " and " + from_to(low, high) +
             " in all";
    }

    std::string against(const ResultRows &rows, const Reference &reference)
    {
      if (!reference.exists())
        return "";
      const auto ends = extremes(rows, {&ResultRow::difference, nullptr});
      return comparison(ends.first.difference, ends.second.difference) +
             reference.name;
    }

    std::string one_slide(const ResultRow &row, const Reference &reference)
    {
      const bool  has_rested = row.slide.rest > 0.;
      std::string text =
        (has_rested ?
           "After a rest of " + short_text(row.slide.rest, 6) + " s, at " :
           "At ") +
        speed_text(row.slide.speed) + ", friction " +
        (row.has_peak ?
           "peaks at " + fixed_text(row.slide.peak, 4) + " after " +
             short_text(row.slide.peak_displacement, 2) + " mm and is " +
             fixed_text(row.slide.kinetic, 4) + " in the end, " +
             fixed_text(row.drop, 1) + " % lower" :
           "comes to " + fixed_text(row.slide.kinetic, 4) + " without a peak");
      if (reference.exists())
        text += "; that is " + against({row}, reference);
      return text;
    }

    /// "; it is 6.2 to 20.0 % lower than its peak", if that holds for all.
    std::string drop(const ResultRows &rows)
    {
      const auto has_peak = std::mem_fn(&ResultRow::has_peak);
      if (none_of(rows, has_peak))
        return "; there is no drop from a peak";
      if (!all_of(rows, has_peak))
        return "";
      const Aspect by_drop = {&ResultRow::drop, [](const double drop) {
                                return fixed_text(drop, 1);
                              }};
      return "; it is " + range(rows, by_drop) + " % lower than its peak";
    }

    bool changes_direction(const ResultRows &rows)
    {
      return any_of(rows, [&](const ResultRow &row) {
        return std::abs(std::sin(row.slide.angle - rows[0].slide.angle)) > 1e-6;
      });
    }

    /// "Kinetic friction ranges from 0.1 (thin) to 0.16 (thick)"
    std::string named_range(const ResultRows &rows,
                            std::string (*name)(const ResultRow &))
    {
      const auto        ends = extremes(rows, kinetic_aspect);
      const std::string low  = kinetic_aspect.text(ends.first);
      const std::string high = kinetic_aspect.text(ends.second);
      if (low == high)
        return "Kinetic friction is " + low + " in " +
               std::to_string(rows.size()) + " slides";
      return "Kinetic friction ranges from " + low + " (" + name(ends.first) +
             ") to " + high + " (" + name(ends.second) + ")";
    }

    /// Peaks over the rests before them; "" if there are no two rests.
    std::string healing(const ResultRows &rows)
    {
      ResultRows rested;
      for (const ResultRow &row : rows)
        if (row.slide.rest > 0. && row.has_peak)
          rested.push_back(row);
      return rested.size() > 1 && varies(rested, rest_aspect) ?
               trend("The peak after a rest",
                     rested,
                     peak_aspect,
                     rest_aspect) :
               "";
    }

    /// Of slides under one law, by what makes them different.
    std::string of_one_law(const ResultRows &rows, const Reference &reference)
    {
      if (rows.size() == 1)
        return one_slide(rows[0], reference);
      const bool  speeds    = varies(rows, speed_aspect);
      const bool  pressures = varies(rows, pressure_aspect);
      std::string text;
      if (!speeds && !pressures)
        text = healing(rows);
      if (!text.empty())
        return text;

      if (changes_direction(rows))
        text = named_range(rows, [](const ResultRow &row) {
          return short_text(row.slide.angle * 180. / dealii::numbers::PI) +
                 " deg";
        });
      else if (speeds != pressures)
        text = trend("Kinetic friction",
                     rows,
                     kinetic_aspect,
                     speeds ? speed_aspect : pressure_aspect);
      else
        text = "Kinetic friction is " + range(rows, kinetic_aspect) + " in " +
               std::to_string(rows.size()) + " slides";
      if (reference.exists())
        text += ", " + against(rows, reference);
      // After a step of speed, a peak is no static one.
      const bool has_steps = any_of(rows, std::mem_fn(&ResultRow::is_step));
      return text + (has_steps || pressures || changes_direction(rows) ?
                       "" :
                       drop(rows));
    }

    std::string with_small_letter(std::string text)
    {
      text[0] = std::tolower(text[0]);
      return text;
    }

    /// "thin: kinetic friction is ...; thick: ..."
    std::string run_by_run(const ResultRows &rows, const Reference &reference)
    {
      constexpr unsigned int most = 4;
      std::string            text;
      unsigned int           n = 0;
      for (auto begin = rows.begin(); begin != rows.end(); ++n)
        {
          const auto end =
            std::find_if(begin, rows.end(), [begin](const ResultRow &row) {
              return row.run != begin->run;
            });
          if (n < most)
            text +=
              (n > 0 ? ". " : "") + begin->label + ": " +
              with_small_letter(of_one_law(ResultRows(begin, end), reference));
          begin = end;
        }
      return text + (n > most ? ". The table has " + std::to_string(n - most) +
                                  " more runs" :
                                "");
    }

    std::string of_steady_slides(const ResultRows &rows,
                                 const Reference  &reference,
                                 const bool        is_one_law)
    {
      const std::size_t n_runs = rows.back().run - rows.front().run + 1;
      if (n_runs == 1)
        return of_one_law(rows, reference);
      for (std::size_t i = 1; i < rows.size(); ++i)
        if (rows[i].run == rows[i - 1].run)
          return run_by_run(rows, reference);
      if (is_one_law &&
          (varies(rows, speed_aspect) || varies(rows, pressure_aspect) ||
           !varies(rows, kinetic_aspect)))
        return of_one_law(rows, reference);
      const std::string compared = against(rows, reference);
      return named_range(rows, [](const ResultRow &row) { return row.label; }) +
             (compared.empty() ? "" : ", " + compared) + drop(rows);
    }

    std::string list_of_speeds(const ResultRows &rows)
    {
      std::vector<std::string> speeds;
      for (const ResultRow &row : rows)
        {
          const std::string speed = speed_text(row.slide.speed);
          if (!holds(speeds, speed))
            speeds.push_back(speed);
        }
      return list_text(speeds);
    }

    /// Of slides at whose end the contact sticks and slips.
    std::string stick_slip(const ResultRows &rows)
    {
      return rows.empty() ? "" :
                            "The machine is too soft for steady sliding at " +
                              list_of_speeds(rows) + ": stick-slip.";
    }

    /// Of others at whose end friction goes up and down.
    std::string swings(const ResultRows &rows)
    {
      if (rows.empty())
        return "";
      const Aspect from = {of_slide(&SlideSummary::swing_from), four_decimals};
      const Aspect to   = {of_slide(&SlideSummary::swing_to), four_decimals};
      return "At " + list_of_speeds(rows) + " friction still swings between " +
             range(rows, from) + " and " + range(rows, to) +
             " when the slide ends: sliding is not steady there.";
    }

    const Aspect end_aspect = {&ResultRow::end, four_decimals};

    /// Slides of which the headline has yet to speak.
    struct Remaining
    {
      std::size_t n          = 0;
      bool        are_others = false;

      /// "In 2 of 3 slides, "; "" for all
      std::string some(const std::size_t n_some) const
      {
        return n_some == n && !are_others ?
                 "" :
                 "In " + std::to_string(n_some) + " of " +
                   (are_others ? "the other " : "") + std::to_string(n) +
                   " slides, ";
      }

      std::string end() const
      {
        return std::string("at the end of ") +
               (n == 1 ? "the slide" : "a slide");
      }
    };

    /// Of slides at whose end part of the contact still sticks.
    std::string partial_slip(const ResultRows &rows, const Remaining &all)
    {
      if (rows.empty())
        return "";
      const Aspect share = {of_slide(&SlideSummary::slip_fraction),
                            [](const double fraction) {
                              return short_text(100. * fraction, 3);
                            }};
      return capitalised(all.some(rows.size()) + "only " + range(rows, share) +
                         " % of the contact slips " + all.end() +
                         ", where friction is " + range(rows, end_aspect) +
                         ": there is no kinetic friction before all of it "
                         "slides.");
    }

    /// Of slides that end on the way to sliding.
    std::string on_the_way(const ResultRows &rows, const Remaining &all)
    {
      return rows.empty() ? "" :
                            capitalised(all.some(rows.size()) +
                                        "the contact has not come to steady "
                                        "sliding " +
                                        all.end() + ", where friction is " +
                                        range(rows, end_aspect) +
                                        ": that is no kinetic friction yet.");
    }
  } // namespace



  std::string headline(const ResultRows &all_rows,
                       const Reference  &reference,
                       const bool        is_one_law)
  {
    if (all_rows.empty())
      return "No slide has been reached.";
    std::size_t n = 0;
    ResultRows  steady, unstable, swinging, partial, unsettled;
    for (const ResultRow &row : all_rows)
      if (row.slide.is_complete)
        {
          ++n;
          (row.has_kinetic()   ? steady :
           !row.is_steady      ? unstable :
           row.slide.swings()  ? swinging :
           !row.slides_fully() ? partial :
                                 unsettled)
            .push_back(row);
        }
    if (n == 0)
      return "No slide has been completed.";
    std::string text;
    if (!steady.empty())
      text = of_steady_slides(steady, reference, is_one_law) + ".";
    const std::size_t n_unsteady = unstable.size() + swinging.size();
    const Remaining   others     = {n - n_unsteady, n_unsteady > 0};
    for (const std::string &more : {stick_slip(unstable),
                                    swings(swinging),
                                    partial_slip(partial, others),
                                    on_the_way(unsettled, others)})
      text += (text.empty() || more.empty() ? "" : " ") + more;
    return text;
  }



  std::string headline_of_pushes(const Runs &runs)
  {
    std::vector<const RunResults *> moved;
    for (const RunResults &run : runs)
      if (!run.history.empty())
        moved.push_back(&run);
    if (moved.empty())
      return "No slide has been reached.";
    const auto is_less = [](const RunResults *a, const RunResults *b) {
      return a->history.back().slip < b->history.back().slip;
    };
    const RunResults &least =
      **std::min_element(moved.begin(), moved.end(), is_less);
    const RunResults &most =
      **std::max_element(moved.begin(), moved.end(), is_less);
    const auto slip = [](const RunResults &run) {
      return short_text(run.history.back().slip, 3) + " mm";
    };
    const bool is_finished = all_of(runs, [](const RunResults &run) {
      return run.summary.status == "finished";
    });
    if (!is_finished && !(most.history.back().slip > 0.))
      return "No slide has been reached.";
    const bool is_pushed =
      all_of(runs, [](const RunResults &run) { return run.summary.is_pushed; });
    const std::string text =
      is_pushed ? "The contact is pushed by a load, not slid; in the end it "
                  "has slipped " :
                  "The programme has no straight slide; in the end the contact "
                  "has slipped ";
    if (slip(least) == slip(most))
      return text + slip(most) + ".";
    return text + slip(least) + " (" + least.label + ") to " + slip(most) +
           " (" + most.label + ").";
  }
} // namespace SlipStep
