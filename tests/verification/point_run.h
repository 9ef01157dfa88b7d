#ifndef tests_verification_point_run_h
#define tests_verification_point_run_h

#include <slipstep/experiment/point_driver.h>
#include <slipstep/utilities/csv.h>

#include <string>
#include <utility>
#include <vector>

namespace SlipStep::Testing
{
  using Settings = std::vector<std::pair<std::string, std::string>>;

  inline Parameters point_parameters(const Settings &settings)
  {
    Parameters parameters;
    declare_loading_parameters(parameters);
    FrictionLaw::declare_parameters(parameters);
    for (const auto &setting : settings)
      parameters.set(setting.first, setting.second, "test");
    return parameters;
  }

  /// The rows of a run on one contact point.
  /// @param tolerance instead of the one of the case
  inline std::vector<HistoryRow> point_history(Parameters   parameters,
                                               const double tolerance)
  {
    parameters.set("Time stepping/Tolerance", exact_text(tolerance), "test");
    const FrictionLaw       law(parameters);
    const Programme         programme = parse_programme(parameters);
    std::vector<HistoryRow> history;
    drive_point(
      law,
      programme,
      StepControl(parameters, programme, law),
      [&](const HistoryRow &row) { history.push_back(row); },
      Machine(parameters));
    return history;
  }
} // namespace SlipStep::Testing

#endif
