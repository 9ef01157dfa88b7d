// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_diagnosis_sections_h
#define slipstep_report_diagnosis_sections_h

#include <slipstep/diagnosis/diagnosis.h>
#include <slipstep/report/page.h>

#include <string>

namespace SlipStep
{
  /// @name Sections of the report of a diagnosis as HTML; "" where there is
  /// nothing to show.
  ///@{
  /// Tests by phases, before and after.
  std::string heat_map_section(const Diagnosis &diagnosis);

  /// The gap of every test.
  std::string tests_section(const Diagnosis &diagnosis);

  /// Where the difference is, in numbers.
  std::string places_section(const Diagnosis &diagnosis);

  /// Where what remains is, if the names leave something.
  std::string remains_section(const Diagnosis &diagnosis);

  /// All effects that were tried and those that could not be.
  std::string candidates_section(const Diagnosis &diagnosis);

  /// The steps from the starting model down to the noise.
  std::string steps_section(const Diagnosis &diagnosis);

  std::string parameters_section(const Diagnosis &diagnosis);

  /// The block before and after, with the contact point.
  std::string elements_section(Page &page, const Diagnosis &diagnosis);

  /// Friction as measured, before and after with the noise, one picture per
  /// condition.
  std::string draw_tests(Page &page, const Diagnosis &diagnosis);

  /// What is left over along each covariate, with what the effects would
  /// change.
  std::string draw_covariates(Page &page, const Diagnosis &diagnosis);

  /// What the formulas of named effects lack along their covariates.
  std::string draw_completed_formulas(Page &page, const Diagnosis &diagnosis);

  /// Increase of the objective along each parameter that was named.
  std::string draw_named_profiles(Page &page, const Diagnosis &diagnosis);
  ///@}

  /// A bar of @p value with what it was before it, and a mark at the noise.
  /// All as shares of friction.
  /// @param colour of the bar
  std::string gap_bar(const std::string &label,
                      const double       value,
                      const double       before,
                      const double       noise,
                      const double       largest,
                      const std::string &colour);
} // namespace SlipStep

#endif
