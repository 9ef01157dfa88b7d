// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_search_h
#define slipstep_diagnosis_search_h

#include <slipstep/diagnosis/additions.h>
#include <slipstep/diagnosis/left_out.h>

#include <string>
#include <vector>

namespace SlipStep
{
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
    Model                 model;
    std::vector<Rival>    rivals;
    std::vector<Evidence> evidence; ///< for each part
    FirstFits             first_fits;
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
