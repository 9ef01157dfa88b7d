// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_verdict_h
#define slipstep_diagnosis_verdict_h

#include <slipstep/diagnosis/diagnosis.h>
#include <slipstep/diagnosis/gap.h>
#include <slipstep/diagnosis/search.h>

namespace SlipStep
{
  /// What the stages gap, name and prove come to.
  struct Judgement
  {
    View         view; ///< the catalogue as seen from the starting model
    GapTest      gap;
    GapTest      remainder; ///< after what was added
    SearchResult found;
    Verdict      verdict = Verdict::no_gap;
    /// Of the explainable excess.
    double explained_share = 0.;
    /// Taken back, since they explain too little.
    std::vector<std::string> withdrawn;
    /// Whether the names explain what is there, but for a remainder.
    bool is_incomplete = false;
    /// What explains the tests nearly as well by another condition, which
    /// changes with that of the only name: rivals of it if that is incomplete.
    std::vector<Rival> confounded;
    /// Rows that no model explains and that count for less, and the starting
    /// model fitted so; none if all count.
    std::vector<Eigen::Index> outlying;
    Model                     base;
    /// The names that there were while those rows counted in full, if there is
    /// no gap without.
    std::vector<std::string> named_by_outliers;
  };

  Judgement judge(Workspace &workspace, const Model &base);
} // namespace SlipStep

#endif
