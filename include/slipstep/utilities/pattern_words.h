#ifndef slipstep_utilities_pattern_words_h
#define slipstep_utilities_pattern_words_h

#include <deal.II/base/patterns.h>

#include <string>

namespace SlipStep
{
  /// What a pattern allows, in a user's words: "one of: cot, log", "a whole
  /// number from 1 to 3", "yes or no".
  std::string allowed_in_words(const dealii::Patterns::PatternBase &pattern);

  /// Why a text does not match: what is wrong with it if the pattern can tell,
  /// what is allowed, and the nearest allowed word. "" if it matches.
  std::string why_not_allowed(const dealii::Patterns::PatternBase &pattern,
                              const std::string                   &text);

  /// What the user wrote, fit for one line of a message: the middle of a long
  /// text is left out.
  std::string excerpt(const std::string &text);
} // namespace SlipStep

#endif
