// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_experiment_programme_text_h
#define slipstep_experiment_programme_text_h

#include <string>
#include <vector>

namespace SlipStep
{
  /// A piece of the text of a programme and where it begins.
  struct Piece
  {
    std::string text;
    std::size_t column = 0;

    /// The column behind it.
    std::size_t end() const
    {
      return column + text.size();
    }
  };

  /// What separates statements, or holds those of a repetition together.
  constexpr const char *borders = ";{}";

  /// What separates words.
  constexpr const char *blanks = " \t\r\n";

  /// A piece without the blanks around it.
  Piece trim(const Piece &piece);

  /// The words of a piece, in their order.
  std::vector<Piece> words(const Piece &piece);
} // namespace SlipStep

#endif
