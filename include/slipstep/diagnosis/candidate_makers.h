#ifndef slipstep_diagnosis_candidate_makers_h
#define slipstep_diagnosis_candidate_makers_h

#include <slipstep/diagnosis/candidates.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace SlipStep
{
  /// What the makers of candidates look at.
  struct Circumstances
  {
    const Parameters  &parameters;
    const TestedRange &range;

    bool has(const std::string &effect) const;

    bool has_flow_rule() const;

    bool is_fitted(const std::string &path) const;

    /// A key of a formula that stays, in base units.
    void
    set(Formula &formula, const std::string &path, const double value) const;

    double number(const std::string &path) const;

    /// Typical friction, which is no coefficient of the law.
    double friction() const;
  };

  /// It cannot be tried, since the model has it or the like.
  void leave_to_model(Candidate &candidate, const std::string &why);

  using Maker = std::function<Candidate(const Circumstances &)>;

  /// The catalogue: how every effect is tried.
  const std::vector<std::pair<std::string, Maker>> &candidate_makers();
} // namespace SlipStep

#endif
