// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/run_results.h>

#include <slipstep/utilities/text.h>
#include <slipstep/utilities/units.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>

namespace SlipStep
{
  namespace
  {
    const std::vector<std::string> face_columns = {"x_mm",
                                                   "y_mm",
                                                   "cell_size_x_mm",
                                                   "cell_size_y_mm",
                                                   "area_mm2",
                                                   "pressure_MPa",
                                                   "slip_mm"};

    /// A bare number is in mm/min, as in the formula.
    double read_speed(const std::string &text)
    {
      const bool has_unit = text.find_first_of("/") != std::string::npos;
      return parse_quantity(has_unit ? text : text + " mm/min",
                            Dimension::speed,
                            true);
    }
  } // namespace



  std::vector<RunResults> load_runs(const std::vector<ReportedRun> &runs,
                                    std::vector<std::string>       &warnings)
  {
    std::vector<RunResults> results;
    for (const ReportedRun &run : runs)
      try
        {
          RunResults result;
          result.label    = run.label;
          result.folder   = run.folder;
          result.summary  = read_summary(run.folder / "summary.json");
          result.history  = read_history(run.folder / "history.csv");
          const auto face = run.folder / "contact_face.csv";
          if (std::filesystem::exists(face))
            result.contact_face.emplace(face, face_columns);
          results.push_back(std::move(result));
        }
      catch (const InputError &error)
        {
          warnings.push_back("run '" + run.label +
                             "' is not in the report: " + error.what());
        }
    return results;
  }



  Reference::Reference(const Parameters &parameters)
    : reference_name(parameters.text("Report/Reference name"))
    , quasi_static(
        parameters.number("Report/Reference quasi-static coefficient"))
  {
    for (const std::string &text : parameters.list("Report/Reference speeds"))
      try
        {
          speed_list.push_back(read_speed(text));
          if (!(speed_list.back() > 0.))
            throw InputError("'" + text + "' is not above zero");
        }
      catch (const InputError &error)
        {
          parameters.reject("Report/Reference speeds", error.what());
        }

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



  bool Reference::exists() const
  {
    return formula != nullptr;
  }



  double Reference::kinetic(const double speed) const
  {
    return exists() ? (*formula)(speed * mm_min) :
                      std::numeric_limits<double>::quiet_NaN();
  }



  double Reference::dynamic_ratio(const double speed) const
  {
    return quasi_static > 0. && exists() ? kinetic(speed) / quasi_static : 0.;
  }



  const std::vector<double> &Reference::speeds() const
  {
    return speed_list;
  }



  const std::string &Reference::name() const
  {
    return reference_name;
  }



  std::vector<ResultRow> result_rows(const std::vector<RunResults> &runs,
                                     const Reference               &reference)
  {
    std::vector<ResultRow> rows;
    for (std::size_t i = 0; i < runs.size(); ++i)
      for (const SlideSummary &slide : runs[i].summary.slides)
        {
          ResultRow row;
          row.label = runs[i].label;
          row.run   = i;
          row.slide = slide;
          if (!slide.is_complete)
            row.slide.kinetic       = row.slide.dynamic_ratio =
              row.slide.coefficient = std::numeric_limits<double>::quiet_NaN();
          row.is_steady  = !runs[i].summary.is_unstable(slide);
          row.drop       = 100. * (1. - row.slide.kinetic / slide.peak);
          row.reference  = reference.kinetic(slide.speed);
          row.difference = 100. * (row.slide.kinetic / row.reference - 1.);
          rows.push_back(row);
        }
    return rows;
  }



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

    std::string one_slide(const ResultRow &row, const Reference &reference)
    {
      const std::string drop = fixed_text(row.drop, 1);
      std::string       text =
        "At " + speed_text(row.slide.speed) + ", friction " +
        (drop == "0.0" ?
           "rises to " + fixed_text(row.slide.kinetic, 4) + " without a peak" :
           "peaks at " + fixed_text(row.slide.peak, 4) + " after " +
             short_text(row.slide.peak_displacement, 2) + " mm and is " +
             fixed_text(row.slide.kinetic, 4) + " in the end, " + drop +
             " % lower");
      if (reference.exists())
        text += "; that is " + comparison(row.difference, row.difference) +
                reference.name();
      return text + ".";
    }

    /// Smallest and largest of the rows by a value.
    template <typename Value>
    std::pair<ResultRow, ResultRow> extremes(const std::vector<ResultRow> &rows,
                                             const Value &value)
    {
      const auto found =
        std::minmax_element(rows.begin(),
                            rows.end(),
                            [&](const ResultRow &a, const ResultRow &b) {
                              return value(a) < value(b);
                            });
      return {*found.first, *found.second};
    }

    /// "Kinetic friction rises from 0.1 at 1 mm/min to 0.12 at 50 mm/min"
    std::string kinetic_friction(const std::vector<ResultRow> &rows)
    {
      const auto kinetic = [](const ResultRow &row) {
        return fixed_text(row.slide.kinetic, 4);
      };
      const auto by_kinetic =
        extremes(rows, [](const ResultRow &row) { return row.slide.kinetic; });
      const auto by_speed =
        extremes(rows, [](const ResultRow &row) { return row.slide.speed; });
      const std::string range =
        from_to(kinetic(by_kinetic.first), kinetic(by_kinetic.second));

      // One slide per run and speed tells a trend.
      const bool one_per_run =
        rows.front().run != rows.back().run &&
        rows.size() == rows.back().run - rows.front().run + 1;
      if (by_speed.second.slide.speed > 1.001 * by_speed.first.slide.speed &&
          kinetic(by_speed.first) != kinetic(by_speed.second))
        return std::string("Kinetic friction ") +
               (by_speed.first.slide.kinetic < by_speed.second.slide.kinetic ?
                  "rises" :
                  "falls") +
               " from " + kinetic(by_speed.first) + " at " +
               speed_text(by_speed.first.slide.speed) + " to " +
               kinetic(by_speed.second) + " at " +
               speed_text(by_speed.second.slide.speed);
      if (one_per_run &&
          kinetic(by_kinetic.first) != kinetic(by_kinetic.second))
        return "Kinetic friction ranges from " + kinetic(by_kinetic.first) +
               " (" + by_kinetic.first.label + ") to " +
               kinetic(by_kinetic.second) + " (" + by_kinetic.second.label +
               ")";
      return "Kinetic friction is " + range + " in " +
             std::to_string(rows.size()) + " slides";
    }
  } // namespace



