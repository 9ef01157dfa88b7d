#ifndef slipstep_diagnosis_diagnose_h
#define slipstep_diagnosis_diagnose_h

#include <slipstep/diagnosis/diagnosis.h>
#include <slipstep/experiment/run_options.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace SlipStep
{
  /// A case to be simulated with finite elements, and where to.
  struct ElementJob
  {
    std::string           label;
    std::filesystem::path case_file;
    std::filesystem::path output;
  };

  /// Simulates cases with finite elements. A job that fails leaves no
  /// history.csv.
  using ElementRunner = std::function<void(const std::vector<ElementJob> &)>;

  /// `slipstep diagnose`: finds where the case and its measured tests disagree,
  /// names what is missing, adds it, and shows the gap shrink; with all its
  /// files.
  /// @throws InputError for anything wrong with case or tests, RunError if the
  /// starting model cannot be simulated
  void run_diagnosis(const Parameters    &parameters,
                     const RunOptions    &options,
                     const ElementRunner &element_runner);
} // namespace SlipStep

#endif
