#ifndef slipstep_diagnosis_improved_case_h
#define slipstep_diagnosis_improved_case_h

#include <slipstep/diagnosis/comparison.h>
#include <slipstep/diagnosis/diagnosis.h>

#include <filesystem>
#include <set>
#include <string>

namespace SlipStep
{
  /// The case with a model's effects and fitted values, which `run` and `point`
  /// take as it is.
  Parameters case_of(const Parameters &start, const Model &model);

  /// Its text for a file in @p folder, with the intervals of the parameters as
  /// comments behind their values.
  /// @param head lines of comment at the beginning
  std::string case_text(const Parameters            &the_case,
                        const std::filesystem::path &folder,
                        const std::set<std::string> &inactive_sections,
                        const std::vector<DiagnosedParameter> &parameters = {},
                        const std::vector<std::string>        &head       = {});
} // namespace SlipStep

#endif
