// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_diagnosis_sections_h
#define slipstep_report_diagnosis_sections_h

#include <slipstep/diagnosis/diagnosis.h>
#include <slipstep/report/page.h>

namespace SlipStep
{
  /// @name Sections of the report of a diagnosis as HTML; "" where there is
  /// nothing to show.
  ///@{
  /// Friction as measured, before and after with the noise, one picture per
  /// condition; and the differences by phases.
  std::string draw_tests(Page &page, const Diagnosis &diagnosis);

  /// The gap of every test, and where the difference is, in numbers.
  std::string tests_section(const Diagnosis &diagnosis);

  /// What is left over along each covariate, with what the effects would
  /// change, and what the formulas of named effects lack.
  std::string draw_covariates(Page &page, const Diagnosis &diagnosis);

  /// Where what remains is, if the names leave something; all effects that were
  /// tried and those that could not be; the steps down to the noise.
  std::string candidates_section(const Diagnosis &diagnosis);

  /// Increase of the objective along each parameter that was named.
  std::string draw_named_profiles(Page &page, const Diagnosis &diagnosis);

  /// Parameters; the block before and after, with the contact point.
  std::string parameters_section(Page &page, const Diagnosis &diagnosis);
  ///@}

  /// The gap at a step of the way, as a share of friction.
  struct GapBar
  {
    std::string label;
    double      value;
    std::string colour;
  };

  /// A bar for each step, with what the step took away, and a mark at the
  /// noise.
  std::string gap_bars(const std::vector<GapBar> &bars,
                       const double               noise,
                       const double               largest);
} // namespace SlipStep

#endif
