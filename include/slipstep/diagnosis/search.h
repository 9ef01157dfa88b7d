// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_search_h
#define slipstep_diagnosis_search_h

#include <slipstep/diagnosis/additions.h>

#include <string>
#include <vector>

namespace SlipStep
{
  /// Whether an addition lowers the fitted and the left-out differences enough.
  /// @param left_out_gain NaN if it does not tell
  /// @param is_told_by_one of several conditions alone, so that it cannot
  /// @param n effects that are added
  bool is_needed(const double      cost,
                 const double      left_out_gain,
                 const bool        is_told_by_one,
                 const std::size_t n = 1);

  /// The same of two models.
  bool is_needed(const Workspace  &workspace,
                 const Model      &less,
                 const Model      &more,
                 const std::size_t n = 1);

  /// A rival of a named effect: with it in the place of the name the tests are
  /// explained as well.
  struct Rival
  {
    std::string name; ///< of the rival
    std::string instead_of;
    double      distance = 0.; ///< penalised objective above the winner's
    Model       model;
  };

  /// What a search came to.
  struct SearchResult
  {
    Model              model;
    std::vector<Rival> rivals;
    /// Cost of removing each part, and what left-out conditions gain by it.
    std::vector<double> costs, left_out_gains;
    /// Without which of the conditions the others do not ask for it.
    std::vector<std::vector<std::size_t>> told_by;
    FirstFits                             first_fits;
  };

  /// Of what two searches came to, the one that explains the tests better and
  /// does not end at a bound; where that does not tell, the one that predicts
  /// conditions left out better; where neither tells, the names of both are
  /// rivals.
  /// @param lead of the other one on conditions left out, see left_out_lead()
  SearchResult better_of(const SearchResult &first,
                         const SearchResult &other,
                         const double        lead);

  /// Add effects as long as they are needed, take away those that are not, and
  /// exchange those for which another does better. When time is over, what was
  /// proven until then.
  /// @param first the starting model, or what a search has found, fitted
  SearchResult search(Workspace &workspace, const Model &first);
} // namespace SlipStep

#endif
