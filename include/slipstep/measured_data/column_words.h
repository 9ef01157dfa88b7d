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
    bool                     is_along_axis; ///< of several, there is one each
  };

  /// Those of all keys that a map needs, in English and German.
  const std::vector<KeyWords> &key_words();

  /// Whether a name has one of these words in it.
  bool has_word(const std::string &name, const std::vector<std::string> &words);

  /// Of a shear stress.
  const std::vector<std::string> &shear_words();

  /// Of what was ordered, which is not what was.
  const std::vector<std::string> &ordered_words();

  /// Whether a load or a stress is called so: it is it, whatever others are
  /// called.
  bool is_called_normal(const std::string &name);

  /// A name without what only tells which of several it is; of "force x", "fx".
  std::string label_of(const std::string &name);

  /// 'x', 'y' or 'z', if a name says so: "f_z", "position y"; else 0.
  char axis_of(const std::string &name);

  /// What a mass weighs in, "kgf" of "kg"; of other units "".
  std::string unit_of_weight(const std::string &unit);

  /// Name and unit of a heading, in small letters with _ for blanks.
  void
  split_name(const std::string &heading, std::string &name, std::string &unit);
} // namespace SlipStep

#endif
