// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_experiment_study_results_h
#define slipstep_experiment_study_results_h

#include <slipstep/experiment/refinement_study.h>
#include <slipstep/experiment/summary.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace SlipStep
{
  /// A run of a sequence, as far as one quantity of interest is concerned.
  struct StudyPoint
  {
    std::string label;
    Summary     summary; ///< status "failed" with the reason if it did
    double      value = QuantityOfInterest::undefined;
    /// |value - reference| / |reference|, or the difference itself if the
    /// reference is 0; NaN for a failed run, and where it is not above the
    /// reference's own uncertainty, for then it says nothing.
    double error = QuantityOfInterest::undefined;
    /// Difference plus uncertainty of the reference, relative alike: the error
    /// is below. NaN for a failed run, infinite if nothing is known.
    double error_bound = QuantityOfInterest::undefined;
    /// Order that the runs up to this one show by three monotone differences
    /// (shown_order()), in terms of the cell size, of the mean one on adaptive
    /// meshes (n^(-1/dim) for n unknowns), or of the time step; else NaN.
    double order = QuantityOfInterest::undefined;

    /// "0.0123", "< 0.002", "?" if nothing is known, "–" for a failed run.
    std::string error_text() const;
  };

  /// Convergence of one quantity along one sequence.
  struct StudyCurve
  {
    StudySequence::Kind kind;
    std::string         sequence;
    std::string         quantity;
    std::string         unit;
    double              reference = QuantityOfInterest::undefined;
    /// How far the reference may be from the truth, in units of the quantity;
    /// see ReferenceValue.
    double      uncertainty = QuantityOfInterest::undefined;
    std::string reference_name; ///< where it comes from
    /// The finer run that the others are compared with, if there is one.
    std::optional<Summary> reference_run;
    /// Order that the last runs show, NaN without one.
    double                  order     = QuantityOfInterest::undefined;
    unsigned int            dimension = 3;
    std::vector<StudyPoint> points;

    /// What is wrong with the runs, or doubtful, reference included: a line for
    /// each.
    std::vector<std::string> problems() const;

    /// The uncertainty relative to the reference, as the errors are.
    double relative_uncertainty() const;

    /// The finest run that finished, or nullptr.
    const StudyPoint *finest() const;

    /// Of the runs whose error, and that of all finer ones, is surely at most
    /// this (relative), the one with the least unknowns times steps, which does
    /// not depend on what else the machine does; or nullptr.
    const StudyPoint *cheapest(const double error) const;
  };

  /// Compare the runs of a study, whose folders are in @p output.
  ///
  /// Richardson's reference of the meshes comes from the uniform sequence, that
  /// of time steps from their own. If the last three values do not converge,
  /// the finest run that finished takes its place, and its name says so. How
  /// far a finer run is from the truth is found from the sequence of its own
  /// kind, or else from the one that it is compared with.
  std::vector<StudyCurve> study_curves(const RefinementStudy       &study,
                                       const std::filesystem::path &output);
} // namespace SlipStep

#endif
