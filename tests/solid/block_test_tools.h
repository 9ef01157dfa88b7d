// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_solid_block_test_tools_h
#define tests_solid_block_test_tools_h

#include <slipstep/solid/block.h>
#include <slipstep/commands/case.h>

#include <functional>
#include <string>
#include <vector>

#include "../experiment/point_run.h"

namespace SlipStep::Testing
{
  /// The defaults of all parameters but with Q1 elements, which are quicker on
  /// few cells; or a case file; with settings on top.
  inline Parameters make_parameters(const Settings    &settings,
                                    const std::string &case_file = "")
  {
    Parameters parameters;
    declare_all_parameters(parameters);
    if (case_file.empty())
      parameters.set("Block/Degree", "1", "test");
    else
      parameters.read(std::string(SLIPSTEP_SOURCE_DIR) + "/prm/" + case_file);
    set_all(settings, parameters);
    return parameters;
  }

  struct BlockResult
  {
    std::vector<HistoryRow>          history;
    std::vector<std::vector<double>> newton_residuals; ///< of every step
    Summary                          summary;
    double                           force_imbalance = 0.;
    std::string                      failure; ///< of a run that failed
  };

  /// Run a block without writing files.
  /// @param inspect called with the block when it is over
  template <int dim>
  BlockResult
  run_block_case(const Parameters &parameters,
                 const MPI_Comm   &communicator = MPI_COMM_SELF,
                 const std::function<void(const Block<dim> &)> &inspect = {})
  {
    const FrictionLaw     law(parameters);
    const Programme       programme = parse_programme(parameters);
    const BlockParameters block_parameters(parameters, programme);
    Block<dim>            block(block_parameters,
                     law,
                     programme,
                     StepControl(parameters, programme, law),
                     communicator,
                     Machine(parameters));
    BlockResult           result;
    try
      {
        block.run(nullptr, [&](const HistoryRow &row) {
          result.history.push_back(row);
          result.newton_residuals.push_back(block.state().newton_residuals);
        });
      }
    catch (const RunError &error)
      {
        result.failure = error.what();
      }
    block.fill(result.summary);
    summarise_history(result.history, programme, result.summary);
    result.force_imbalance = block.state().force_imbalance;
    if (inspect)
      inspect(block);
    return result;
  }

  /// Friction of a history at a time, by linear interpolation.
  inline double friction_at(const std::vector<HistoryRow> &history,
                            const double                   time)
  {
    auto after = std::lower_bound(history.begin(),
                                  history.end(),
                                  time,
                                  [](const HistoryRow &row, const double t) {
                                    return row.time < t;
                                  });
    if (after == history.begin() || after == history.end())
      return after == history.end() ? history.back().friction : after->friction;
    const auto   before = std::prev(after);
    const double weight = (time - before->time) / (after->time - before->time);
    return (1. - weight) * before->friction + weight * after->friction;
  }
} // namespace SlipStep::Testing

#endif
