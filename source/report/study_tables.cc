// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/study_report.h>
#include <slipstep/utilities/json_file.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/version.h>
#include <slipstep/utilities/write_file.h>

#include <cmath>
#include <set>
#include <sstream>

namespace SlipStep
{
  std::vector<TableLine> study_summary(const std::vector<StudyCurve> &curves)
  {
    std::vector<TableLine> lines = {{"quantity",
                                     "runs",
                                     "reference",
                                     "error of the finest",
                                     "order",
                                     "cheapest for 1 %"}};
    for (const StudyCurve &curve : curves)
      {
        const StudyPoint *finest   = curve.finest();
        const StudyPoint *cheapest = curve.cheapest(0.01);
        lines.push_back({name_with_unit(curve),
                         curve.sequence,
                         short_text(curve.reference, 6),
                         finest == nullptr ? "–" : finest->error_text(),
                         fixed_text(curve.order, 2),
                         cheapest == nullptr ?
                           "–" :
                           cheapest->label + " (" +
                             short_text(cheapest->summary.cpu_time, 2) +
                             " s)"});
      }
    return lines;
  }



  TableLine run_line(const StudyPoint &point)
  {
    return {point.label,
            std::to_string(point.summary.dofs),
            std::to_string(point.summary.steps),
            fixed_text(point.summary.cpu_time, 2),
            short_text(point.value, 7),
            point.error_text(),
            fixed_text(point.order, 2)};
  }



  std::string name_with_unit(const StudyCurve &curve)
  {
    return curve.quantity + (curve.unit.empty() ? "" : " [" + curve.unit + "]");
  }



  namespace
  {
    std::string reference_text(const StudyCurve &curve)
    {
      if (!std::isfinite(curve.reference))
        return "no reference";
      std::ostringstream out;
      out << "reference " << curve.reference << " (" << curve.reference_name
          << (std::isfinite(curve.order) ?
                ", order " + fixed_text(curve.order, 2) :
                "")
          << "), ";
      if (curve.uncertainty == 0.)
        out << "the same in all runs";
      else if (std::isfinite(curve.uncertainty))
        out << "uncertain by " << short_text(curve.uncertainty, 2)
            << (curve.reference == 0. ?
                  "" :
                  " (relative " + short_text(curve.relative_uncertainty(), 2) +
                    ")");
      else
        out << "but the values are not seen to approach a limit";
      return out.str();
    }
  } // namespace



  std::string study_tables(const std::vector<StudyCurve> &curves)
  {
    std::ostringstream    out;
    std::set<std::string> problems;
    out << '\n' << text_table(study_summary(curves));
    for (const StudyCurve &curve : curves)
      {
        std::vector<TableLine> lines = {
          {"run", "unknowns", "steps", "CPU [s]", "value", "error", "order"}};
        for (const StudyPoint &point : curve.points)
          lines.push_back(run_line(point));
        for (const std::string &problem : curve.problems())
          problems.insert("  " + problem + "\n");
        out << '\n'
            << name_with_unit(curve) << ", " << curve.sequence << ": "
            << reference_text(curve) << '\n'
            << text_table(lines);
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
    std::ostringstream out;
    out << "sequence,run,status,cells,unknowns,steps,cpu_s,memory_MB,quantity,"
           "unit,value,reference,relative_error,order,"
           "reference_uncertainty,error_bound\n";
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
            << text(point.order) << ',' << text(curve.uncertainty) << ','
            << text(point.error_bound) << '\n';
    write_file(file, out.str());
  }



  void write_study_json(const std::filesystem::path   &file,
                        const std::vector<StudyCurve> &curves)
  {
    using json = nlohmann::ordered_json;
    json list  = json::array();
    for (const StudyCurve &curve : curves)
      {
        json runs = json::array();
        for (const StudyPoint &point : curve.points)
          runs.push_back({{"run", point.label},
                          {"status", point.summary.status},
                          {"unknowns", point.summary.dofs},
                          {"steps", point.summary.steps},
                          {"cpu_s", point.summary.cpu_time},
                          {"value", point.value},
                          {"relative_error", point.error},
                          {"error_bound", point.error_bound},
                          {"order", point.order}});
        const StudyPoint *cheapest = curve.cheapest(0.01);
        list.push_back({{"quantity", curve.quantity},
                        {"unit", curve.unit},
                        {"sequence", curve.sequence},
                        {"reference", curve.reference},
                        {"reference_from", curve.reference_name},
                        {"reference_uncertainty", curve.uncertainty},
                        {"problems", curve.problems()},
                        {"order", curve.order},
                        {"cheapest_for_1_percent",
                         cheapest == nullptr ? json() : json(cheapest->label)},
                        {"runs", runs}});
      }
    write_json(file, {{"version", version()}, {"curves", list}});
  }
} // namespace SlipStep
