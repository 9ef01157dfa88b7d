// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_diagnosis_h
#define slipstep_diagnosis_diagnosis_h

#include <slipstep/calibration/calibration.h>
#include <slipstep/diagnosis/covariate.h>
#include <slipstep/diagnosis/look_alike.h>
#include <slipstep/utilities/parameters.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace SlipStep
{
  /// What a diagnosis may come to.
  enum class Verdict
  {
    named,       ///< these effects are missing
    ambiguous,   ///< something is, and several effects explain it as well
    unnamed,     ///< something is, and no effect of the catalogue explains it
    no_gap,      ///< nothing is missing as far as these tests can tell
    not_testable ///< these tests cannot tell
  };

  std::string name_of(const Verdict verdict);

  /// A component of the noise.
  struct NoiseComponent
  {
    std::string name;
    double      value = 0.;
    std::string unit;       ///< "of friction", "of the rows' own noise"
    std::string source;     ///< "replicates", "stated" or "spectra"
    double      lower = 0.; ///< 95 % interval
    double      upper = 0.;
  };

  /// A parameter fitted by the diagnosis. Values are in its unit; parameters of
  /// the starting model have an interval from the curvature, and no profile.
  struct DiagnosedParameter : ProfileInterval
  {
    std::string path;
    std::string name;
    std::string unit;
    double before = std::numeric_limits<double>::quiet_NaN(); ///< of the start
    bool   is_at_bound = false;
    /// Bounds of the fit.
    double      least = std::numeric_limits<double>::quiet_NaN();
    double      most  = std::numeric_limits<double>::quiet_NaN();
    std::string effect; ///< "" for a parameter of the starting model
  };

  /// Whether anything is missing.
  struct Gap
  {
    double p            = 1.; ///< of all four, Bonferroni
    double p_smooth     = 1.; ///< largest score of covariates and candidates
    double p_together   = 1.; ///< smooth and waves at once
    double p_replicates = 1.; ///< what replicates have in common
    double p_track      = 1.; ///< waves along the track
    /// Of the objective: what a model with anything at all could explain,
    /// beyond chance.
    double excess = 0.;
  };

  /// Where the calibrated starting model disagrees.
  struct Localisation
  {
    std::string covariate; ///< "speed"
    std::string unit;
    double      share = 0.; ///< of the excess that it explains alone
    double      from  = 0.; ///< where the difference is felt most
    double      to    = 0.;
    int         sign  = 0; ///< 1: measured friction is higher there; 0: unclear
    std::vector<std::string> phases, tests; ///< most of it, largest first
    /// Of a wave, which has no range.
    double wavelength = 0.;
  };

  /// What became of an effect of the catalogue, in the order of the table.
  enum class Standing
  {
    named,
    rival,
    not_needed, ///< significant by itself, but with the names no more
    not_enough, ///< significant, but too little or too unsure for a name
    undecided,  ///< significant, but time was over before it was judged
    rejected,
    not_tried, ///< for want of time
    not_simulated,
    not_testable,
    in_the_model
  };

  /// "not needed"
  std::string name_of(const Standing standing);

  /// Whether the tests say nothing of it: it could not be tried.
  bool was_left_out(const Standing standing);

  /// An effect of the catalogue.
  struct CandidateResult
  {
    std::string name;
    std::string signature;
    Standing    standing = Standing::rejected;
    double      score    = 0.; ///< standard deviations
    double      p        = 1.; ///< family-wise
    /// Of the objective when it is added to the starting model; NaN if it was
    /// not fitted.
    double gain          = std::numeric_limits<double>::quiet_NaN();
    double left_out_gain = std::numeric_limits<double>::quiet_NaN();
    /// Smallest change of friction that would have been seen, as a share.
    double      minimum_detectable = std::numeric_limits<double>::infinity();
    bool        is_testable        = false;
    std::string why;           ///< it was not tried or cannot be tested
    std::string cheapest_test; ///< that would make it testable
    std::vector<DiagnosedParameter> parameters; ///< of those named
  };

  /// An effect that does as well as one that is named.
  struct RivalEffect
  {
    std::string name;
    std::string instead_of; ///< "" if that is not known
  };

  /// Something that hinders the verdict.
  struct Outlier
  {
    std::string test;
    std::string words;
    /// It is not the test, but some of its numbers.
    bool is_of_rows = false;
    /// It has the rows of another test.
    bool is_copy = false;
  };

  /// One test with the friction before and after. Values at the rows compared;
  /// of two axes along x, then along y.
  struct DiagnosedTest
  {
    std::string name, condition, file;
    double      level      = 1.; ///< typical friction
    bool        is_outlier = false;
    double      start_time = 0.; ///< of the first row compared in the file [s]
    std::vector<double> time;    ///< since then [s]
    std::vector<double> displacement; ///< [mm]
    std::vector<double> measured, before, after;
    std::vector<double> measured_y, before_y, after_y;
    /// Of the angle of the one axis that a test without measured_y has.
    double             cosine = 1., sine = 0.;
    std::vector<Phase> phase;
    double noise = 0.; ///< standard deviation of a row from all noise
    /// Root mean square of measured minus simulated, as shares of level.
    double rms_before = 0., rms_after = 0.;
    double left_out_before = 0., left_out_after = 0.;
  };

  /// The gap before and after, as shares of friction.
  struct Shrink
  {
    double fitted_before = 0., fitted_after = 0.;
    double left_out_before = 0., left_out_after = 0.;
    double noise_floor = 0.;
    /// The same in terms of what noise does not explain: root of the squares
    /// above the floor.
    double systematic_before = 0., systematic_after = 0.;

    /// In what whole tests differ by, which weighs little in a fit, a model
    /// that is met better may be farther off.
    bool grows() const
    {
      return fitted_after > 1.005 * fitted_before;
    }

    /// Whether conditions left out of the fit keep most of what noise does not
    /// explain, while those that are fitted do not. Share of it above which it
    /// is hardly less.
    static constexpr double hardly_less = 0.8;
    bool                    hardly_predicts() const;

    /// Whether less is left than what was taken for noise: waves that rows
    /// share look like that until they have a name.
    bool is_noise_overrated() const
    {
      return fitted_after < fitted_before && fitted_after < 0.8 * noise_floor;
    }
  };

  /// A step of the way from the starting model down to the noise.
  struct GapStep
  {
    std::string label;
    double      rms       = 0.; ///< share of friction
    double      objective = 0.;
  };

  /// What is left over along one covariate, before, with what the effects
  /// would change there.
  struct CovariatePanel
  {
    std::string         covariate, unit;
    bool                is_logarithmic = false;
    std::vector<double> x;
    std::vector<double> residual; ///< share of friction, means of bins
    std::vector<double> error;    ///< their standard deviation
    /// Names with changes in the same bins; winners first.
    std::vector<std::pair<std::string, std::vector<double>>> signatures;
  };

  /// A named effect the formula of which is not quite right: a free factor
  /// along its own covariate makes up for that.
  struct CompletedFormula
  {
    std::string effect;
    std::string covariate; ///< of effect expression
    std::string formula;   ///< the factor
    double      gain = 0.; ///< of the objective
    /// What the formula alone leaves, and what the factor changes.
    CovariatePanel panel;
  };

  /// A free factor along one covariate, cause unknown.
  struct Correction
  {
    std::string covariate, formula; ///< as effect expression has them
    double      share = 0.;         ///< of the excess that it takes away
  };

  struct NextTest
  {
    std::string words;     ///< "sliding at 0.01 mm/min"; empty for none
    std::string programme; ///< as Loading/Programme takes it
    std::vector<std::string> separates; ///< names
    double distance = 0.; ///< of the predictions, standard deviations

    /// From which distance on a test tells.
    static constexpr double told_apart = 5.;

    bool tells() const
    {
      return distance >= told_apart;
    }
  };

  /// A simulation of the block of one test.
  struct ElementCheck
  {
    std::string         test;
    std::vector<double> displacement, measured;
    std::vector<double> block_before, block_after, point_before, point_after;
    /// Root mean squares, shares of friction.
    double      block_gap_before = 0., block_gap_after = 0.;
    double      point_gap_before = 0., point_gap_after = 0.;
    double      difference = 0.; ///< of block and point, after
    std::string remark;          ///< why there is none
  };

  /// Everything that `slipstep diagnose` found.
  struct Diagnosis
  {
    std::uint64_t seed       = 0;
    double        level      = 0.;
    double        confidence = 0.95;

    // ---- data
    std::size_t                n_conditions = 0, n_replicate_pairs = 0;
    std::size_t                n_samples = 0;
    std::string                data_hash;
    std::vector<DiagnosedTest> tests;
    std::vector<Outlier>       outliers;

    // ---- starting model and noise
    std::vector<std::string>        start_effects;
    std::vector<DiagnosedParameter> start_parameters;
    std::vector<NoiseComponent>     noise;

    // ---- gap
    bool                      has_gap = false;
    Gap                       gap;
    std::vector<Localisation> where; ///< most first

    /// What is no missing effect and would explain as much.
    std::optional<LookAlike> look_alike;

    // ---- verdict
    Verdict                  verdict = Verdict::no_gap;
    std::vector<std::string> effects; ///< strongest first
    std::vector<RivalEffect> rivals;
    /// Names that the tests would not ask for without one that has no
    /// replicate, and that test.
    std::vector<std::pair<std::string, std::string>> lone_tests;
    double                                           explained_share = 0.;
    double                                           remainder_p     = 1.;
    /// Names that explained too little and were taken back.
    std::vector<std::string> withdrawn;
    /// Whether names explain what is there but for a remainder, and where it
    /// is.
    bool                          is_incomplete = false;
    std::vector<Localisation>     remains;
    std::vector<CompletedFormula> completed;
    std::vector<CandidateResult>  candidates; ///< best first
    std::optional<Correction>     correction; ///< of what has no name

    // ---- the way down
    Shrink                          shrink;
    std::vector<DiagnosedParameter> parameters; ///< of the model in the end
    std::vector<GapStep>            steps;
    std::vector<CovariatePanel>     panels;
    NextTest                        next_test;
    std::vector<ElementCheck>       element_checks;
    std::string improved_case; ///< file, "" if none is written

    // ---- honesty
    unsigned int n_candidates = 0; ///< without those in the model
    /// Whether the case asks for some candidates only.
    bool         is_restricted = false;
    unsigned int n_refits      = 0;
    unsigned int n_draws       = 0;
    /// Whether Diagnosis/Most time was over, or Ctrl-C came, before all was
    /// tried.
    bool                     is_cut_short = false, was_stopped = false;
    std::vector<std::string> would_overturn; ///< sentences
    std::vector<std::string> warnings;
    double                   wall_time = 0.; ///< [s]
    double                   cpu_time  = 0.; ///< [s]
  };
} // namespace SlipStep

#endif
