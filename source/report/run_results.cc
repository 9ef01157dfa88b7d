// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/run_results.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/units.h>

#include <deal.II/base/utilities.h>
#include <deal.II/base/numbers.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>

namespace SlipStep
{
  namespace
  {
    constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

    FaceTable read_face(const std::filesystem::path &file)
    {
      // Its columns tell which face it is: y and z of the left one.
      const auto                 names = CsvTable(file, CsvFormat()).header();
      std::array<std::string, 2> axes  = {{"x", "y"}};
      for (unsigned int i = 0; i < 2 && i < names.size(); ++i)
        if (names[i] == "y_mm" || names[i] == "z_mm")
          axes[i] = names[i].substr(0, 1);
      return {CsvTable(file,
                       {axes[0] + "_mm",
                        axes[1] + "_mm",
                        "cell_size_" + axes[0] + "_mm",
                        "cell_size_" + axes[1] + "_mm",
                        "area_mm2",
                        "pressure_MPa",
                        "slip_mm"}),
              axes};
    }



    /// A bare number is in mm/min, as in the formula.
    double read_speed(const std::string &text)
    {
      const bool has_unit = text.find_first_of("/") != std::string::npos;
      return parse_quantity(has_unit ? text : text + " mm/min",
                            Dimension::speed,
                            true);
    }



    // What was killed has not written its end.
    void end_here(RunResults &run)
    {
      run.summary.status = "failed";
      run.summary.steps  = run.history.size();
      run.summary.reason = "it has not ended: killed, or still running, "
                           "before its first step";
      if (run.history.empty())
        return;
      run.summary.reason =
        "it has not ended: killed, or still running, at t = " +
        short_text(run.history.back().time, 6) + " s";
      summarise_energies(run.history, run.summary);
    }



    void shorten_labels(Runs &runs)
    {
      std::map<std::string, std::size_t>    n_runs_with;
      std::vector<std::vector<std::string>> parts;
      for (RunResults &run : runs)
        {
          run.short_label = run.label;
          parts.push_back(dealii::Utilities::split_string_list(run.label, ','));
          for (const std::string &part :
               std::set<std::string>(parts.back().begin(), parts.back().end()))
            ++n_runs_with[part];
        }
      // Parts of lists of different lengths make no sense alone.
      if (any_of(parts, [&](const auto &other) {
            return other.size() != parts[0].size();
          }))
        return;
      for (std::size_t i = 0; i < runs.size(); ++i)
        {
          std::string text;
          for (const std::string &part : parts[i])
            if (n_runs_with[part] < runs.size())
              text += (text.empty() ? "" : ", ") + part;
          if (!text.empty())
            runs[i].short_label = text;
        }
    }



    /// By more than steps in time scatter.
    bool exceeds(const double a, const double b)
    {
      return a - b > 5e-4 * std::abs(a);
    }

