#include <slipstep/experiment/study_results.h>

#include <slipstep/experiment/convergence.h>
#include <slipstep/utilities/csv.h>
#include <slipstep/utilities/exceptions.h>

#include <deal.II/base/convergence_table.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

namespace SlipStep
{
  namespace
  {
    constexpr double undefined = QuantityOfInterest::undefined;

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

    /// Size of the mesh or of the time step of a run of a sequence, in units
    /// that do not matter.
    double size_of(const StudyCurve &curve, const std::size_t i)
    {
      const Summary &summary = curve.points[i].summary;
      switch (curve.kind)
        {
          case StudySequence::Kind::uniform:
            return std::pow(0.5, i);
          case StudySequence::Kind::adaptive:
            return std::pow(summary.dofs, -1. / curve.dimension);
          default:
            return 1. / summary.steps;
        }
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
      return is_finished(summary) && quantity != nullptr ? quantity->value :
                                                           undefined;
    }



    struct ReferenceValue
    {
      double      value = undefined;
      double      order = undefined;
      std::string name;
    };

    /// From the last three runs that finished, or else the last of them.
    ReferenceValue extrapolate(const StudyCurve &curve)
    {
      std::vector<double> sizes, values;
      std::string         finest;
      for (std::size_t i = 0; i < curve.points.size(); ++i)
        if (std::isfinite(curve.points[i].value))
          {
            sizes.push_back(size_of(curve, i));
            values.push_back(curve.points[i].value);
            finest = curve.points[i].label;
          }
      if (values.empty())
        return {};
      // Solvers do not do better than that.
      const std::size_t n = values.size();
      if (n >= 2 && std::abs(values[n - 1] - values[n - 2]) <=
                      1e-9 * std::abs(values[n - 1]))
        return {values.back(),
                undefined,
                finest + ", because the last two values agree"};
      const Extrapolation extrapolation = richardson(sizes, values);
      if (std::isfinite(extrapolation.limit))
        return {extrapolation.limit, extrapolation.order, "Richardson"};
      return {values.back(),
              undefined,
              finest + ", because the last three values show no order"};
    }

    void compare(const ReferenceValue &reference, StudyCurve &curve)
    {
      curve.reference      = reference.value;
      curve.reference_name = reference.name;
      curve.order          = reference.order;
      const double scale =
        reference.value == 0. ? 1. : std::abs(reference.value);
      for (std::size_t i = 0; i < curve.points.size(); ++i)
        {
          StudyPoint  &point = curve.points[i];
          const double error = std::abs(point.value - reference.value) / scale;
          point.error        = error > 0. ? error : undefined;
          if (i > 0)
            point.order = observed_order(curve.points[i - 1].error,
                                         point.error,
                                         size_of(curve, i - 1),
                                         size_of(curve, i));
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
        ReferenceValue mesh_reference;
        for (const StudySequence &sequence : study.sequences())
          {
            StudyCurve curve = collect(sequence, quantity, summaries);
            const bool is_time =
              sequence.kind == StudySequence::Kind::time_step;
            const StudyRun &finer =
              is_time ? study.time_reference() : study.mesh_reference();
            ReferenceValue reference;
            if (!finer.label.empty())
              reference = {value_in(summaries.at(finer.folder), quantity),
                           undefined,
                           finer.label};
            else if (sequence.kind == StudySequence::Kind::adaptive)
              reference = {mesh_reference.value,
                           undefined,
                           mesh_reference.name + " of the uniform meshes"};
            else
              reference = extrapolate(curve);
            // The uniform sequence comes before the adaptive one.
            if (sequence.kind == StudySequence::Kind::uniform)
              mesh_reference = reference;
            compare(reference, curve);
            curves.push_back(curve);
          }
      }
    return curves;
  }



  std::string study_tables(const std::vector<StudyCurve> &curves)
  {
    std::ostringstream    out;
    std::set<std::string> problems;
    for (const StudyCurve &curve : curves)
      {
        const bool is_time = curve.kind == StudySequence::Kind::time_step;
        dealii::ConvergenceTable table;
        for (const StudyPoint &point : curve.points)
          {
            table.add_value("run", point.label);
            table.add_value("unknowns",
                            static_cast<double>(point.summary.dofs));
            table.add_value("steps", static_cast<double>(point.summary.steps));
            table.add_value("CPU [s]", point.summary.cpu_time);
            table.add_value("value", point.value);
            table.add_value("error", point.error);
            if (!is_finished(point.summary))
              problems.insert("  " + point.label +
                              " failed: " + point.summary.reason + "\n");
            for (const std::string &doubt : {point.summary.missing_energy(),
                                             point.summary.missed_tolerance()})
              if (!doubt.empty())
                problems.insert("  " + point.label + ": warning: " + doubt +
                                "\n");
          }
        for (const std::string column : {"unknowns", "steps"})
          {
            table.set_scientific(column, false);
            table.set_precision(column, 0);
          }
        table.set_scientific("CPU [s]", false);
        table.set_precision("CPU [s]", 2);
        table.set_scientific("value", true);
        table.set_precision("value", 6);
        table.set_scientific("error", true);
        table.set_precision("error", 2);
        using dealii::ConvergenceTable;
        if (curve.points.size() < 2)
          ;
        else if (curve.kind == StudySequence::Kind::uniform)
          table.evaluate_convergence_rates(
            "error", ConvergenceTable::reduction_rate_log2);
        else
          table.evaluate_convergence_rates(
            "error",
            is_time ? "steps" : "unknowns",
            ConvergenceTable::reduction_rate_log2,
            is_time ? 1 : curve.dimension);

        out << '\n'
            << curve.quantity
            << (curve.unit.empty() ? "" : " [" + curve.unit + "]") << ", "
            << curve.sequence << ": ";
        if (std::isfinite(curve.reference))
          {
            out << "reference " << curve.reference << " ("
                << curve.reference_name;
            if (std::isfinite(curve.order))
              out << ", order " << curve.order;
            out << ")\n";
          }
        else
          out << "no reference\n";
        table.write_text(out);
      }
    // Once, not for every quantity.
    out << (problems.empty() ? "" : "\n");
    for (const std::string &failure : problems)
      out << failure;
    return out.str();
  }



  void write_study_csv(const std::filesystem::path   &file,
                       const std::vector<StudyCurve> &curves)
  {
    std::ofstream out(file);
    out << "sequence,run,status,cells,unknowns,steps,cpu_s,memory_MB,quantity,"
           "unit,value,reference,relative_error,order\n";
    const auto quoted = [](const std::string &text) {
      return "\"" + text + "\"";
    };
    const auto text = [](const double value) {
      return std::isfinite(value) ? exact_text(value) : std::string("nan");
    };
    for (const StudyCurve &curve : curves)
      for (const StudyPoint &point : curve.points)
        out << curve.sequence << ',' << quoted(point.label) << ','
            << point.summary.status << ',' << point.summary.cells << ','
            << point.summary.dofs << ',' << point.summary.steps << ','
            << text(point.summary.cpu_time) << ','
            << text(point.summary.peak_memory) << ',' << quoted(curve.quantity)
            << ',' << curve.unit << ',' << text(point.value) << ','
            << text(curve.reference) << ',' << text(point.error) << ','
            << text(point.order) << '\n';
    if (!out.flush())
      throw RunError(file.string() +
                     ": this file cannot be written (is the disk full?)");
  }
} // namespace SlipStep
