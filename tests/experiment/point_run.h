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

  /// Run one contact point.
  /// @param[out] history its rows, with those before a failure
  inline StepControl run_point(const Parameters        &parameters,
                               std::vector<HistoryRow> &history)
  {
    const FrictionLaw law(parameters);
    const Programme   programme = parse_programme(parameters);
    return drive_point(
      law,
      programme,
      StepControl(parameters, programme, law),
      [&](const HistoryRow &row) { history.push_back(row); },
      Machine(parameters));
  }

  /// The rows of a run on one contact point.
  inline std::vector<HistoryRow> point_history(const Parameters &parameters)
  {
    std::vector<HistoryRow> history;
    run_point(parameters, history);
    return history;
  }

  /// The last row at or before a time.
  inline const HistoryRow &row_at(const std::vector<HistoryRow> &rows,
                                  const double                   time)
  {
    std::size_t i = rows.size() - 1;
    while (i > 0 && rows[i].time > time + 1e-9)
      --i;
    return rows[i];
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