    /// Whether the motion before went on without a rest at another speed.
    bool is_speed_step(const std::vector<SlideSummary> &slides,
                       const SlideSummary              &slide)
    {
      if (&slide == &slides.front())
        return false;
      const SlideSummary &before = *(&slide - 1);
      return slide.rest < 1e-9 &&
             std::cos(slide.angle - before.angle) > 0.999 &&
             std::abs(slide.speed - before.speed) > 1e-3 * before.speed;
    }



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
                                    friction_text};
    const Aspect peak_aspect = {of_slide(&SlideSummary::peak), friction_text};

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
             " over all slides";
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
           "peaks at " + friction_text(row.slide.peak) + " after " +
             short_text(row.slide.peak_displacement, 2) + " mm and is " +
             friction_text(row.slide.kinetic) + " in the end, " +
             fixed_text(row.drop, 1) + " % lower" :
           "comes to " + friction_text(row.slide.kinetic) + " without a peak");
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

    /// Of slides at whose end friction goes up and down.
    std::string swings(const ResultRows &rows)
    {
      const Aspect from = {of_slide(&SlideSummary::swing_from), friction_text};
      const Aspect to   = {of_slide(&SlideSummary::swing_to), friction_text};
      return "At " + list_of_speeds(rows) + " friction still swings between " +
             range(rows, from) + " and " + range(rows, to) +
             " when the slide ends: sliding is not steady there.";
    }

    const Aspect end_aspect = {&ResultRow::end, friction_text};

    const Aspect share_aspect = {of_slide(&SlideSummary::slip_fraction),
                                 [](const double fraction) {
                                   return short_text(100. * fraction, 3);
                                 }};

    /// Of some of n slides of which the headline has yet to speak.
    std::string unfinished(const ResultRows  &rows,
                           const std::size_t  n,
                           const bool         are_others,
                           const std::string &what,
                           const std::string &so)
    {
      const std::string some = rows.size() == n && !are_others ?
                                 "" :
                                 "In " + std::to_string(rows.size()) + " of " +
                                   (are_others ? "the other " : "") +
                                   std::to_string(n) + " slides, ";
      return capitalised(
        some + what + " at the end of " + (n == 1 ? "the slide" : "a slide") +
        ", where friction is " + range(rows, end_aspect) + ": " + so);
    }
  } // namespace



  Runs load_runs(const std::vector<ReportedRun> &runs,
                 std::vector<std::string>       &warnings)
  {
    Runs results;
    for (const ReportedRun &run : runs)
      try
        {
          RunResults result;
          result.label   = run.label;
          result.folder  = run.folder;
          result.summary = read_summary(run.folder / "summary.json");
          result.history = read_history(run.folder / "history.csv", &warnings);
          if (result.summary.status == "running")
            end_here(result);
          if (result.history.size() < result.summary.steps)
            warnings.push_back(
              "run '" + run.label + "': history.csv has " +
              std::to_string(result.history.size()) + " of the " +
              std::to_string(result.summary.steps) +
              " rows that it had when summary.json was written");
          const auto face = run.folder / "contact_face.csv";
          if (std::filesystem::exists(face))
            result.contact_face = read_face(face);
          results.push_back(std::move(result));
        }
      catch (const InputError &error)
        {
          warnings.push_back("run '" + run.label +
                             "' is not in the report: " + error.what());
        }
    shorten_labels(results);
    return results;
  }



  Reference::Reference(const Parameters &parameters)
    : name(parameters.text("Report/Reference name"))
    , quasi_static(
        parameters.number("Report/Reference quasi-static coefficient"))
  {
    for (const std::string &text : parameters.list("Report/Reference speeds"))
      parameters.attempt("Report/Reference speeds", [&]() {
        speeds.push_back(read_speed(text));
        if (!(speeds.back() > 0.))
          throw InputError("'" + text + "' is not above zero");
      });

    const std::string key  = "Report/Reference kinetic coefficient";
    const std::string text = parameters.text(key);
    if (text.empty())
      return;
    try
      {
        formula = std::make_shared<const ParsedFormula>(text, "V");
        if (!std::isfinite((*formula)(1.)))
          throw InputError("not a finite number at V = 1");
      }
    catch (const InputError &error)
      {
        parameters.reject(key,
                          "expected is a formula of the speed V in mm/min, "
                          "e.g. 0.0042*log(V) + 0.1: " +
                            std::string(error.what()));
      }
  }



  double Reference::kinetic(const double speed) const
  {
    const double value = exists() ? (*formula)(speed * mm_min) : undefined;
    return std::isfinite(value) ? value : undefined;
  }



  double Reference::dynamic_ratio(const double speed) const
  {
    return quasi_static > 0. && exists() ? kinetic(speed) / quasi_static : 0.;
  }



  ResultRows result_rows(const Runs &runs, const Reference &reference)
  {
    ResultRows rows;
    for (std::size_t i = 0; i < runs.size(); ++i)
      for (const SlideSummary &slide : runs[i].summary.slides)
        {
          ResultRow row;
          row.label = runs[i].short_label;
          row.run   = i;
          row.slide = slide;
          // It is counted from the slide before.
          if (&slide == &runs[i].summary.slides.front())
            row.slide.rest = undefined;
          row.end       = slide.kinetic;
          row.is_steady = !runs[i].summary.is_unstable(slide);
          row.is_step   = is_speed_step(runs[i].summary.slides, slide);
          row.has_peak  = exceeds(slide.peak, std::max(slide.before, row.end));
          row.has_dip =
            row.is_step && exceeds(std::min(slide.before, row.end), slide.dip);
          if (!row.has_kinetic())
            row.slide.kinetic       = row.slide.dynamic_ratio =
              row.slide.coefficient = undefined;
          row.drop       = row.has_peak ?
                             100. * (1. - row.slide.kinetic / slide.peak) :
                             undefined;
          row.reference  = reference.kinetic(slide.speed);
          row.difference = 100. * (row.slide.kinetic / row.reference - 1.);
          rows.push_back(row);
        }
    return rows;
  }



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
    const std::size_t        n_unsteady = unstable.size() + swinging.size();
    std::vector<std::string> texts;
    if (!steady.empty())
      texts = {of_steady_slides(steady, reference, is_one_law) + "."};
    if (!unstable.empty())
      texts.push_back("The machine is too soft for steady sliding at " +
                      list_of_speeds(unstable) + ": stick-slip.");
    if (!swinging.empty())
      texts.push_back(swings(swinging));
    if (!partial.empty())
      texts.push_back(
        unfinished(partial,
                   n - n_unsteady,
                   n_unsteady > 0,
                   "only " + range(partial, share_aspect) +
                     " % of the contact slips",
                   "there is no kinetic friction before all of it slides."));
    if (!unsettled.empty())
      texts.push_back(unfinished(unsettled,
                                 n - n_unsteady,
                                 n_unsteady > 0,
                                 "the contact has not come to steady sliding",
                                 "that is no kinetic friction yet."));
    return boost::algorithm::join(texts, " ");
  }



  bool is_driven(const RunResults &run)
  {
    return any_of(run.history, [](const HistoryRow &row) {
      return row.displacement != 0. || row.displacement_y != 0.;
    });
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
    const bool        is_moved = any_of(runs, is_driven);
    const std::string text =
      is_pushed ? "The contact is pushed by a load, not slid; in the end it "
                  "has slipped " :
      is_moved  ? "The programme has no straight slide; in the end the contact "
                  "has slipped " :
                  "The programme moves no drive; under the loads on the faces "
                  "the contact has slipped by ";
    if (slip(least) == slip(most))
      return text + slip(most) + ".";
    return text + slip(least) + " (" + least.label + ") to " + slip(most) +
           " (" + most.label + ").";
  }
} // namespace SlipStep
