// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_candidate_scores_h
#define slipstep_diagnosis_candidate_scores_h

#include <slipstep/diagnosis/score_test.h>
#include <slipstep/diagnosis/workspace.h>

#include <limits>
#include <string>
#include <vector>

namespace SlipStep
{
  /// A candidate as seen from a model.
  struct CandidateView
  {
    /// The best direction of one of its formulas.
    struct Way
    {
      Direction direction;
      Score     score;
    };

    Candidate   candidate;
    std::size_t number = 0; ///< as directions have it
    /// Best first; none if it was not tried, could not be simulated, or
    /// changes nothing.
    std::vector<Way> ways;
    Score            score;           ///< of the best
    std::string      failure;         ///< why it could not be simulated, alone
    bool             is_late = false; ///< not tried for want of time
    /// That is since friction would fall with speed, and sliding jump. There
    /// are ways if another effect may hold it: it is seen beside that only.
    bool is_unstable = false;
    /// Chance of such a score among all candidates.
    double p = 1.;
    /// Smallest greatest change of friction that would have been seen at five
    /// standard deviations, as a share; infinite if none would.
    double minimum_detectable = std::numeric_limits<double>::infinity();
  };

  /// The catalogue as seen from a model, best score first.
  struct View
  {
    std::vector<CandidateView>   candidates;
    DirectionSet                 set;   ///< all their directions
    std::vector<ScoreTest::Pair> pairs; ///< of the directions, best first

    /// The candidate of a direction.
    const CandidateView &of(const Direction &direction) const;
  };

  /// When directions of two candidates are seen at once: one that is told
  /// beside its partner only is paired with that, and with nothing else.
  Pairing pairing(const Candidate &a, const Candidate &b);

  View score_candidates(const Workspace &workspace, const Model &model);

  /// These and one more.
  std::vector<Part> with_part(std::vector<Part> parts,
                              const Candidate  &candidate,
                              const std::size_t formula);

  /// Values of both; where both have one, that of the second.
  Values merged(Values values, const Values &others);
} // namespace SlipStep

#endif
