// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/run_results.h>

#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/units.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace SlipStep
{
  namespace
  {
    constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

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
          result.history = read_history(run.folder / "history.csv");
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
            result.contact_face.emplace(face, face_columns);
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
      try
        {
          speeds.push_back(read_speed(text));
          if (!(speeds.back() > 0.))
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
          row.label     = runs[i].short_label;
          row.run       = i;
          row.slide     = slide;
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
} // namespace SlipStep
