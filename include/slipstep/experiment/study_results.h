#ifndef slipstep_experiment_study_results_h
#define slipstep_experiment_study_results_h

#include <slipstep/experiment/refinement_study.h>
#include <slipstep/experiment/report_figures.h>
#include <slipstep/experiment/summary.h>

#include <filesystem>
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
    /// reference is 0; NaN for a failed run and for the reference itself.
    double error = QuantityOfInterest::undefined;
    /// Order of the error since the run before, in terms of the cell size, of
    /// the mean one on adaptive meshes (n^(-1/dim) for n unknowns), or of the
    /// time step.
    double order = QuantityOfInterest::undefined;
  };

  /// Convergence of one quantity along one sequence.
  struct StudyCurve
  {
    StudySequence::Kind kind;
    std::string         sequence;
    std::string         quantity;
    std::string         unit;
    double              reference = QuantityOfInterest::undefined;
    std::string         reference_name; ///< where it comes from
    /// Order of the Richardson extrapolation, NaN without one.
    double                  order     = QuantityOfInterest::undefined;
    unsigned int            dimension = 3;
    std::vector<StudyPoint> points;
  };

  /// Compare the runs of a study, whose folders are in @p output.
  ///
  /// Richardson's reference of the meshes comes from the uniform sequence, that
  /// of time steps from their own. If the last three values do not converge,
  /// the finest run that finished takes its place, and its name says so.
  std::vector<StudyCurve> study_curves(const RefinementStudy       &study,
                                       const std::filesystem::path &output);

  /// deal.II's ConvergenceTable of every curve, one below the other, with the
  /// reasons of runs that failed and the energy that is missing.
  std::string study_tables(const std::vector<StudyCurve> &curves);

  /// Write refinement.csv: one row per quantity and run.
  /// @throws RunError if the disk refuses
  void write_study_csv(const std::filesystem::path   &file,
                       const std::vector<StudyCurve> &curves);

  /// Error against unknowns and against processor time, a picture per
  /// quantity, with data and scripts in @p folder.
  std::vector<Picture> draw_study(const std::filesystem::path   &folder,
                                  const std::vector<StudyCurve> &curves,
                                  std::vector<std::string>      &warnings);

  /// The part of report.html about a study.
  std::string study_html(const std::vector<StudyCurve> &curves,
                         const std::vector<Picture>    &pictures);
} // namespace SlipStep

#endif
