// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_experiment_refinement_study_h
#define slipstep_experiment_refinement_study_h

#include <slipstep/experiment/summary.h>
#include <slipstep/utilities/parameters.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace SlipStep
{
  /// One run of a study: the case with a mesh or a time step of its own.
  struct StudyRun
  {
    std::string label;  ///< "uniform 2", "equal steps 100"
    std::string folder; ///< the same without blanks
    /// Pairs (path, value) in which it differs from the case.
    std::vector<std::pair<std::string, std::string>> settings;
  };

  /// Runs of increasing fineness.
  struct StudySequence
  {
    enum class Kind
    {
      uniform,
      adaptive,
      time_step
    };

    Kind                  kind;
    std::string           name; ///< "uniform", "adaptive", "equal steps"
    std::vector<StudyRun> runs;
  };

  /// `slipstep refine`: which runs section "Refinement study" asks for.
  struct RefinementStudy
  {
    static void declare_parameters(Parameters &parameters);

    /// @throws InputError if there is nothing to study, or no reference
    explicit RefinementStudy(const Parameters &parameters);

    /// All runs, references included, each once.
    std::vector<StudyRun> runs() const;

    std::vector<StudySequence> sequences;

    /// The finer runs that meshes and time steps are compared with, or none
    /// (label "").
    StudyRun mesh_reference, time_reference;
  };


  /// The complete parameters of a run of a study.
  Parameters parameters_of(const StudyRun &run, const Parameters &parameters);
} // namespace SlipStep

#endif
