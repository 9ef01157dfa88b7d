// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_text_h
#define slipstep_utilities_text_h

#include <string>
#include <vector>

namespace SlipStep
{
  /// @name Numbers as text
  ///@{

  /// Shortest decimal text that reads back as exactly the same number.
  std::string exact_text(const double value);

  /// Shortest decimal text with at most so many significant digits.
  std::string rounded_text(const double value, const unsigned int n_digits);

  /// The same; "–" for what is no number.
  std::string plain_text(const double value, const unsigned int n_digits);

  /// So many digits behind the point; "–" for what is no number.
  std::string fixed_text(const double value, const int decimals);

  /// So many significant digits, with an exponent where that is shorter; "–"
  /// for what is no number.
  std::string short_text(const double value, const int significant = 4);

  /// A share as "4.12 %", with the digits that are worth reading.
  std::string percent_text(const double share);

  /// A speed [mm/s] as "10 mm/min".
  std::string speed_text(const double speed);
  ///@}

  /// @name Words
  ///@{

  /// "overstress, softening and healing"
  std::string list_text(const std::vector<std::string> &names,
                        const std::string              &before_last = "and");

  /// "1 test", "2 tests"
  std::string counted(const std::size_t n, const std::string &what);

  /// With a capital at the beginning.
  std::string capitalised(std::string text);

  /// In quotation marks.
  std::string in_quotes(const std::string &text);
  ///@}
} // namespace SlipStep

#endif
