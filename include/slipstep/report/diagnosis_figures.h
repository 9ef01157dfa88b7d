// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_diagnosis_figures_h
#define slipstep_report_diagnosis_figures_h

#include <slipstep/diagnosis/diagnosis.h>

#include <slipstep/report/gallery.h>

#include <filesystem>
#include <string>
#include <vector>

namespace SlipStep
{
  /// Friction as measured, before and after with the noise, one picture per
  /// condition.
  Gallery draw_tests(const std::filesystem::path &folder,
                     const Diagnosis             &diagnosis,
                     std::vector<std::string>    &warnings);

  /// What is left over along each covariate, with what the effects would
  /// change.
  Gallery draw_covariates(const std::filesystem::path &folder,
                          const Diagnosis             &diagnosis,
                          std::vector<std::string>    &warnings);

  /// What the formulas of named effects lack along their covariates.
  Gallery draw_completed_formulas(const std::filesystem::path &folder,
                                  const Diagnosis             &diagnosis,
                                  std::vector<std::string>    &warnings);

  /// Increase of the objective along each parameter that was named.
  Gallery draw_named_profiles(const std::filesystem::path &folder,
                              const Diagnosis             &diagnosis,
                              std::vector<std::string>    &warnings);

  /// The block before and after, with the contact point.
  Gallery draw_element_checks(const std::filesystem::path &folder,
                              const Diagnosis             &diagnosis,
                              std::vector<std::string>    &warnings);
} // namespace SlipStep

#endif
