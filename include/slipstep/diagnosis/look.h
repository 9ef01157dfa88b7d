#ifndef slipstep_diagnosis_look_h
#define slipstep_diagnosis_look_h

#include <slipstep/diagnosis/candidates.h>
#include <slipstep/diagnosis/comparison.h>
#include <slipstep/diagnosis/covariates.h>
#include <slipstep/diagnosis/score.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace SlipStep
{
  /// What a search looks at: the tests, their noise, and the rules.
  struct Workspace
  {
    Parameters                start;
    std::vector<CampaignTest> tests;
    Comparison                comparison;
    NoiseEstimate             noise;
    Covariates                covariates;
    TestedRange               range;
    RowMatrix                 null_draws;
    double                    level        = 0.04;
    unsigned int              most_effects = 4;
    unsigned int              n_refits     = 0; ///< counted here
    /// Told what is being done.
    std::function<void(const std::string &)> progress;
  };

  /// A candidate as seen from a model.
  struct CandidateView
  {
    /// The best direction of one of its formulas.
    struct Way
    {
      Direction direction;
      Score     score;
    };

    Candidate candidate;
    /// Best first; none if it was not tried, could not be simulated, or
    /// changes nothing.
    std::vector<Way> ways;
    Score            score;   ///< of the best
    std::string      failure; ///< why it could not be simulated
    /// Chance of such a score among all candidates.
    double p = 1.;
    /// Smallest greatest change of friction that would have been seen at five
    /// standard deviations, as a share; infinite if none would.
    double minimum_detectable = std::numeric_limits<double>::infinity();
  };

  /// The catalogue as seen from a model, best score first.
  struct View
  {
    std::vector<CandidateView> candidates;
    std::vector<Direction>     directions;
  };

  View look(const Workspace &workspace, const Model &model);

  /// Directions of the covariates, and of the candidates seen from a model.
  std::vector<Direction> smooth_directions(const Workspace &workspace,
                                           const View      &view);

  /// Whether a model leaves more than noise, with what is seen from it.
  GapTest
  test_gap(const Workspace &workspace, const Model &model, const View &view);

  /// The parts of a model and one more.
  std::vector<Part> with_part(const Model      &model,
                              const Candidate  &candidate,
                              const std::size_t formula);

  /// Values of both; where both have one, that of the second.
  Values merged(Values values, const Values &others);
} // namespace SlipStep

#endif