  namespace
  {
    /// At which speeds the contact sticks and slips; empty at none.
    std::string stick_slip(const std::vector<ResultRow> &rows)
    {
      std::vector<std::string> speeds;
      for (const ResultRow &row : rows)
        {
          const std::string speed = speed_text(row.slide.speed);
          if (!row.is_steady &&
              std::find(speeds.begin(), speeds.end(), speed) == speeds.end())
            speeds.push_back(speed);
        }
      if (speeds.empty())
        return "";
      std::string text = "The machine is too soft for steady sliding at ";
      for (std::size_t i = 0; i < speeds.size(); ++i)
        text += (i == 0                 ? "" :
                 i + 1 == speeds.size() ? " and " :
                                          ", ") +
                speeds[i];
      return text + ": stick-slip.";
    }



    /// Of several slides, or of one.
    std::string friction_of(const std::vector<ResultRow> &rows,
                            const Reference              &reference)
    {
      if (rows.size() == 1)
        return one_slide(rows[0], reference);

      std::string text = kinetic_friction(rows);
      const auto  difference =
        extremes(rows, [](const ResultRow &row) { return row.difference; });
      if (reference.exists())
        text += ", " +
                comparison(difference.first.difference,
                           difference.second.difference) +
                reference.name();

      const auto drop =
        extremes(rows, [](const ResultRow &row) { return row.drop; });
      const std::string highest = fixed_text(drop.second.drop, 1);
      return text +
             (highest == "0.0" ?
                "; there is no drop from a peak." :
                "; it is " + from_to(fixed_text(drop.first.drop, 1), highest) +
                  " % lower than its peak.");
    }
  } // namespace



  std::string headline(const std::vector<ResultRow> &all_rows,
                       const Reference              &reference)
  {
    if (all_rows.empty())
      return "No slide has been reached.";
    std::vector<ResultRow> completed, steady;
    for (const ResultRow &row : all_rows)
      if (row.slide.is_complete)
        {
          completed.push_back(row);
          if (row.is_steady)
            steady.push_back(row);
        }
    if (completed.empty())
      return "No slide has been completed.";
    const std::string unsteady = stick_slip(completed);
    if (steady.empty())
      return unsteady;
    return friction_of(steady, reference) +
           (unsteady.empty() ? "" : " " + unsteady);
  }
} // namespace SlipStep
