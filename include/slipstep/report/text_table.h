// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_text_table_h
#define slipstep_report_text_table_h

#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace SlipStep
{
  using TableLine  = std::vector<std::string>;
  using TableLines = std::vector<TableLine>;

  /// Length in characters, not bytes.
  std::size_t text_width(const std::string &text);

  /// Text that ends with an ellipsis if it is wider than that.
  std::string cut_text(const std::string &text, const std::size_t widest);

  /// Characters in a line of what the terminal shows.
  constexpr std::size_t terminal_width = 100;

  /// The first line of a table: "test | rows | rms"
  TableLine table_head(const std::string &names);

  /// A table for the terminal, the first line being its head. The first column
  /// holds names; the others are aligned to the right.
  /// @param widest number of characters in a line beyond which names are cut
  std::string text_table(const TableLines &lines,
                         const std::size_t widest = -1);

  /// The same below an empty line, as wide as the terminal; "" if it has a head
  /// only.
  std::string table_paragraph(const TableLines &lines);

  /// A table that is written column by column, since there are columns that not
  /// every table has. It has a line for each of the rows.
  template <typename Row>
  class ColumnTable
  {
  public:
    explicit ColumnTable(const std::vector<Row> &rows)
      : rows(rows)
      , lines(1 + rows.size())
    {}

    /// @param text of a row, or a whole number: a function of it, or a member
    template <typename Text>
    void add(const std::string &head, const Text &text)
    {
      lines[0].push_back(head);
      for (std::size_t i = 0; i < rows.size(); ++i)
        if constexpr (std::is_integral_v<
                        std::decay_t<std::invoke_result_t<Text, Row>>>)
          lines[i + 1].push_back(std::to_string(std::invoke(text, rows[i])));
        else
          lines[i + 1].push_back(std::invoke(text, rows[i]));
    }

    /// @param value of a row, shown with so many decimals
    template <typename Value>
    void add(const std::string &head, const int decimals, const Value &value)
    {
      add(head, [&](const Row &row) {
        return fixed_text(std::invoke(value, row), decimals);
      });
    }

    /// The same with so many significant digits.
    template <typename Value>
    void
    add_short(const std::string &head, const int digits, const Value &value)
    {
      add(head, [&](const Row &row) {
        return short_text(std::invoke(value, row), digits);
      });
    }

    /// The same of a coefficient of friction.
    template <typename Value>
    void add_friction(const std::string &head, const Value &value)
    {
      add(head, [&](const Row &row) {
        return friction_text(std::invoke(value, row));
      });
    }

    /// Whether a row is such.
    template <typename Test>
    bool has(const Test &test) const
    {
      return any_of(rows,
                    [&](const Row &row) { return std::invoke(test, row); });
    }

    const std::vector<Row> &rows;
    TableLines              lines; ///< the first is the head
  };

  /// Text broken between words into indented lines.
  std::string wrapped_text(const std::string &text,
                           const std::size_t  indent = 2,
                           const std::size_t  widest = terminal_width);
} // namespace SlipStep

#endif
