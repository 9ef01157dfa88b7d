// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_study_report_h
#define slipstep_report_study_report_h

#include <slipstep/experiment/study_results.h>
#include <slipstep/report/page.h>

namespace SlipStep
{
  /// A table of what was found, one row per curve; then one table per curve,
  /// the reasons of runs that failed, and what is doubtful about others.
  std::string study_tables(const std::vector<StudyCurve> &curves);

  /// Write refinement.csv: one row per quantity and run.
  /// @throws RunError if the disk refuses
  void write_study_csv(const std::filesystem::path   &file,
                       const std::vector<StudyCurve> &curves);

  /// Write refinement.json: the same for programs, with the cheapest run for
  /// an error of 1 % in every curve.
  /// @throws RunError if the disk refuses
  void write_study_json(const std::filesystem::path   &file,
                        const std::vector<StudyCurve> &curves);

  /// The part of report.html about a study: what was found, error against
  /// unknowns and against processor time, and all runs.
  std::string study_section(Page &page, const std::vector<StudyCurve> &curves);
} // namespace SlipStep

#endif
