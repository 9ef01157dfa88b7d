// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_study_report_h
#define slipstep_report_study_report_h

#include <slipstep/report/figure.h>
#include <slipstep/experiment/study_results.h>
#include <slipstep/report/text_table.h>

#include <filesystem>
#include <string>
#include <vector>

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

  /// Error against unknowns and against processor time, a picture per
  /// quantity, with data and scripts in @p folder.
  std::vector<Picture> draw_study(const std::filesystem::path   &folder,
                                  const std::vector<StudyCurve> &curves,
                                  std::vector<std::string>      &warnings);

  std::string name_with_unit(const StudyCurve &curve);

  /// One run: its label, unknowns, steps, CPU time, value, error, order.
  TableLine run_line(const StudyPoint &point);

  /// What was found, one line per curve: quantity, runs, reference, error of
  /// the finest run, order, cheapest run for 1 %.
  std::vector<TableLine> study_summary(const std::vector<StudyCurve> &curves);

  /// The part of report.html about a study.
  std::string study_html(const std::vector<StudyCurve> &curves,
                         const std::vector<Picture>    &pictures);
} // namespace SlipStep

#endif
