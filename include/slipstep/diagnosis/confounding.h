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

  /// Effects of a model that go with pressure or with speed.
  struct EffectsAlong
  {
    std::string              covariate;
    std::vector<std::string> names;
    /// Of their formulas and the coefficient.
    std::size_t n_numbers = 1;
    /// Values of the covariate that tests were made at.
    std::size_t n_levels = 0;
  };

  std::vector<EffectsAlong> effects_along_conditions(const Workspace &workspace,
                                                     const Model     &model);

  /// Whether several effects have more numbers than there are levels, so that
  /// they would fit any friction at these. Two that one needs the other for, as
  /// stribeck does overstress, are allowed as long as they are all.
  bool fits_any_friction(const Workspace &workspace, const Model &model);

  /// A sentence for what is confounded.
  std::string confounding_words(const std::string        &name,
                                const std::vector<Rival> &confounded);
} // namespace SlipStep

#endif
