// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_pattern_words_h
#define slipstep_utilities_pattern_words_h

#include <deal.II/base/patterns.h>

#include <memory>
#include <string>
#include <vector>

namespace SlipStep
{
  /// The words of which a Selection or Bool allows one; none of others.
  std::vector<std::string>
  choices_of(const dealii::Patterns::PatternBase &pattern);

  /// What a pattern allows, in a user's words: "one of: cot, log", "a whole
  /// number from 1 to 3", "yes or no".
  std::string allowed_in_words(const dealii::Patterns::PatternBase &pattern);

  /// Why a text does not match: what is wrong with it if the pattern can tell,
  /// what is allowed, and the nearest allowed word. "" if it matches.
  std::string why_not_allowed(const dealii::Patterns::PatternBase &pattern,
                              const std::string                   &text);

  /// The text with words that a pattern knows in the capitals in which it
  /// knows them: "Multigrid" is multigrid. Units are left as they are.
  std::string as_meant(const dealii::Patterns::PatternBase &pattern,
                       const std::string                   &text);

  /// Any text, in which capitals do not matter for some words.
  class AnythingWithWords : public dealii::Patterns::Anything
  {
  public:
    explicit AnythingWithWords(const std::vector<std::string> &words);

    virtual std::unique_ptr<dealii::Patterns::PatternBase>
    clone() const override;

    const std::vector<std::string> words;
  };
} // namespace SlipStep

#endif
