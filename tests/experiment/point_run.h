// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_experiment_point_run_h
#define tests_experiment_point_run_h

#include <slipstep/experiment/point_driver.h>
#include <slipstep/utilities/text.h>

#include <vector>

#include "../settings.h"

namespace SlipStep::Testing
{
  /// The parameters of one contact point.
  inline Parameters point_parameters(const Settings &settings)
  {
    Parameters parameters;
    declare_loading_parameters(parameters);
    FrictionLaw::declare_parameters(parameters);
    set_all(settings, parameters);
    return parameters;
  }

  /// The rows of a run on one contact point.
  inline std::vector<HistoryRow> point_history(const Parameters &parameters)
  {
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

  /// @param tolerance instead of the one of the case
  inline std::vector<HistoryRow> point_history(Parameters   parameters,
                                               const double tolerance)
  {
    parameters.set("Time stepping/Tolerance", exact_text(tolerance), "test");
    return point_history(parameters);
  }
} // namespace SlipStep::Testing

#endif
