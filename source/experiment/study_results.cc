// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/study_results.h>

#include <slipstep/experiment/convergence.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace SlipStep
{
  namespace
  {
    Summary load(const StudyRun &run, const std::filesystem::path &output)
    {
      Summary summary;
      try
        {
          summary = read_summary(output / run.folder / "summary.json");
        }
      catch (const InputError &error)
        {
          summary.status = "failed";
          summary.reason = error.what();
        }
      // One that was killed has not said so itself.
      if (summary.status == "running")
        {
          summary.status = "failed";
          summary.reason = "it was stopped";
        }
      return summary;
    }

    bool is_finished(const Summary &summary)
    {
      return summary.status == "finished";
    }

    /// Size of the mesh or of the time step of a run, in units that do not
    /// matter.
    double size_of(const StudyCurve &curve, const Summary &summary)
    {
      return curve.kind == StudySequence::Kind::time_step ?
               1. / summary.steps :
               std::pow(summary.dofs, -1. / curve.dimension);
    }

    /// Of stages in time two, of quadratic elements twice their degree.
    double highest_order(const StudyCurve &curve)
    {
      return curve.kind == StudySequence::Kind::time_step ? 2. : 4.;
    }

    const QuantityValue *find(const Summary &summary, const std::string &name)
    {
      for (const QuantityValue &quantity : summary.quantities)
        if (quantity.name == name)
          return &quantity;
      return nullptr;
    }

    double value_in(const Summary &summary, const std::string &name)
    {
      const QuantityValue *quantity = find(summary, name);
      return is_finished(summary) && quantity != nullptr ?
               quantity->value :
               QuantityOfInterest::undefined;
    }



    /// The runs of a curve that came to a value, coarse to fine.
    struct SeriesOfRuns
    {
      std::vector<double> sizes, values;
      std::string         finest; ///< label
    };

    /// @param n_points of the curve that are looked at
    SeriesOfRuns series_of(const StudyCurve &curve, const std::size_t n_points)
    {
      SeriesOfRuns series;
      for (std::size_t i = 0; i < n_points; ++i)
        if (std::isfinite(curve.points[i].value))
          {
            // Uniform meshes are halved exactly.
            series.sizes.push_back(curve.kind == StudySequence::Kind::uniform ?
                                     std::pow(0.5, i) :
                                     size_of(curve, curve.points[i].summary));
            series.values.push_back(curve.points[i].value);
            series.finest = curve.points[i].label;
          }
      return series;
    }



    struct NamedReference
    {
      ReferenceValue found = {QuantityOfInterest::undefined,
                              QuantityOfInterest::undefined,
                              false};
      std::string    name;
    };

    /// From the last three runs that finished, or else the last of them.
    NamedReference extrapolate(const StudyCurve &curve)
    {
      const auto [sizes, values, finest] =
        series_of(curve, curve.points.size());
      const std::size_t n = values.size();
      if (n == 0)
        return {};
      // Solvers do not do better than that.
      if (n >= 2 && std::abs(values[n - 1] - values[n - 2]) <=
                      1e-9 * std::abs(values[n - 1]))
        return {finest_reference(sizes, values, highest_order(curve)),
                finest + ", because the last two values agree"};
      const ReferenceValue found =
        extrapolated_reference(sizes, values, highest_order(curve));
      if (found.is_extrapolated)
        return {found, "Richardson"};
      return {found, finest + ", because the last three values show no order"};
    }

    /// A finer run, at the end of the curve's runs.
    NamedReference finer_run(const StudyCurve  &curve,
                             const std::string &label,
                             const Summary     &summary)
    {
      const double value = value_in(summary, curve.quantity);
      if (!std::isfinite(value))
        return {NamedReference().found, label};
      StudyCurve complete = curve;
      complete.kind       = curve.kind == StudySequence::Kind::time_step ?
                              curve.kind :
                              StudySequence::Kind::adaptive; // by unknowns
      complete.points.push_back({label, summary, value});
      const SeriesOfRuns series = series_of(complete, complete.points.size());
      return {finest_reference(series.sizes,
                               series.values,
                               highest_order(curve)),
              label};
    }

    void compare(const NamedReference &reference, StudyCurve &curve)
    {
      curve.reference      = reference.found.value;
      curve.uncertainty    = reference.found.uncertainty;
      curve.reference_name = reference.name;
      const double scale =
        curve.reference == 0. ? 1. : std::abs(curve.reference);
      for (std::size_t i = 0; i < curve.points.size(); ++i)
        {
          StudyPoint &point = curve.points[i];
          if (!std::isfinite(point.value))
            continue;
          const double difference = std::abs(point.value - curve.reference);
          if (difference > curve.uncertainty)
            point.error = difference / scale;
          point.error_bound         = (difference + curve.uncertainty) / scale;
          const SeriesOfRuns series = series_of(curve, i + 1);
          curve.order               = point.order =
            shown_order(series.sizes, series.values, highest_order(curve));
        }
    }



    /// The values of one quantity along one sequence, not compared yet.
    StudyCurve collect(const StudySequence                  &sequence,
                       const std::string                    &quantity,
                       const std::map<std::string, Summary> &summaries)
    {
      StudyCurve curve;
      curve.kind     = sequence.kind;
      curve.sequence = sequence.name;
      curve.quantity = quantity;
      for (const StudyRun &run : sequence.runs)
        {
          StudyPoint point;
          point.label   = run.label;
          point.summary = summaries.at(run.folder);
          point.value   = value_in(point.summary, quantity);
          if (const QuantityValue *found = find(point.summary, quantity))
            {
              curve.unit      = found->unit;
              curve.dimension = point.summary.dimension;
            }
          curve.points.push_back(point);
        }
      return curve;
    }



    /// What the study has of both.
    void compare_meshes(const StudyRun                       &finer,
                        const std::map<std::string, Summary> &summaries,
                        StudyCurve                           *uniform,
                        StudyCurve                           *adaptive)
    {
      NamedReference reference;
      if (finer.label.empty())
        {
          if (uniform != nullptr)
            reference = extrapolate(*uniform);
        }
      else
        {
          const bool  is_adaptive = finer.label.rfind("adaptive", 0) == 0;
          StudyCurve *own         = is_adaptive ? adaptive : uniform;
          if (own == nullptr)
            own = is_adaptive ? uniform : adaptive;
          const Summary &summary = summaries.at(finer.folder);
          reference              = finer_run(*own, finer.label, summary);
          for (StudyCurve *curve : {uniform, adaptive})
            if (curve != nullptr)
              curve->reference_run = summary;
        }
      if (uniform != nullptr)
        compare(reference, *uniform);
      if (finer.label.empty())
        reference.name += " of the uniform meshes";
      if (adaptive != nullptr)
        compare(reference, *adaptive);
    }
  } // namespace



  std::vector<StudyCurve> study_curves(const RefinementStudy       &study,
                                       const std::filesystem::path &output)
  {
    std::map<std::string, Summary> summaries;
    std::vector<std::string>       quantities;
    for (const StudyRun &run : study.runs())
      {
        const Summary &summary = summaries[run.folder] = load(run, output);
        if (quantities.empty())
          for (const QuantityValue &quantity : summary.quantities)
            quantities.push_back(quantity.name);
      }

    std::vector<StudyCurve> curves;
    for (const std::string &quantity : quantities)
      {
        const std::size_t first = curves.size();
        for (const StudySequence &sequence : study.sequences)
          curves.push_back(collect(sequence, quantity, summaries));
        const auto curve_of = [&](const StudySequence::Kind kind) {
          for (std::size_t i = first; i < curves.size(); ++i)
            if (curves[i].kind == kind)
              return &curves[i];
          return static_cast<StudyCurve *>(nullptr);
        };
        compare_meshes(study.mesh_reference,
                       summaries,
                       curve_of(StudySequence::Kind::uniform),
                       curve_of(StudySequence::Kind::adaptive));
        StudyCurve     *steps      = curve_of(StudySequence::Kind::time_step);
        const StudyRun &finer_step = study.time_reference;
        if (steps != nullptr)
          compare(finer_step.label.empty() ?
                    extrapolate(*steps) :
                    finer_run(*steps,
                              finer_step.label,
                              summaries.at(finer_step.folder)),
                  *steps);
      }
    return curves;
  }



  std::string StudyPoint::error_text() const
  {
    return error_bound == 0.          ? "0" :
           std::isfinite(error)       ? short_text(error, 3) :
           std::isfinite(error_bound) ? "< " + short_text(error_bound, 2) :
           std::isfinite(value)       ? "?" :
                                        "–";
  }



  std::vector<std::string> StudyCurve::problems() const
  {
    std::vector<std::string> result;
    const auto look_at = [&](const std::string &label, const Summary &summary) {
      if (!is_finished(summary))
        result.push_back(label + " failed: " + summary.reason);
      for (const std::string &doubt :
           {summary.missing_energy(), summary.mesh_error.missed()})
        if (!doubt.empty())
          result.push_back(label + ": warning: " + doubt);
    };
    for (const StudyPoint &point : points)
      look_at(point.label, point.summary);
    if (reference_run)
      look_at("the reference " + reference_name, *reference_run);
    return result;
  }



  double StudyCurve::relative_uncertainty() const
  {
    return reference == 0. ? uncertainty : uncertainty / std::abs(reference);
  }



  const StudyPoint *StudyCurve::finest() const
  {
    const auto found =
      std::find_if(points.rbegin(), points.rend(), [](const StudyPoint &point) {
        return std::isfinite(point.value);
      });
    return found == points.rend() ? nullptr : &*found;
  }



  // A coarse run may be close by accident, so finer ones must be, too.
  const StudyPoint *StudyCurve::cheapest(const double error) const
  {
    const StudyPoint *result = nullptr;
    for (auto point = points.rbegin(); point != points.rend(); ++point)
      {
        if (!std::isfinite(point->value))
          continue;
        if (!(point->error_bound <= error))
          break;
        const auto cost = [](const Summary &summary) {
          return static_cast<double>(summary.dofs) * summary.steps;
        };
        if (result == nullptr || cost(point->summary) < cost(result->summary))
          result = &*point;
      }
    return result;
  }
} // namespace SlipStep
