// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_column_words_h
#define slipstep_measured_data_column_words_h

#include <string>
#include <vector>

namespace SlipStep
{
  /// Words in the names of columns that speak for a key, and against it.
  struct KeyWords
  {
    /// @param words, labels, against parted by blanks
    KeyWords(const std::string &key,
             const std::string &words,
             const std::string &labels,
             const std::string &against);

    std::string              key;
    std::vector<std::string> words;  ///< parts of a name
    std::vector<std::string> labels; ///< whole names
    std::vector<std::string> against;
  };

  /// Those of all keys that a map needs, in English and German.
  const std::vector<KeyWords> &key_words();

  /// Whether a name has one of these words in it.
  bool has_word(const std::string &name, const std::vector<std::string> &words);

  /// A name without what only tells which of several it is.
  std::string without_qualifier(const std::string &name);

  /// Name and unit of a heading, in small letters with _ for blanks.
  void
  split_name(const std::string &heading, std::string &name, std::string &unit);
} // namespace SlipStep

#endif
