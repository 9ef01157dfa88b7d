// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_text_h
#define slipstep_utilities_text_h

#include <string>
#include <string_view>
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

  /// A coefficient of friction: four decimals, of small ones four digits.
  std::string friction_text(const double value);

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

  /// The text with small letters for capitals (ASCII only: other letters and
  /// the locale do not matter).
  std::string lower_case(const std::string_view text);

  /// Whether two words differ in capitals only.
  bool is_same_word(const std::string_view a, const std::string_view b);
  ///@}

  /// @name Messages
  ///@{

  /// What the user wrote, fit for one line of a message: the middle of a long
  /// text is left out.
  std::string excerpt(const std::string &text, const std::size_t most = 60);

  /// The first lines with something in them, in one: deal.II's messages are
  /// pages.
  std::string essential_lines(const std::string &text,
                              const unsigned int n_lines);

  /// Remarks for a file: wrapped into lines that begin with the indent and
  /// "# ", of at most @p most bytes (with an indent of more than 40, longer).
  std::string commented(const std::string &text,
                        const std::string &indent = "",
                        const std::size_t  most   = 78);

  /// A message whose lines have a length that can be read.
  std::string readable(const std::string &message);

  /// "decimals begin with a point: 0.05" if a number such as 0,05 is in the
  /// text; "" if there is none. Commas in a list of more numbers without blanks
  /// (4,4,4), and one alone in parentheses, are no decimals.
  std::string decimal_comma_hint(const std::string &text);

  /// What to write instead of a dash that looks like a minus sign; "" without
  /// one.
  std::string minus_hint(const std::string &text);
  ///@}
} // namespace SlipStep

#endif
