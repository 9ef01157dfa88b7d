// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_diagnosis_report_h
#define slipstep_report_diagnosis_report_h

#include <slipstep/diagnosis/diagnosis.h>
#include <slipstep/report/calibration_report.h>

#include <filesystem>
#include <string>
#include <vector>

namespace SlipStep
{
  /// Write diagnosis.json.
  /// @throws RunError if the disk refuses
  void write_diagnosis_json(const std::filesystem::path &file,
                            const Parameters            &parameters,
                            const Diagnosis             &diagnosis);

  /// Write report.html with the pictures inside, and their data and scripts
  /// into `<folder>/report/`. What a reader sees first is what was wrong, what
  /// was missing and how far the gap shrank; then the evidence. Without gnuplot
  /// the curves are missing and the numbers still come.
  /// @return warnings for the user
  std::vector<std::string>
  write_diagnosis_report(const std::filesystem::path &folder,
                         const Parameters            &parameters,
                         const Diagnosis             &diagnosis);

  /// @name What a diagnosis found, in the words of screen and page
  ///@{
  /// The verdict in one sentence with its numbers.
  std::string headline(const Diagnosis &diagnosis);

  /// "a zero of the sensor, 0.1 MPa of load"
  std::string look_alike_words(const LookAlike &look_alike);

  /// The verdict in two or three words.
  std::string short_verdict(const Diagnosis &diagnosis);

  /// "if the stated noise is right": under what the verdict holds; "" if it
  /// rests on replicates and several conditions.
  std::string reservation(const Diagnosis &diagnosis);

  /// "no effect of the catalogue explains", or of those asked for.
  std::string nothing_explains(const Diagnosis &diagnosis);

  /// What is named, each with its rivals if it has any: "softening, and
  /// overstress or stribeck"
  std::string names_text(const Diagnosis &diagnosis);

  /// A chance; "≤ 0.001" where so many draws tell none that is smaller.
  std::string chance_text(const double p, const unsigned int n_draws);

  /// The same of a candidate; "–" if it was not tried.
  std::string chance_text(const CandidateResult &candidate,
                          const unsigned int     n_draws);

  /// "speed 0.1 … 10 mm/s"
  std::string range_text(const Localisation &where);

  /// "at speeds of 0.5 … 1.7 mm/s": the same in words.
  std::string place_words(const Localisation &where);

  /// "higher", "lower" or "different" than simulated.
  std::string sign_text(const Localisation &where);

  /// A value of the parameter with as many digits as its interval leaves
  /// meaning, without unit; "–" if there is none.
  std::string value_text(const DiagnosedParameter &parameter,
                         const double              value);

  /// The path without what all of them begin with: "overstress/Viscosity".
  std::string label_text(const DiagnosedParameter &parameter);

  /// "0.041 … 0.049"; "≥ 0.041", "≤ 0.049" or "open" where it has no end.
  std::string interval_text(const DiagnosedParameter &parameter);

  /// "2 … 16", the bounds at which a parameter may be, or that it is a
  /// condition of the law.
  std::string bounds_text(const DiagnosedParameter &parameter);

  /// What the intervals do not hold, as a sentence; "" if nothing remains.
  std::string interval_reservation(const Diagnosis &diagnosis);

  /// Test, gap of the block before and after, of the point before and after,
  /// difference of block and point.
  TableLine element_line(const ElementCheck &check);
  ///@}

  /// The parameters of all effects that are named or stand in for one.
  std::vector<DiagnosedParameter> named_parameters(const Diagnosis &diagnosis);

  /// Whether something was added to the starting model, so that there is an
  /// after.
  bool has_after(const Diagnosis &diagnosis);

  /// Whether what is named explains hardly any of what is beyond the noise.
  bool is_worth_little(const Diagnosis &diagnosis);

  /// What the terminal shows at the end: verdict, gap, where, the candidates,
  /// parameters named, how far the gap shrank, the next test.
  std::string diagnosis_table(const Diagnosis &diagnosis);
} // namespace SlipStep

#endif
