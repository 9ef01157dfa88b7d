// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_confounding_h
#define slipstep_diagnosis_confounding_h

#include <slipstep/diagnosis/search.h>

namespace SlipStep
{
  /// Effects that go with the other one of pressure and speed, by each of which
  /// alone the tests are explained nearly as well as by the only name, though
  /// they are no rivals yet: where both conditions change together, nothing but
  /// formulas tells these apart. The best first; none where there are several
  /// names or none.
  std::vector<Rival> confounded_effects(const Workspace    &workspace,
                                        const Model        &base,
                                        const SearchResult &found);

  /// A sentence for that.
  std::string confounding_words(const std::string        &name,
                                const std::vector<Rival> &confounded);
} // namespace SlipStep

#endif
