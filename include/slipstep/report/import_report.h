// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_import_report_h
#define slipstep_report_import_report_h

#include <slipstep/measured_data/import_proposal.h>
#include <slipstep/measured_data/measured_test.h>

#include <filesystem>
#include <string>
#include <vector>

namespace SlipStep
{
  /// Each line that was guessed or is open, for the terminal.
  std::string import_table(const ImportProposal &proposal);

  /// Write report.html: what was understood of the columns of a record, why,
  /// and the picture of it.
  /// @param map the file that the proposal was written to
  /// @param tests what the map makes of the record; none while it is incomplete
  /// @param problem why there are none, if the map is complete
  /// @return warnings for the user
  std::vector<std::string>
  write_import_report(const std::filesystem::path     &folder,
                      const ImportProposal            &proposal,
                      const std::filesystem::path     &map,
                      const std::vector<MeasuredTest> &tests,
                      const std::string               &problem);
} // namespace SlipStep

#endif
